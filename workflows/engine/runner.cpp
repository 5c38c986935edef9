#include "workflows/engine/runner.hpp"

#include "core/check.hpp"
#include "workflows/engine/program_version.hpp"
#include "workflows/engine/run_folder.hpp"
#include "workflows/engine/warnings.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

using Clock = std::chrono::steady_clock;

/// In a work folder: wall seconds that earlier sessions spent there.
constexpr std::string_view kSecondsFile = "seconds";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double read_seconds(const fs::path& folder) {
  std::ifstream in(folder / kSecondsFile);
  double seconds = 0.0;
  return in >> seconds && seconds > 0.0 ? seconds : 0.0;
}

std::optional<StageRecord> previous_record(const std::optional<RunLock>& lock,
                                           const std::string& stage) {
  if (!lock) return std::nullopt;
  const auto it = lock->stages.find(stage);
  return it == lock->stages.end() ? std::nullopt : std::optional(it->second);
}

const OutputRecord& output(const StageRecord& record, const std::string& port) {
  return *std::find_if(record.outputs.begin(), record.outputs.end(),
                       [&](const OutputRecord& o) { return o.port == port; });
}

/// Content hashes of the connected ports, as far as `results` (by index of stage) knows them.
std::map<std::string, std::string> input_hashes(
    const WorkflowStage& stage, const std::vector<std::optional<StageRecord>>& results) {
  std::map<std::string, std::string> hashes;
  for (const Link& link : stage.inputs)
    if (const auto& from = results[link.from_stage])
      hashes[link.port] = output(*from, link.from_port).sha256;
  return hashes;
}

/// Runs one stage in its work folder and turns that into a result. The rename is the moment from
/// which the result exists.
StageRecord run_stage(const WorkflowStage& stage, const Decision& decision,
                      const std::map<std::string, std::string>& inputs, PortPaths paths,
                      const RunOptions& options, const RunEvents& events,
                      std::vector<std::string> earlier) {
  const fs::path work = work_folder(options.folder, stage.name, decision.key);
  const fs::path final = result_folder(options.folder, stage.name, decision.key);
  if (decision.action != Action::resume) fs::remove_all(work);
  fs::create_directories(work);
  for (const Port& port : stage.type.outputs) paths[port.name] = work / port.file;

  const double before = read_seconds(work);
  const auto start = Clock::now();
  auto written = start;
  const auto keep_time = [&] {
    std::ofstream(work / kSecondsFile) << before + seconds_since(start) << '\n';
    written = Clock::now();
  };
  RunContext context{.folder = work,
                     .threads = options.threads,
                     .progress = {},
                     .provenance = {{"program", program_version()}, {"stage key", decision.key}},
                     .warnings = std::move(earlier)};
  for (const auto& [port, hash] : inputs)
    if (port != kWarningsInput) context.provenance.emplace_back("sha256 of " + port, hash);
  context.progress.stop_requested = options.stop_requested;
  context.progress.report = [&](double fraction, std::string_view text) {
    events.progress(stage.name, fraction, text);
    if (stage.type.checkpoints && seconds_since(written) > 2.0) keep_time();
  };

  StageResult result;
  try {
    result = stage.prepared.run(context, paths);
  } catch (const Error& e) {
    if (stage.type.checkpoints) keep_time();
    throw Error(e.exit_code(), fmt::format("{}: {}", stage.name, e.what()));
  }

  StageRecord record{.stage = stage.name,
                     .uses = stage.type.name,
                     .version = stage.type.version,
                     .key = decision.key,
                     .settings = stage.prepared.settings,
                     .inputs = inputs,
                     .outputs = {},
                     .publish = result.publish,
                     .facts = add_warnings(result.facts, result.warnings),
                     .program = program_version(),
                     .seconds = before + seconds_since(start)};
  for (const Port& port : stage.type.outputs) {
    if (!fs::exists(work / port.file))
      throw std::logic_error(fmt::format("stage {} did not write {}", stage.name, port.file));
    OutputRecord described = describe_output(port, work);
    described.sha256 = content_hash(work / port.file);
    record.outputs.push_back(std::move(described));
  }
  fs::remove(work / kSecondsFile);
  write_record(work, record);
  discard_result(final);
  fs::rename(work, final);
  return record;
}

