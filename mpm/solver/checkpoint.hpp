#pragma once
#include "mpm/solver/energy_watch.hpp"
#include "mpm/solver/simulation.hpp"

#include <array>
#include <filesystem>
#include <vector>

/// Exact image of a run between two steps: continuing from it gives the same bits as never having
/// stopped. Native byte order; meant for the same program on the same machine.
namespace flowslide::mpm {

/// What the driver of the run remembers beside the simulation.
struct RunState {
  std::size_t frames = 0, samples = 0;         ///< already in the history
  double next_frame = 0.0, next_sample = 0.0;  ///< [s]
  double peak_kinetic = 0.0;                   ///< [J]
  double mass_start = 0.0, kinetic_start = 0.0, potential_start = 0.0, recoverable_start = 0.0;
  std::array<double, 3> momentum_start{};
  double first_dt = 0.0;         ///< [s]
  std::int64_t updates = 0;      ///< sum over the steps of the points awake in them
  std::int64_t short_steps = 0;  ///< steps in a row far below the first
  EnergyWatch energy;
  std::vector<std::array<double, 2>> recent;  ///< (time, front) of the rest window
};

/// Atomically replaces `path`. Throws FileError.
template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Simulation<Dim>& s,
                      const RunState& run);

/// Fills what a run changes; settings, materials and boundaries stay as they are. Throws FileError
/// if the file is damaged or holds what this run cannot have.
template <int Dim>
void read_checkpoint(const std::filesystem::path& path, Simulation<Dim>& s, RunState& run);

/// The rest of that check, which needs the walls that prepare() places. Throws FileError.
template <int Dim>
void check_walls(const std::filesystem::path& path, const Simulation<Dim>& s);

}  // namespace flowslide::mpm
