#include "mpm/kernels/stress_update.hpp"

namespace flowslide::mpm {

template StressWork update_stress<3>(Points<3>&, const Tile<3>&, std::span<const MaterialRun>,
                                     std::span<const SolverMaterial>, double, TileScratch<3>&,
                                     bool) noexcept;

}  // namespace flowslide::mpm
