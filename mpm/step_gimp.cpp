#include "mpm/step.hpp"

namespace flowslide::mpm {

template void step<2, Gimp>(Simulation<2>&, StepScratch<2>&);
template void step<3, Gimp>(Simulation<3>&, StepScratch<3>&);

}  // namespace flowslide::mpm
