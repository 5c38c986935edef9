#pragma once
#include "workflows/engine/graph.hpp"
#include "workflows/engine/record.hpp"

#include <map>
#include <string>
#include <vector>

/// What a stage that tells of the whole run gets to know of the stages before it.
namespace flowslide {

/// By index of stage: true for those that feed `stage`, directly or not.
std::vector<bool> feeding_stages(const Workflow& workflow, const WorkflowStage& stage);

/// The stages that feed a stage with `reads_earlier`, in their order, none for other stages.
/// `results` holds those before it; null where a result is still to be made.
std::vector<EarlierStage> earlier_stages(const Workflow& workflow, const WorkflowStage& stage,
                                         const std::vector<const StageRecord*>& results,
                                         const std::filesystem::path& run_folder);

/// Lets the key of a stage change with the settings and results before it, as if they were an
/// input. Facts do not count: they follow from these, but for the times in them.
void add_to_inputs(std::map<std::string, std::string>& inputs,
                   const std::vector<EarlierStage>& earlier);
inline constexpr const char* kEarlierInput = "stages";

}  // namespace flowslide