PortPaths input_paths(const WorkflowStage& stage, const Workflow& workflow, const fs::path& folder,
                      const std::vector<std::optional<StageRecord>>& results) {
  PortPaths paths;
  for (const Link& link : stage.inputs) {
    const StageRecord& from = *results[link.from_stage];
    paths[link.port] = result_folder(folder, workflow.stages[link.from_stage].name, from.key) /
                       output(from, link.from_port).file;
  }
  return paths;
}

void run_stages(const Workflow& workflow, const RunOptions& options, const RunEvents& events) {
  const auto start = Clock::now();
  const RunFolder folder(options.folder);
  const std::optional<RunLock> before = read_lock(options.folder);
  folder.withdraw();

  RunLock lock = before.value_or(RunLock{});
  lock.workflow = workflow.name;
  lock.file = fs::absolute(workflow.file).string();
  lock.overrides = workflow.overrides;
  lock.complete = false;
  lock.published.clear();
  std::erase_if(lock.stages, [&](const auto& entry) {
    return std::none_of(workflow.stages.begin(), workflow.stages.end(),
                        [&](const WorkflowStage& s) { return s.name == entry.first; });
  });
  write_lock(options.folder, lock);

  std::vector<std::optional<StageRecord>> results;
  std::vector<StageOutcome> outcomes;
  double in_stages = 0.0;
  for (const WorkflowStage& stage : workflow.stages) {
    if (options.stop_requested && options.stop_requested->load())
      throw Interrupted(
          fmt::format("stopped before stage {}; the same command continues there.", stage.name));
    auto inputs = input_hashes(stage, results);
    std::vector<std::string> earlier = earlier_warnings(workflow, stage, results);
    add_to_inputs(inputs, stage, earlier);
    Decision decision = decide(options.folder, stage, inputs, previous_record(before, stage.name));
    const bool redo =
        std::find(options.redo.begin(), options.redo.end(), stage.name) != options.redo.end();
    if (redo && decision.action == Action::reuse) {
      decision.action = Action::run;
      decision.why = "asked for";
      decision.record.reset();
    }
    decision.warnings = warnings_of(stage, decision.record);
    events.decided(stage.name, decision);
    events.warned(stage.name, decision.warnings);
    if (decision.action != Action::reuse) {
      const auto stage_start = Clock::now();
      decision.record =
          run_stage(stage, decision, inputs, input_paths(stage, workflow, options.folder, results),
                    options, events, std::move(earlier));
      in_stages += seconds_since(stage_start);
      decision.warnings = warnings_of(stage, decision.record);
      events.done(stage.name, decision.record->seconds);
      events.warned(stage.name, decision.warnings);
    }
    lock.stages[stage.name] = *decision.record;
    if (decision.action != Action::reuse) write_lock(options.folder, lock);
    results.push_back(decision.record);
    outcomes.push_back({*decision.record, decision});
  }

  std::vector<StageRecord> records;
  for (const StageOutcome& outcome : outcomes) records.push_back(outcome.record);
  const std::vector<Publication> items = publications(records);
  for (const Publication& item : items) lock.published.push_back(item.name);
  write_lock(options.folder, lock);  // first the names, so that a later run can withdraw them
  for (const Publication& item : items) folder.publish(item);
  lock.complete = true;
  write_lock(options.folder, lock);
  write_atomically(options.folder / kResultFile,
                   result_json(workflow, outcomes, seconds_since(start) - in_stages));
}

}  // namespace

void run_workflow(const Workflow& workflow, const RunOptions& options, const RunEvents& events) {
  try {
    run_stages(workflow, options, events);
  } catch (const fs::filesystem_error& e) {
    throw FileError(fmt::format("{}: {} (the run folder must stay writable and have room).",
                                e.path1().string(), e.code().message()));
  }
}

std::vector<PlanLine> plan_workflow(const Workflow& workflow, const fs::path& folder) {
  const std::optional<RunLock> before = read_lock(folder);
  std::vector<std::optional<StageRecord>> results;
  std::vector<PlanLine> plan;
  for (const WorkflowStage& stage : workflow.stages) {
    auto inputs = input_hashes(stage, results);
    add_to_inputs(inputs, stage, earlier_warnings(workflow, stage, results));
    plan.push_back(
        {stage.name, decide(folder, stage, inputs, previous_record(before, stage.name))});
    Decision& decision = plan.back().decision;
    decision.warnings = warnings_of(stage, decision.record);
    results.push_back(decision.action == Action::reuse ? decision.record : std::nullopt);
  }
  return plan;
}

}  // namespace flowslide
