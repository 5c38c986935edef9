#include "workflows/engine/runner.hpp"

#include "core/check.hpp"
#include "core/clock.hpp"
#include "core/files.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/run_folder.hpp"
#include "workflows/engine/run_stage.hpp"
#include "workflows/engine/session.hpp"
#include "workflows/engine/top.hpp"
#include "workflows/engine/warnings.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

const OutputRecord& output(const StageRecord& record, const std::string& port) {
  return *std::find_if(record.outputs.begin(), record.outputs.end(),
                       [&](const OutputRecord& o) { return o.port == port; });
}

std::vector<const StageRecord*> records_of(const std::vector<std::optional<StageState>>& results) {
  std::vector<const StageRecord*> records;
  for (const auto& result : results) records.push_back(result ? &result->record : nullptr);
  return records;
}

StageInputs stage_inputs(const Workflow& workflow, const WorkflowStage& stage,
                         const fs::path& folder,
                         const std::vector<std::optional<StageState>>& results) {
  StageInputs inputs = inputs_before(workflow, stage, records_of(results), folder);
  for (const Link& link : stage.inputs) {
    const StageState& from = *results[link.from_stage];
    const fs::path path = result_folder(folder, from.record.stage, from.record.key) /
                          output(from.record, link.from_port).file;
    inputs.paths[link.port] = path;
    for (HashedFile& file : files_of_output(from.files, path))
      inputs.files.push_back(std::move(file));
  }
  return inputs;
}

void expect_allowed(const Workflow& workflow, const RunOptions& options) {
  for (const WorkflowStage& stage : workflow.stages)
    for (const std::string& program : stage.prepared.programs)
      validate(std::find(options.allowed_programs.begin(), options.allowed_programs.end(),
                         program) != options.allowed_programs.end(),
               "{}: stage {} would start '{}' (a workflow file from somebody else could name any "
               "program). If you trust it, add --allow-python '{}'.",
               workflow.file.string(), stage.name, program, program);
}

/// What is wrong with a stage's result, in full; `why` is one line.
void tell_problems(const WorkflowStage& stage, const Decision& decision, const RunEvents& events) {
  for (const std::string& problem : decision.problems)
    events.notice(fmt::format("{}: {}", stage.name, problem));
}

bool is_asked_for(const WorkflowStage& stage, const RunOptions& options) {
  return std::find(options.redo.begin(), options.redo.end(), stage.name) != options.redo.end();
}

struct Spent {
  Clock::time_point start = Clock::now();
  double processor = processor_time(), memory = peak_memory();
};

/// The largest memory of the process is that of this stage only if it has grown. What earlier
/// sessions have spent on a stage is known as wall time only.
void learn(const Workflow& workflow, std::size_t stage, const RunOptions& options, double seconds,
           const Spent& before) {
  const double memory = peak_memory(), wall = seconds_since(before.start);
  const Task task = task_of(workflow, stage);
  constexpr double kMoment = 1.0;  // that a record may be longer by
  if (seconds < wall + kMoment)
    seconds = std::min(seconds, quiet_seconds(task.work, options.threads, wall,
                                              processor_time() - before.processor));
  options.costs->learn(task, options.threads, seconds, memory > before.memory ? memory : 0.0);
}

void run_stages(const Workflow& workflow, const RunOptions& options, const RunEvents& events) {
  const auto start = Clock::now();
  const RunFolder folder(options.folder);
  RunTop top(options.folder, workflow, events);
  const auto stop_before = [&](const std::string& stage) {
    if (options.stop_requested && options.stop_requested->load())
      throw Interrupted(
          fmt::format("stopped before stage {}; the same command continues there.", stage));
  };

  std::vector<std::optional<StageState>> results;
  std::vector<StageOutcome> outcomes;
  double in_stages = 0.0;
  for (const WorkflowStage& stage : workflow.stages) {
    stop_before(stage.name);
    const StageInputs inputs = stage_inputs(workflow, stage, options.folder, results);
    Decision decision = decide(options.folder, stage, inputs.hashes, top.previous(stage.name),
                               [&] { stop_before(stage.name); });
    if (decision.action == Action::reuse && is_asked_for(stage, options)) {
      decision.action = Action::run;
      decision.why = "asked for";
      decision.record.reset();
    }
    if (options.costs && decision.action != Action::reuse)
      decision.expected =
          options.costs->expect(task_of(workflow, outcomes.size()), options.threads);
    decision.warnings = warnings_of(stage, decision.record ? &*decision.record : nullptr);
    tell_problems(stage, decision, events);
    events.decided(stage.name, decision);
    events.warned(stage.name, decision.warnings);
    StageState state;
    if (decision.action == Action::reuse) {
      remove_work_folder(options.folder, work_folder(options.folder, stage.name, decision.key));
      // a session that ended between the naming of its result and this
      remove_path(result_folder(options.folder, stage.name, decision.key) / kSessionFile);
      state = {*decision.record, std::move(decision.files)};
    } else {
      top.stage_runs();
      const Spent before;
      state = run_stage(stage, decision, inputs, options, events);
      in_stages += seconds_since(before.start);
      if (options.costs) learn(workflow, outcomes.size(), options, state.record.seconds, before);
      decision.warnings = warnings_of(stage, &state.record);
      events.done(stage.name, state.record.seconds);
      events.warned(stage.name, decision.warnings);
    }
    top.stage_done(state.record, decision.action != Action::reuse);
    outcomes.push_back({state.record, decision});
    results.emplace_back(std::move(state));
  }
  std::vector<StageRecord> records;
  for (const StageOutcome& outcome : outcomes) records.push_back(outcome.record);
  top.finish(records, result_json(workflow, outcomes, seconds_since(start) - in_stages));
}

}  // namespace

void run_workflow(const Workflow& workflow, const RunOptions& options, const RunEvents& events) {
  expect_allowed(workflow, options);
  try {
    run_stages(workflow, options, events);
  } catch (const fs::filesystem_error& e) {
    throw FileError(fmt::format("{}: {} (the run folder must stay writable and have room).",
                                e.path1().string(), e.code().message()));
  }
}

std::vector<PlanLine> plan_workflow(const Workflow& workflow, const fs::path& folder,
                                    const CostBook* costs, int threads) {
  const std::optional<RunLock> before = read_lock(folder).lock;
  std::vector<std::optional<StageState>> results;
  std::vector<PlanLine> plan;
  for (const WorkflowStage& stage : workflow.stages) {
    std::optional<StageRecord> previous;
    if (before && before->stages.contains(stage.name)) previous = before->stages.at(stage.name);
    const StageInputs inputs = inputs_before(workflow, stage, records_of(results), folder);
    plan.push_back({stage.name, decide(folder, stage, inputs.hashes, previous)});
    Decision& decision = plan.back().decision;
    decision.warnings = warnings_of(stage, decision.record ? &*decision.record : nullptr);
    results.emplace_back();
    if (decision.action == Action::reuse)
      results.back() = StageState{*decision.record, decision.files};
    else if (costs)
      decision.expected = costs->expect(task_of(workflow, plan.size() - 1), threads);
  }
  return plan;
}

}  // namespace flowslide
