#include "mpm/kernels/stress_update.hpp"

namespace flowslide::mpm {

template StressWork update_stress<2>(Points<2>&, const Tile<2>&, std::span<const MaterialRun>,
                                     std::span<const SolverMaterial>, double, TileScratch<2>&,
                                     bool) noexcept;

}  // namespace flowslide::mpm
