#include "study/run/job.hpp"

#include "study/run/final_state.hpp"
#include "study/run/locks.hpp"
#include "study/run/study_state.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/run_stage.hpp"
#include "workflows/engine/sealed_json.hpp"
#include "workflows/engine/session.hpp"
#include "workflows/engine/warnings.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sys/resource.h>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

double peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

std::size_t index_of(const Workflow& workflow, const std::string& stage) {
  for (std::size_t i = 0; i < workflow.stages.size(); ++i)
    if (workflow.stages[i].name == stage) return i;
  throw InputError(fmt::format("{}: has no stage '{}' (the workflow has changed since the study "
                               "began). Run the study again.",
                               workflow.file.string(), stage));
}

/// The stages before one, in the order of the workflow, as the store knows them.
class Results {
 public:
  Results(const Workflow& workflow, const Store& store)
      : workflow_(workflow), records_(workflow.stages.size()), store_(store) {}

  /// Key of a stage; looks at all that feed it first.
  std::string key(std::size_t stage) {
    std::vector<const StageRecord*> known;
    for (std::size_t i = 0; i < stage; ++i) known.push_back(feeds(stage, i) ? &record(i) : nullptr);
    inputs_ = inputs_of(workflow_, stage, known);
    warnings_ = earlier_warnings(workflow_, workflow_.stages[stage], known);
    const WorkflowStage& s = workflow_.stages[stage];
    return stage_key(s.type, s.prepared.settings, inputs_);
  }
  /// Of the stage whose key was asked for last.
  [[nodiscard]] const std::map<std::string, std::string>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  const StageRecord& record(std::size_t stage) {
    if (!records_[stage]) {
      const std::string& name = workflow_.stages[stage].name;
      const std::string stage_key = key(stage);
      auto finished = store_.finished(name, stage_key);
      if (!finished)
        throw FileError(fmt::format("{}: has no result yet (it feeds another stage). Run the study "
                                    "again.",
                                    name));
      records_[stage] = std::move(finished->record);
    }
    return *records_[stage];
  }

 private:
  [[nodiscard]] bool feeds(std::size_t stage, std::size_t earlier) const {
    return std::any_of(workflow_.stages[stage].inputs.begin(), workflow_.stages[stage].inputs.end(),
                       [&](const Link& link) {
                         return link.from_stage == earlier ||
                                (link.from_stage > earlier && feeds(link.from_stage, earlier));
                       });
  }

  const Workflow& workflow_;
  std::vector<std::optional<StageRecord>> records_;
  const Store& store_;
  std::map<std::string, std::string> inputs_;
  std::vector<std::string> warnings_;
};

/// Reads the files of the inputs. The name of a stage whose files are not those of its record.
std::optional<std::string> read_inputs(const WorkflowStage& stage, const Workflow& workflow,
                                       Results& results, const Store& store, StageInputs& inputs) {
  for (const Link& link : stage.inputs) {
    const StageRecord& from = results.record(link.from_stage);
    const fs::path folder = store.result(from.stage, from.key);
    const RecordRead read = read_record(folder);
    if (!read.record) return workflow.stages[link.from_stage].name;
    const Verified verified = verify(*read.record, folder);
    const auto output = [&](const StageRecord& record) {
      return *std::find_if(record.outputs.begin(), record.outputs.end(),
                           [&](const OutputRecord& o) { return o.port == link.from_port; });
    };
    const OutputRecord promised = output(from);
    if (!verified.problems.empty() || read.record->key != from.key ||
        content_hash(read.record->files, promised.file) != promised.sha256)
      return workflow.stages[link.from_stage].name;
    inputs.paths[link.port] = folder / promised.file;
    for (HashedFile& file : files_of_output(verified.files, folder / promised.file))
      inputs.files.push_back(std::move(file));
  }
  return std::nullopt;
}

/// A result that was made again must be the one that was there: numbers of the table stand on it.
void expect_same(const std::optional<Finished>& before, const StageRecord& now) {
  if (!before) return;
  for (const OutputRecord& o : before->record.outputs)
    for (const OutputRecord& n : now.outputs)
      if (o.port == n.port && o.sha256 != n.sha256)
        throw NumericsError(
            fmt::format("{}: the same settings and inputs gave another '{}' than before (results of "
                        "two builds would be mixed). Remove {}* in the folder of the study.",
                        now.stage, o.port, now.key.substr(0, 16)));
}

