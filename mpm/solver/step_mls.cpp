#include "mpm/solver/step.hpp"

namespace flowslide::mpm {

template double step<2, MovingLeastSquares>(Simulation<2>&, StepScratch<2>&);
template double step<3, MovingLeastSquares>(Simulation<3>&, StepScratch<3>&);

}  // namespace flowslide::mpm
