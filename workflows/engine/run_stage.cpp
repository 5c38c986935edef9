#include "workflows/engine/run_stage.hpp"

#include "core/check.hpp"
#include "core/clock.hpp"
#include "core/files.hpp"
#include "workflows/engine/earlier.hpp"
#include "workflows/engine/headlines.hpp"
#include "workflows/engine/program_version.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/session.hpp"
#include "workflows/engine/warnings.hpp"

#include <stdexcept>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// The time that sessions spend in a work folder, kept there for the next one.
class Stopwatch {
 public:
  Stopwatch(fs::path work, const WorkflowStage& stage)
      : work_(std::move(work)), stage_(stage), start_(Clock::now()), written_(start_) {}

  void continue_from(double seconds) { before_ = seconds; }
  [[nodiscard]] double seconds() const { return before_ + seconds_since(start_); }
  void write(bool ended) {
    if (!stage_.type.checkpoints) return;
    write_session(work_, seconds(), stage_.prepared.files, ended);
    written_ = Clock::now();
  }
  /// Seldom enough to cost nothing: a write waits for the disk.
  void write_if_due() {
    if (seconds_since(written_) > 30.0) write(false);
  }

 private:
  fs::path work_;
  const WorkflowStage& stage_;
  double before_ = 0.0;
  Clock::time_point start_, written_;
};

/// Makes the folder as the decision wants it; returns the seconds spent there before.
double prepare_folder(const fs::path& work, const fs::path& run_folder, bool resume) {
  make_work_folder(run_folder, work, resume);
  if (!resume) return 0.0;
  remove_leftovers(work);
  const SessionRead read = read_session(work);
  return read.session ? read.session->seconds : 0.0;
}

[[noreturn]] void fail(const WorkflowStage& stage, int exit_code, const std::string& text) {
  throw Error(exit_code, fmt::format("{}: {}", stage.name, text));
}

/// stage.prepared.run with the stage's name in front of what it throws. What was computed from an
/// input that has changed is not kept, whatever else went wrong.
StageResult call(const WorkflowStage& stage, const RunContext& context, const StageInputs& inputs,
                 const PortPaths& paths, Stopwatch& watch) {
  const auto look = [&](void (*expect)(const HashedFile&)) {
    try {
      for (const HashedFile& file : stage.prepared.files) expect(file);
      for (const HashedFile& file : inputs.files) expect(file);
    } catch (const FileError& e) {
      remove_path(context.folder);
      fail(stage, e.exit_code(), e.what());
    }
  };
  look(expect_same_state);
  StageResult result;
  try {
    result = stage.prepared.run(context, paths);
  } catch (const Error& e) {
    look(expect_unchanged);
    watch.write(true);
    fail(stage, e.exit_code(), e.what());
  } catch (const fs::filesystem_error& e) {
    fail(stage, 4, fmt::format("'{}': {}", e.path1().string(), e.code().message()));
  }
  look(expect_unchanged);
  return result;
}

void expect_output(const WorkflowStage& stage, const Port& port, const fs::path& work) {
  if (is_there(work / port.file)) return;
  throw std::logic_error(fmt::format("stage {} did not write {}", stage.name, port.file));
}

/// What a session that was killed at its very end has left; the session file stays to the last.
void clean(const fs::path& work) {
  remove_leftovers(work);
  remove_path(work / kRecordFile);
  remove_path(work / kFactsFile);
}

std::vector<HashedFile> as_hashed(const StageRecord& record, const fs::path& folder) {
  std::vector<HashedFile> files;
  for (const FileRecord& file : record.files)
    files.push_back({folder / file.name, file.sha256, file_state(folder / file.name)});
  return files;
}

}  // namespace

StageState run_stage(const WorkflowStage& stage, const Decision& decision,
                     const StageInputs& inputs, const RunOptions& options,
                     const RunEvents& events) {
  const fs::path work = work_folder(options.folder, stage.name, decision.key);
  const fs::path final = result_folder(options.folder, stage.name, decision.key);
  Stopwatch watch(work, stage);
  watch.continue_from(prepare_folder(work, options.folder, decision.action == Action::resume));
  watch.write(false);

  PortPaths paths = inputs.paths;
  for (const Port& port : stage.type.outputs) paths[port.name] = work / port.file;
  RunContext context{.folder = work,
                     .threads = options.threads,
                     .progress = {},
                     .provenance = {{"program", program_version()}, {"stage key", decision.key}},
                     .warnings = inputs.warnings,
                     .earlier = inputs.earlier};
  for (const auto& [port, hash] : inputs.hashes)
    if (port != kWarningsInput && port != kEarlierInput)
      context.provenance.emplace_back("sha256 of " + port, hash);
  context.progress.stop_requested = options.stop_requested;
  context.progress.report = [&](Share share, std::string_view text) {
    events.progress(stage.name, share, text);
    watch.write_if_due();
  };
  const StageResult result = call(stage, context, inputs, paths, watch);

  StageRecord record{
      .stage = stage.name,
      .uses = stage.type.name,
      .version = stage.type.version,
      .key = decision.key,
      .settings = stage.prepared.settings,
      .inputs = inputs.hashes,
      .outputs = {},
      .files = {},
      .publish = result.publish,
      .give = result.give,
      .facts = add_headlines(add_warnings(result.facts, result.warnings), result.headlines),
      .program = program_version(),
      .seconds = watch.seconds()};
  for (const Port& port : stage.type.outputs) expect_output(stage, port, work);
  clean(work);
  sync_tree(work);
  record.files = list_files(work);
  std::erase_if(record.files, [](const FileRecord& f) { return f.name == kSessionFile; });
  for (const Port& port : stage.type.outputs)
    record.outputs.push_back({port.name, port.file, content_hash(record.files, port.file)});
  write_record(work, record);
  install_result(work, final);
  remove_path(final / kSessionFile);  // not before: a kill during the last sync continues there
  return {record, as_hashed(record, final)};
}

}  // namespace flowslide
