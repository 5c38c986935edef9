#pragma once
#include "workflows/engine/cache.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/engine/graph.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

struct RunOptions {
  std::filesystem::path folder;  ///< results go here
  int threads = 1;
  /// Set by a signal handler: the running stage writes a checkpoint and the run ends.
  const std::atomic<bool>* stop_requested = nullptr;
  std::vector<std::string> redo = {};  ///< stages that run even if they are up to date
  /// Programs that a workflow file may have started, as it names them: the user's word.
  std::vector<std::string> allowed_programs = {};
  CostBook* costs = nullptr;  ///< says what stages will take, and learns what they took
};

/// What a run tells its caller.
struct RunEvents {
  /// A stage has been decided on, before it runs.
  std::function<void(std::string_view stage, const Decision&)> decided = [](std::string_view,
                                                                            const Decision&) {};
  std::function<void(std::string_view stage, Share share, std::string_view text)> progress =
      [](std::string_view, Share, std::string_view) {};
  std::function<void(std::string_view stage, double seconds)> done = [](std::string_view, double) {
  };
  /// Something of the run folder that was not as it should be, or that is no longer there.
  std::function<void(std::string_view text)> notice = [](std::string_view) {};
  /// What a user must know before using the result of a stage: once it is decided on, of its
  /// settings and of a result that is used again; when it ends, of the new result.
  std::function<void(std::string_view stage, const std::vector<std::string>&)> warned =
      [](std::string_view, const std::vector<std::string>&) {};
};

/// Brings the run folder up to date with the workflow and writes DIR/result.json. Finished stages
/// are kept whatever happens later. What an earlier workflow has put at the top of the folder stays
/// until a stage has to run, and goes then: while result.json is there, it belongs to the workflow
/// that run.lock names.
/// Throws Interrupted, InputError if a stage would start a program without permission, FileError if
/// another process uses the folder, and what the stages throw, with the stage's name in front.
void run_workflow(const Workflow& workflow, const RunOptions& options, const RunEvents& events);

struct PlanLine {
  std::string stage;
  Decision decision;
};

/// What run_workflow would do, and with `costs` what it would take; reads all of the run folder, if
/// there is one, and changes nothing.
std::vector<PlanLine> plan_workflow(const Workflow& workflow, const std::filesystem::path& folder,
                                    const CostBook* costs = nullptr, int threads = 1);

/// Text of DIR/result.json: what the stages found, in SI units, each number under its own name at
/// the top. Where stages of different types find the same, the later one counts; where two of the
/// same type differ, or nobody finds it, the number is null. `overhead` is the wall time of this
/// call outside stages [s].
struct StageOutcome {
  StageRecord record;
  Decision decision;
};
std::string result_json(const Workflow& workflow, const std::vector<StageOutcome>& outcomes,
                        double overhead);

}  // namespace flowslide
