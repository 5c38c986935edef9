#include "workflows/engine/stage_inputs.hpp"

#include "workflows/engine/earlier.hpp"
#include "workflows/engine/warnings.hpp"

namespace flowslide {

StageInputs inputs_before(const Workflow& workflow, const WorkflowStage& stage,
                          const std::vector<const StageRecord*>& results,
                          const std::filesystem::path& run_folder) {
  StageInputs inputs{.hashes = {}, .paths = {}, .files = {}};
  for (const Link& link : stage.inputs) {
    if (link.from_stage >= results.size() || !results[link.from_stage]) continue;
    for (const OutputRecord& output : results[link.from_stage]->outputs)
      if (output.port == link.from_port) inputs.hashes[link.port] = output.sha256;
  }
  inputs.warnings = earlier_warnings(workflow, stage, results);
  inputs.earlier = earlier_stages(workflow, stage, results, run_folder);
  add_to_inputs(inputs.hashes, stage, inputs.warnings);
  add_to_inputs(inputs.hashes, inputs.earlier);
  return inputs;
}

}  // namespace flowslide
