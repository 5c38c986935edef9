#include "workflows/engine/cache.hpp"

#include "workflows/engine/program_version.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/session.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

struct CanonicalSetting {
  std::string path, value;
};

/// Lines "path = value" in their order; a line without " = " continues the value before it.
std::vector<CanonicalSetting> settings_of(const std::string& canonical) {
  std::vector<CanonicalSetting> settings;
  std::istringstream in(canonical);
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(" = ");
    if (at != std::string::npos)
      settings.push_back({line.substr(0, at), line.substr(at + 3)});
    else if (!settings.empty())
      settings.back().value += "\n" + line;
  }
  return settings;
}

const CanonicalSetting* find(const std::vector<CanonicalSetting>& settings,
                             const std::string& path) {
  const auto it = std::find_if(settings.begin(), settings.end(),
                               [&](const CanonicalSetting& s) { return s.path == path; });
  return it == settings.end() ? nullptr : &*it;
}

bool is_content_hash(const std::string& value) { return value.starts_with("sha256:"); }

std::string brief(const std::string& value) {
  return value.size() <= 32 ? value : value.substr(0, 29) + "...";
}

std::string explain(const WorkflowStage& stage, const std::map<std::string, std::string>& inputs,
                    const std::optional<StageRecord>& previous) {
  if (!previous) return "no result yet";
  if (previous->uses != stage.type.name)
    return fmt::format("the stage is now {}, was {}", stage.type.name, previous->uses);
  if (previous->version != stage.type.version)
    return fmt::format("program's stage version changed {} -> {}", previous->version,
                       stage.type.version);
  if (previous->settings != stage.prepared.settings)
    return fmt::format("settings changed ({})",
                       describe_changes(previous->settings, stage.prepared.settings));
  std::vector<std::string> changed;
  for (const auto& [port, hash] : inputs) {
    const auto before = previous->inputs.find(port);
    if (before == previous->inputs.end() || before->second != hash) changed.push_back(port);
  }
  if (!changed.empty()) return fmt::format("input changed ({})", fmt::join(changed, ", "));
  return "result is missing";
}

/// Does the record belong to this stage and name all that the stage puts out?
bool fits(const StageRecord& record, const WorkflowStage& stage, const std::string& key) {
  return record.stage == stage.name && record.key == key &&
         std::all_of(stage.type.outputs.begin(), stage.type.outputs.end(), [&](const Port& port) {
           return std::any_of(record.outputs.begin(), record.outputs.end(),
                              [&](const OutputRecord& o) {
                                return o.port == port.name && o.file == port.file &&
                                       o.sha256 == content_hash(record.files, o.file);
                              });
         });
}

/// "flowslide 0.1.0 (f6e9070)" -> "0.1.0 f6e9070"
std::string short_version(std::string program) {
  std::erase_if(program, [](char c) { return c == '(' || c == ')'; });
  const std::size_t space = program.find(' ');
  return space == std::string::npos ? program : program.substr(space + 1);
}

/// Looks at what lies under the name of the result; fills record and files, or problems.
void look_at_result(Decision& decision, const fs::path& folder, const WorkflowStage& stage,
                    const Between& between) {
  RecordRead read = read_stage_record(folder);
  if (read.record && !fits(*read.record, stage, decision.key))
    read = {{}, fmt::format("{} is that of another result", kRecordFile)};
  if (!read.record) {
    if (!read.problem.empty()) decision.problems.push_back(read.problem);
    return;
  }
  Verified verified = verify(*read.record, folder, between);
  decision.problems = std::move(verified.problems);
  if (!decision.problems.empty()) return;
  decision.record = std::move(read.record);
  decision.files = std::move(verified.files);
}

}  // namespace

std::string describe_changes(const std::string& before, const std::string& now) {
  const std::vector<CanonicalSetting> old_settings = settings_of(before),
                                      new_settings = settings_of(now);
  std::vector<std::string> changes;
  for (const CanonicalSetting& s : new_settings) {
    const CanonicalSetting* old = find(old_settings, s.path);
    if (!old)
      changes.push_back(fmt::format("{} = {} is new", s.path, brief(s.value)));
    else if (old->value != s.value && is_content_hash(s.value) && is_content_hash(old->value))
      changes.push_back(fmt::format("content of {}", s.path));
    else if (old->value != s.value)
      changes.push_back(fmt::format("{} {} -> {}", s.path, brief(old->value), brief(s.value)));
  }
  for (const CanonicalSetting& s : old_settings)
    if (!find(new_settings, s.path)) changes.push_back(fmt::format("{} is gone", s.path));
  constexpr std::size_t kShown = 3;
  if (changes.size() > kShown) {
    const std::size_t rest = changes.size() - kShown;
    changes.resize(kShown);
    changes.push_back(fmt::format("and {} more", rest));
  }
  return fmt::format("{}", fmt::join(changes, ", "));
}

Decision decide(const fs::path& run_folder, const WorkflowStage& stage,
                const std::map<std::string, std::string>& inputs,
                const std::optional<StageRecord>& previous, const Between& between) {
  Decision decision;
  for (const Link& link : stage.inputs) {
    if (inputs.contains(link.port)) continue;
    decision.action = Action::undecided;
    decision.why = explain(stage, {}, previous);
    if (decision.why == "result is missing")
      decision.why = fmt::format("input may change ({})", link.port);
    return decision;
  }
  decision.key = stage_key(stage.type, stage.prepared.settings, inputs);
  look_at_result(decision, result_folder(run_folder, stage.name, decision.key), stage, between);
  if (decision.record) {
    decision.action = Action::reuse;
    decision.why = "up to date";
    std::vector<std::string> remarks;
    if (!previous || previous->key != decision.key)
      remarks.emplace_back("earlier result with these settings");
    if (decision.record->program != program_version())
      remarks.push_back(fmt::format("made by {}; --redo {} runs it again",
                                    short_version(decision.record->program), stage.name));
    if (!remarks.empty()) decision.why += fmt::format(" ({})", fmt::join(remarks, ", "));
    return decision;
  }
  decision.why = decision.problems.empty() ? explain(stage, inputs, previous)
                                           : "result was damaged: " + decision.problems.front();
  if (!stage.type.checkpoints) return decision;
  SessionRead read = read_session(work_folder(run_folder, stage.name, decision.key));
  if (read.session && is_touched(*read.session, stage.prepared.files))
    read = {{}, "an input file was written since it was killed"};
  if (read.session) {
    decision.action = Action::resume;
    decision.why = "continues an interrupted run";
  } else if (!read.problem.empty()) {
    decision.why = fmt::format("starts over ({})", read.problem);
    decision.problems.push_back("the interrupted run cannot be continued: " + read.problem);
  }
  return decision;
}

}  // namespace flowslide
