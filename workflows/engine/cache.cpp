#include "workflows/engine/cache.hpp"

#include "workflows/engine/run_folder.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

struct Setting {
  std::string path, value;
};

/// Lines "path = value" in their order; a line without " = " continues the value before it.
std::vector<Setting> settings_of(const std::string& canonical) {
  std::vector<Setting> settings;
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

const Setting* find(const std::vector<Setting>& settings, const std::string& path) {
  const auto it = std::find_if(settings.begin(), settings.end(),
                               [&](const Setting& s) { return s.path == path; });
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

}  // namespace

std::string describe_changes(const std::string& before, const std::string& now) {
  const std::vector<Setting> old_settings = settings_of(before), new_settings = settings_of(now);
  std::vector<std::string> changes;
  for (const Setting& s : new_settings) {
    const Setting* old = find(old_settings, s.path);
    if (!old)
      changes.push_back(fmt::format("{} = {} is new", s.path, brief(s.value)));
    else if (old->value != s.value && is_content_hash(s.value) && is_content_hash(old->value))
      changes.push_back(fmt::format("content of {}", s.path));
    else if (old->value != s.value)
      changes.push_back(fmt::format("{} {} -> {}", s.path, brief(old->value), brief(s.value)));
  }
  for (const Setting& s : old_settings)
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
                const std::optional<StageRecord>& previous) {
  for (const Link& link : stage.inputs) {
    if (inputs.contains(link.port)) continue;
    const std::string why = explain(stage, {}, previous);
    return {Action::undecided,
            why == "result is missing" ? fmt::format("input may change ({})", link.port) : why,
            {},
            {}};
  }
  Decision decision{Action::run, {}, stage_key(stage.type, stage.prepared.settings, inputs), {}};
  const fs::path folder = result_folder(run_folder, stage.name, decision.key);
  decision.record = read_record(folder);
  if (decision.record && decision.record->key == decision.key) {
    const auto harm = damage(*decision.record, folder);
    if (!harm) {
      const bool current = previous && previous->key == decision.key;
      decision.action = Action::reuse;
      decision.why = current ? "up to date" : "up to date (earlier result with these settings)";
      return decision;
    }
    decision.why = *harm;
  } else {
    decision.why = explain(stage, inputs, previous);
  }
  decision.record.reset();
  if (stage.type.checkpoints && fs::exists(work_folder(run_folder, stage.name, decision.key))) {
    decision.action = Action::resume;
    decision.why = "continues an interrupted run";
  }
  return decision;
}

}  // namespace flowslide