void keep_final_state(const Store& store, const StageRecord& record, const StageType& type) {
  for (const Port& port : type.outputs)
    if (port.kind == kArtifactKind<MpmHistory>)
      write_final_state(store.result(record.stage, record.key) / port.file,
                        store.beside(record.stage, record.key, ".final.h5"));
}

}  // namespace

std::string to_text(const Job& job) {
  return Json({{"store", job.store.string()},
               {"workflow", job.workflow.string()},
               {"set", job.overrides},
               {"stage", job.stage},
               {"key", job.key},
               {"threads", job.threads},
               {"final_state", job.final_state},
               {"allow", job.allowed_programs}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Job job_from(const std::string& text) {
  const auto json = parse_object(text);
  validate(json.has_value(), "'{}' is no job of a study", text);
  try {
    return {.store = json->at("store").get<std::string>(),
            .workflow = json->at("workflow").get<std::string>(),
            .overrides = json->at("set").get<std::vector<std::string>>(),
            .stage = json->at("stage"),
            .key = json->at("key"),
            .threads = json->at("threads"),
            .final_state = json->at("final_state"),
            .allowed_programs = json->at("allow").get<std::vector<std::string>>()};
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("'{}' is no job of a study ({})", text, e.what()));
  }
}

JobResult run_job(const Job& job, std::span<const StageType> types, const std::atomic<bool>* stop,
                  const Report& report) {
  const Store store(job.store);
  const Workflow workflow = load_workflow(job.workflow, job.overrides, types);
  const std::size_t index = index_of(workflow, job.stage);
  const WorkflowStage& stage = workflow.stages[index];
  for (const std::string& program : stage.prepared.programs)
    validate(std::find(job.allowed_programs.begin(), job.allowed_programs.end(), program) !=
                 job.allowed_programs.end(),
             "{}: would start '{}' without permission", stage.name, program);
  Results results(workflow, store);
  const std::string key = results.key(index);
  validate(key == job.key,
           "{}: its settings or inputs have changed since the study began (the row would not be what "
           "the table says). Run the study again.",
           stage.name);
  StageInputs inputs{.hashes = results.inputs(), .paths = {}, .files = {},
                     .warnings = results.warnings()};

  Locks locks(job.store);
  for (const Link& link : stage.inputs)
    if (!locks.take_shared(results.record(link.from_stage).key)) return {JobEnd::busy, {}};
  if (!locks.take(key)) return {JobEnd::busy, {}};
  const auto before = store.finished(stage.name, key);
  if (before && store.has_files(stage.name, key)) return {JobEnd::found, {}};

  if (const auto damaged = read_inputs(stage, workflow, results, store, inputs))
    return {JobEnd::damaged, *damaged};
  const Decision decision = decide(job.store, stage, inputs.hashes, std::nullopt);
  Finished finished;
  if (decision.action == Action::reuse) {
    finished.record = *decision.record;
    remove_work_folder(job.store, work_folder(job.store, stage.name, key));
  } else {
    const RunOptions options{.folder = job.store, .threads = job.threads, .stop_requested = stop};
    RunEvents events;
    events.progress = [&](std::string_view, double fraction, std::string_view text) {
      report(fraction, text);
    };
    finished.record = run_stage(stage, decision, inputs, options, events).record;
  }
  finished.peak_memory = peak_memory();
  expect_same(before, finished.record);
  if (job.final_state) keep_final_state(store, finished.record, stage.type);
  store.write(finished);
  store.forget_failure(stage.name, key);
  return {decision.action == Action::reuse ? JobEnd::found : JobEnd::made, {}};
}

JobResult run_job_aloud(const Job& job, std::span<const StageType> types,
                        const std::atomic<bool>* stop) {
  using Clock = std::chrono::steady_clock;
  auto told = Clock::now() - std::chrono::seconds(1);
  const JobResult result = run_job(job, types, stop, [&](double fraction, std::string_view text) {
    if (Clock::now() - told < std::chrono::milliseconds(200)) return;
    told = Clock::now();
    fmt::print("progress {:.4f} {}\n", fraction, text);
    std::fflush(stdout);
  });
  switch (result.end) {
    case JobEnd::made:
      fmt::print("made\n");
      break;
    case JobEnd::found:
      fmt::print("found\n");
      break;
    case JobEnd::busy:
      fmt::print("busy\n");
      break;
    case JobEnd::damaged:
      fmt::print("damaged {}\n", result.stage);
      break;
  }
  std::fflush(stdout);
  return result;
}

}  // namespace flowslide::study
