#include "workflows/engine/earlier.hpp"

#include "core/hash.hpp"
#include "workflows/engine/result_folder.hpp"

#include <fmt/format.h>

namespace flowslide {

std::vector<bool> feeding_stages(const Workflow& workflow, const WorkflowStage& stage) {
  std::vector<bool> feeds(workflow.stages.size(), false);
  for (const Link& link : stage.inputs) feeds[link.from_stage] = true;
  for (std::size_t i = feeds.size(); i-- > 0;)
    if (feeds[i])
      for (const Link& link : workflow.stages[i].inputs) feeds[link.from_stage] = true;
  return feeds;
}

std::vector<EarlierStage> earlier_stages(const Workflow& workflow, const WorkflowStage& stage,
                                         const std::vector<const StageRecord*>& results,
                                         const std::filesystem::path& run_folder) {
  std::vector<EarlierStage> earlier;
  if (!stage.type.reads_earlier) return earlier;
  const std::vector<bool> feeds = feeding_stages(workflow, stage);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!feeds[i] || !results[i]) continue;
    const StageRecord& r = *results[i];
    EarlierStage& e = earlier.emplace_back(EarlierStage{r.stage, r.uses, r.settings, r.facts, {}});
    for (const OutputRecord& o : r.outputs)
      e.outputs[o.port] = {result_folder(run_folder, r.stage, r.key) / o.file, o.sha256};
  }
  return earlier;
}

void add_to_inputs(std::map<std::string, std::string>& inputs,
                   const std::vector<EarlierStage>& earlier) {
  if (earlier.empty()) return;
  std::string text;
  for (const EarlierStage& e : earlier) {
    text += fmt::format("{}\n{}\n{}\n", e.name, e.uses, e.settings);
    for (const auto& [port, output] : e.outputs)
      text += fmt::format("{} {}\n", port, output.sha256);
  }
  inputs[kEarlierInput] = sha256(text);
}

}  // namespace flowslide
