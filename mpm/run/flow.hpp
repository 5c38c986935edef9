#pragma once
#include "core/progress.hpp"
#include "model/mpm_history.hpp"
#include "mpm/run/flow_config.hpp"
#include "mpm/run/stiffness.hpp"

#include <filesystem>

/// The runout stage: from transferred points to rest.
namespace flowslide {

struct FlowPaths {
  std::filesystem::path history;     ///< the MpmHistory to write
  std::filesystem::path checkpoint;  ///< written now and then; read first if it exists
};

struct FlowFacts {
  double end_time = 0.0;  ///< simulated time reached [s]
  bool at_rest = false;   ///< false: stopped by `end`, or no point was left
  std::int64_t steps = 0;
  double point_updates = 0.0;  ///< sum over the steps of the points awake in them
  double step_seconds = 0.0;   ///< wall time of this call spent in steps [s]
  double updates_this_call = 0.0;
  double absorbed = 0.0;                     ///< energy that left through absorbing planes [J]
  MpmSample last;                            ///< the final row of the time series
  std::optional<StiffnessChoice> stiffness;  ///< with `stiffness: automatic`
};

/// With `stiffness: automatic` the history holds the elastic constants that were used.
/// Runs to rest, to config.end, or until all points have left. With an existing checkpoint of the
/// same run, continues from it: the history is then bit for bit that of an uninterrupted run.
/// With config.extrude it is in three dimensions and the history has the particles' copies.
/// Throws InputError for particles the solver cannot start from, NumericsError naming step, time
/// and particle, FileError, Interrupted.
FlowFacts run_flow(const ParticleSet& particles, const FlowConfig& config, const FlowPaths& paths,
                   int threads, const Progress& progress);

}  // namespace flowslide
