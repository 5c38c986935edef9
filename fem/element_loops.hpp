#pragma once
#include "fem/solver.hpp"

#include <atomic>

/// What every time integration does with the elements `begin` to `end`, on the state of the solver
/// and its step s.dt.
namespace flowslide::fem {

inline constexpr double kLargestStrainStep = 0.2;  ///< beyond it small strains mean nothing

/// Velocities to strain increments and hourglass displacements; raises `largest` to the largest
/// increment.
void deform(Solver& s, std::int32_t begin, std::int32_t end, double& largest);

/// Elements of each law that have been taken by a thread, from the first one on.
struct StressQueue {
  explicit StressQueue(const Layout& l);
  std::array<std::atomic<std::int32_t>, ShakingLaws::size> taken;
};

/// Strain increments to stresses and states of the laws. To be called by all threads of a parallel
/// region with a fresh queue: each takes elements until none is left, and nobody waits for another.
void update_stresses(Solver& s, StressQueue& queue);

/// After all stresses: hourglass motion beyond the strength of the soil is taken back. Fills
/// `failed`.
void check_stresses(Solver& s, std::int32_t begin, std::int32_t end, Solver::ChunkSums& sums);

/// Water that the elements press to their nodes: volume change and Darcy flow.
void flow(Solver& s, std::int32_t begin, std::int32_t end);

/// Internal forces of stress, pore pressure, hourglass and stiffness damping; with them the work
/// of the step, by the mean of the forces before and after.
void internal_forces(Solver& s, std::int32_t begin, std::int32_t end, Solver::ChunkSums& sums);

}  // namespace flowslide::fem
