#include "workflows/engine/warnings.hpp"

#include "core/hash.hpp"
#include "workflows/engine/earlier.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWarningsKey = "warnings";

std::vector<std::string> read_warnings(const std::string& facts) {
  std::vector<std::string> warnings;
  const Json json = Json::parse(facts, nullptr, false);
  if (!json.is_object() || !json.contains(kWarningsKey) || !json[kWarningsKey].is_array())
    return warnings;
  for (const Json& text : json[kWarningsKey])
    if (text.is_string()) warnings.push_back(text.get<std::string>());
  return warnings;
}

}  // namespace

std::string add_warnings(const std::string& facts, const std::vector<std::string>& warnings) {
  Json json = Json::parse(facts, nullptr, false);
  if (!json.is_object() || (warnings.empty() && !json.contains(kWarningsKey))) return facts;
  json[kWarningsKey] = warnings;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> warnings_of(const WorkflowStage& stage, const StageRecord* result) {
  std::vector<std::string> all = stage.warnings;
  if (!result) return all;
  for (std::string& text : read_warnings(result->facts))
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(std::move(text));
  return all;
}

std::vector<std::string> earlier_warnings(const Workflow& workflow, const WorkflowStage& stage,
                                          const std::vector<const StageRecord*>& results) {
  const std::vector<bool> feeds = feeding_stages(workflow, stage);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (feeds[i])
      for (const std::string& text : warnings_of(workflow.stages[i], results[i]))
        all.push_back(fmt::format("{}: {}", workflow.stages[i].name, text));
  return all;
}

void add_to_inputs(std::map<std::string, std::string>& inputs, const WorkflowStage& stage,
                   const std::vector<std::string>& earlier) {
  if (stage.type.reads_warnings && !earlier.empty())
    inputs[kWarningsInput] = sha256(fmt::format("{}", fmt::join(earlier, "\n")));
}

}  // namespace flowslide
