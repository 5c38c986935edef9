#pragma once
#include "workflows/engine/graph.hpp"
#include "workflows/engine/record.hpp"

#include <map>
#include <string>
#include <vector>

/// What a user must know before using the result of a stage. Warnings of a result are the array
/// "warnings" of its facts; those of settings are looked for whenever a workflow is loaded.
namespace flowslide {

/// Facts with the warnings in them; without any, and without that entry, as they are.
std::string add_warnings(const std::string& facts, const std::vector<std::string>& warnings);

/// Of the settings and, if there is one, of the result of a stage, each once.
std::vector<std::string> warnings_of(const WorkflowStage& stage, const StageRecord* result);

/// "stage: text" of all stages that feed a stage, directly or not, in their order. `results` holds
/// those before it; null where a result is still to be made.
std::vector<std::string> earlier_warnings(const Workflow& workflow, const WorkflowStage& stage,
                                          const std::vector<const StageRecord*>& results);

/// Lets the key of a stage that reads warnings change with them, as if they were an input.
void add_to_inputs(std::map<std::string, std::string>& inputs, const WorkflowStage& stage,
                   const std::vector<std::string>& earlier);
inline constexpr const char* kWarningsInput = "warnings";

}  // namespace flowslide
