#include "study/run/job.hpp"

#include "study/run/final_state.hpp"
#include "study/run/locks.hpp"
#include "study/run/study_state.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/engine/earlier.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/run_stage.hpp"
#include "workflows/engine/sealed_json.hpp"
#include "workflows/engine/session.hpp"
#include "workflows/engine/stage_inputs.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

/// A stage and the results of all that feed it, as the store knows them.
struct Ready {
  std::string key;
  StageInputs inputs;
  std::vector<std::optional<StageRecord>> results;  ///< by index of stage
};

/// Nothing where a stage before it has no result with the key that the workflow, as it now is,
/// gives it.
std::optional<Ready> look_up(const Workflow& workflow, std::size_t stage, const Store& store) {
  Ready ready;
  const std::vector<bool> feeds = feeding_stages(workflow, workflow.stages[stage]);
  ready.results.resize(stage);
  for (std::size_t i = 0; i <= stage; ++i) {
    if (i < stage && !feeds[i]) continue;
    const WorkflowStage& s = workflow.stages[i];
    std::vector<const StageRecord*> known;
    for (std::size_t k = 0; k < i; ++k)
      known.push_back(ready.results[k] ? &*ready.results[k] : nullptr);
    ready.inputs = inputs_before(workflow, s, known, store.folder());
    ready.key = stage_key(s.type, s.prepared.settings, ready.inputs.hashes);
    if (i == stage) break;
    auto finished = store.finished(s.name, ready.key);
    if (!finished) return std::nullopt;
    ready.results[i] = std::move(finished->record);
  }
  return ready;
}

/// The stages whose files a stage reads.
std::vector<std::size_t> read_stages(const Workflow& workflow, const WorkflowStage& stage) {
  std::vector<bool> reads(workflow.stages.size(), false);
  if (stage.type.reads_earlier) reads = feeding_stages(workflow, stage);
  for (const Link& link : stage.inputs) reads[link.from_stage] = true;
  std::vector<std::size_t> stages;
  for (std::size_t i = 0; i < reads.size(); ++i)
    if (reads[i]) stages.push_back(i);
  return stages;
}

/// Are the files of a result those of its record? `files` takes them.
bool is_whole(const StageRecord& from, const fs::path& folder, std::vector<HashedFile>& files) {
  const RecordRead read = read_stage_record(folder);
  if (!read.record || read.record->key != from.key) return false;
  Verified verified = verify(*read.record, folder);
  files = std::move(verified.files);
  return verified.problems.empty() &&
         std::all_of(from.outputs.begin(), from.outputs.end(), [&](const OutputRecord& promised) {
           return content_hash(read.record->files, promised.file) == promised.sha256;
         });
}

/// Reads the files of the inputs. The name of a stage whose files are not those of its record.
std::optional<std::string> read_inputs(const WorkflowStage& stage,
                                       const std::vector<std::size_t>& reads, Ready& ready,
                                       const Store& store) {
  for (const std::size_t index : reads) {
    const StageRecord& from = *ready.results[index];
    const fs::path folder = store.result(from.stage, from.key);
    std::vector<HashedFile> files;
    if (!is_whole(from, folder, files)) return from.stage;
    for (const Link& link : stage.inputs) {
      if (link.from_stage != index) continue;
      const auto output =
          std::find_if(from.outputs.begin(), from.outputs.end(),
                       [&](const OutputRecord& o) { return o.port == link.from_port; });
      ready.inputs.paths[link.port] = folder / output->file;
      for (HashedFile& file : files_of_output(files, folder / output->file))
        ready.inputs.files.push_back(std::move(file));
    }
  }
  return std::nullopt;
}

/// A result that was made again must be the one that was there: numbers of the table stand on it.
/// But for those that tell the day; no stage reads these.
void expect_same(const std::optional<Finished>& before, const StageRecord& now,
                 const StageType& type) {
  if (!before || type.dated) return;
  for (const OutputRecord& o : before->record.outputs)
    for (const OutputRecord& n : now.outputs)
      if (o.port == n.port && o.sha256 != n.sha256)
        throw NumericsError(fmt::format(
            "{}: the same settings and inputs gave another '{}' than before (results of "
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

namespace {

JobResult run_in(const Job& job, const Workflow& workflow, const std::atomic<bool>* stop,
                 const Report& report) {
  const Store store(job.store);
  const auto found = std::find_if(workflow.stages.begin(), workflow.stages.end(),
                                  [&](const WorkflowStage& s) { return s.name == job.stage; });
  if (found == workflow.stages.end()) return {JobEnd::changed, {}};
  const WorkflowStage& stage = *found;
  auto ready = look_up(workflow, static_cast<std::size_t>(found - workflow.stages.begin()), store);
  if (!ready || ready->key != job.key) return {JobEnd::changed, {}};
  const std::string& key = ready->key;
  for (const std::string& program : stage.prepared.programs)
    validate(std::find(job.allowed_programs.begin(), job.allowed_programs.end(), program) !=
                 job.allowed_programs.end(),
             "{}: would start '{}' without permission", stage.name, program);

  Locks locks(job.store);
  const std::vector<std::size_t> reads = read_stages(workflow, stage);
  for (const std::size_t index : reads)
    if (!locks.take_shared(ready->results[index]->key)) return {JobEnd::busy, {}};
  if (!locks.take(key)) return {JobEnd::busy, {}};
  const auto before = store.finished(stage.name, key);
  if (before && store.has_files(stage.name, key)) return {JobEnd::found, {}};

  if (const auto damaged = read_inputs(stage, reads, *ready, store))
    return {JobEnd::damaged, *damaged};
  const Decision decision = decide(job.store, stage, ready->inputs.hashes, std::nullopt);
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
    finished.record = run_stage(stage, decision, ready->inputs, options, events).record;
  }
  finished.peak_memory = peak_memory();
  expect_same(before, finished.record, stage.type);
  if (job.final_state) keep_final_state(store, finished.record, stage.type);
  store.write(finished);
  store.forget_failure(stage.name, key);
  return {decision.action == Action::reuse ? JobEnd::found : JobEnd::made, {}};
}

}  // namespace

JobResult run_job(const Job& job, std::span<const StageType> types, const std::atomic<bool>* stop,
                  const Report& report) {
  std::optional<Workflow> workflow;
  try {
    workflow = load_workflow(job.workflow, job.overrides, types);
  } catch (const InputError&) {
    // It could be read when the study was planned.
    return {JobEnd::changed, {}};
  }
  return run_in(job, *workflow, stop, report);
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
    case JobEnd::changed:
      fmt::print("changed\n");
      break;
    case JobEnd::damaged:
      fmt::print("damaged {}\n", result.stage);
      break;
  }
  std::fflush(stdout);
  return result;
}

}  // namespace flowslide::study
