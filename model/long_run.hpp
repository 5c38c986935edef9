#pragma once
#include "core/progress.hpp"
#include "core/thread_pace.hpp"
#include "model/checkpoint_file.hpp"

#include <concepts>
#include <filesystem>
#include <string>

/// What long runs have in common, whatever they solve: progress, checkpoints now and then and when
/// the run is interrupted, and an end that leaves nothing but the history.
/// docs/adr/0008-checkpoints.md
namespace flowslide {

inline constexpr double kReportSeconds = 0.2;  ///< wall time between progress reports

/// A run that takes steps and records states in a history that lies in parts until it is finished.
template <class R>
concept LongRun = requires(R& run, const R& now, double seconds) {
  { run.step() } -> std::same_as<bool>;          ///< one step; true if it recorded a state
  { now.ended() } -> std::same_as<bool>;         ///< false before the first step of the run
  { now.share() } -> std::same_as<Share>;        ///< of the work that is done
  { now.text() } -> std::same_as<std::string>;   ///< about its state, one short line
  { now.place() } -> std::same_as<std::string>;  ///< where it is, for "interrupted at ..."
  /// Flushes the history and then writes the checkpoint that counts what is in it; told the wall
  /// time since run_to_end began.
  run.save(seconds);
  run.use_threads(1);  ///< for the steps to come, whose results do not depend on it
  run.history.finish();
  run.history.remove_parts();
};

/// Runs to the end with at most so many threads; returns the wall time of the steps [s]. Throws
/// Interrupted after save() when a stop is asked for, and what the run throws.
template <LongRun R>
double run_to_end(R& run, int threads, const std::filesystem::path& checkpoint,
                  const Progress& progress) {
  const Clock::time_point start = Clock::now();
  Clock::time_point last_report = start, last_save = start;
  double interval = kCheckpointSeconds;
  ThreadPace pace(threads);
  int used = threads;
  while (!run.ended()) {
    const bool recorded = run.step();
    if (const int best = pace.after_step(); best != used) run.use_threads(used = best);
    // Before the report, which fails where the terminal has gone.
    if (!run.ended() && progress.should_stop()) {
      run.save(seconds_since(start));
      throw Interrupted("interrupted at " + run.place() +
                        "; the same command continues from there");
    }
    if (recorded || run.ended() || seconds_since(last_report) > kReportSeconds) {
      progress.report(run.ended() ? Share(1.0) : run.share(), run.text());
      last_report = Clock::now();
    }
    if (run.ended()) break;
    if (seconds_since(last_save) > interval) {
      const Clock::time_point before = Clock::now();
      run.save(seconds_since(start));
      interval = checkpoint_interval(seconds_since(before));
      last_save = Clock::now();
      pace.leave_out_until_now();
    }
  }
  const double seconds = seconds_since(start);
  run.history.finish();
  remove_checkpoint(checkpoint);
  run.history.remove_parts();
  return seconds;
}

/// Moves the time of the next output beyond `now`.
inline void pass_output(double& next, double now, double interval) {
  while (next <= now) next += interval;
}

}  // namespace flowslide
