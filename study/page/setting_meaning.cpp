#include "study/page/setting_meaning.hpp"

#include "workflows/stages/stage_list.hpp"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

namespace flowslide::study {
namespace {

std::vector<std::string> parts_of(std::string_view path) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    std::string part(path.substr(at, end - at));
    if (!part.empty() && part.back() != ']') parts.push_back(std::move(part));
    at = end + 1;
  }
  return parts;
}

/// Of a plan that was read from its record the types have only names.
std::string schema_of(const Plan& plan, const std::string& stage) {
  for (const Node& node : plan.nodes) {
    if (node.stage.name != stage) continue;
    if (node.stage.type.json_schema) return node.stage.type.json_schema();
    for (const StageType& type : all_stages())
      if (type.name == node.stage.type.name) return type.json_schema();
  }
  return "";
}

}  // namespace

std::string setting_meaning(const Plan& plan, std::string_view setting) {
  const std::vector<std::string> parts = parts_of(setting);
  if (parts.size() < 4 || parts[0] != "stages" || parts[2] != "with") return "";
  nlohmann::json here = nlohmann::json::parse(schema_of(plan, parts[1]), nullptr, false);
  for (std::size_t k = 3; k < parts.size(); ++k) {
    if (!here.is_object()) return "";
    if (here.contains("items") && !here.contains("properties"))
      here = nlohmann::json(here["items"]);
    const auto properties = here.find("properties");
    if (properties != here.end() && properties->contains(parts[k]))
      here = nlohmann::json((*properties)[parts[k]]);
    else if (here.contains("additionalProperties") && here["additionalProperties"].is_object())
      here = nlohmann::json(here["additionalProperties"]);
    else
      return "";
  }
  return here.is_object() ? here.value("description", "") : "";
}

}  // namespace flowslide::study
