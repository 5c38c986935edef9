#pragma once
#include "study/run/job.hpp"
#include "study/run/study_state.hpp"

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide::study {

struct PoolOptions {
  std::size_t jobs = 1;     ///< processes side by side, at most
  std::size_t threads = 1;  ///< of all of them together
  double memory = 1e9;      ///< for all of them together [bytes]
  bool retry = false;       ///< also what failed for good before
  /// Nodes to be computed, the others are somebody else's; empty: all.
  std::vector<bool> only = {};
  /// How long what others have made may take to be seen: file systems that machines share do not
  /// show everything at once [s].
  double patience = 0.0;
  std::vector<std::string> allowed_programs;
  std::filesystem::path costs = {};  ///< what stages took on this machine, as for CostBook
  const std::atomic<bool>* stop_requested = nullptr;
  /// What a new process does with a job; returns the exit code. Its standard output is read.
  std::function<int(const Job& job)> body;
};

struct StageEnd {
  std::size_t node = 0;
  State state = State::done;  ///< done or failed; ready where it has to be done again
  bool found = false;         ///< done by another process
  double seconds = 0.0;       ///< of this session
};

/// What is going on, for people who wait.
struct PoolView {
  struct Line {
    std::size_t node = 0;
    int threads = 1;
    double fraction = 0.0, seconds = 0.0;
    std::string text;
  };
  std::vector<Line> running;
  std::size_t done = 0, failed = 0, blocked = 0, all = 0;  ///< stages
  double seconds_left = kUnset;
};

struct PoolEvents {
  std::function<void(const StageEnd&)> ended = [](const StageEnd&) {};
  std::function<void(const PoolView&)> tick = [](const PoolView&) {};
  std::function<void(std::string_view text)> notice = [](std::string_view) {};
};

enum class PoolEnd {
  done,      ///< nothing is left that can be computed
  outdated,  ///< a workflow, or a file that one names, is no longer what was planned: plan again
};

/// Computes what is missing, each stage in a process of its own. A stage that fails does not stop
/// the rest. Throws Interrupted when asked to stop, FileError where the store cannot be written.
PoolEnd run_pool(const Plan& plan, const Store& store, StudyState& progress,
                 const PoolOptions& options, const PoolEvents& events);

}  // namespace flowslide::study
