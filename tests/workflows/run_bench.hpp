#pragma once
#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/runner.hpp"

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace flowslide::sample {

/// A run folder and a workflow of three stages: one, two -> sum.
struct RunBench {
  Scratch scratch;
  std::filesystem::path out = scratch / "out";
  std::vector<StageType> types = stages();
  std::string note = "first note";
  std::map<std::string, std::string> why;  ///< of the last run, by stage
  std::vector<std::string> ran, notices;   ///< of the last run
  std::function<void(std::string_view stage)> before_stage = [](std::string_view) {};
  std::function<void(const std::string& stage)> meanwhile = [](const std::string&) {};
  std::vector<std::string> redo;

  Workflow load(const std::vector<std::string>& set = {}) {
    if (read_text_file(scratch / "note.txt") != note) scratch.write("note.txt", note);
    return load_workflow(
        scratch.write("case.yaml",
                      "schema: 1\nname: demo\nstages:\n"
                      "  one: {uses: sample.number, with: {value: 1, note: note.txt}}\n"
                      "  two: {uses: sample.number, with: {value: 2}}\n"
                      "  sum: {uses: sample.sum, in: {a: one.number, b: two.number}}\n"),
        set, types);
  }
  Workflow load_watched(const std::vector<std::string>& set) {
    Workflow workflow = load(set);
    for (WorkflowStage& stage : workflow.stages)
      stage.prepared.run = [this, name = stage.name, run = stage.prepared.run](
                               const RunContext& context, const PortPaths& paths) {
        meanwhile(name);
        return run(context, paths);
      };
    return workflow;
  }
  void run(const std::vector<std::string>& set = {}) {
    why.clear();
    ran.clear();
    notices.clear();
    RunEvents events;
    events.decided = [&](std::string_view stage, const Decision& d) {
      why[std::string(stage)] = d.why;
      if (d.action == Action::reuse) return;
      ran.emplace_back(stage);
      before_stage(stage);
    };
    events.notice = [&](std::string_view text) { notices.emplace_back(text); };
    run_workflow(load_watched(set), {.folder = out, .redo = redo}, events);
  }
  /// Lets `act` happen when a stage has begun, before it reads anything.
  void during(const std::string& stage, const std::function<void()>& act) {
    meanwhile = [=](const std::string& name) {
      if (name == stage) act();
    };
  }
  [[nodiscard]] nlohmann::json result() const {
    return nlohmann::json::parse(read_text_file(out / "result.json"));
  }
  [[nodiscard]] std::filesystem::path folder(std::size_t stage) {
    const auto plan = plan_workflow(load(), out);
    return result_folder(out, plan[stage].stage, plan[stage].decision.key);
  }
  [[nodiscard]] std::string told() const {
    std::string text;
    for (const std::string& notice : notices) text += notice + "\n";
    return text;
  }
};

/// All below a folder that does not depend on the time a run takes: contents of files, targets of
/// links, and of records what they found.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    const std::string file = entry.path().filename().string();
    if (entry.is_symlink()) {
      all[name] = "-> " + std::filesystem::read_symlink(entry.path()).string();
    } else if (entry.is_regular_file()) {
      const bool record = file == "stage.json" || file == "run.lock" || file == "result.json";
      all[name] = record ? "record" : read_text_file(entry.path());
    }
  }
  const auto result = nlohmann::json::parse(read_text_file(folder / "result.json"));
  for (const auto& [name, value] : result.items())
    if (name != "wall" && name != "wall_s" && name != "stages" && name != "sha256")
      all["result.json:" + name] = value.dump();
  return all;
}

}  // namespace flowslide::sample
