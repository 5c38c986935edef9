#include "mpm/step.hpp"

namespace flowslide::mpm {

template void step<2, CubicBSpline>(Simulation<2>&, StepScratch<2>&);
template void step<3, CubicBSpline>(Simulation<3>&, StepScratch<3>&);

}  // namespace flowslide::mpm
