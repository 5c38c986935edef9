#include "mpm/solver/step.hpp"

namespace flowslide::mpm {

template double step<2, CubicBSpline>(Simulation<2>&, StepScratch<2>&);
template double step<3, CubicBSpline>(Simulation<3>&, StepScratch<3>&);

}  // namespace flowslide::mpm
