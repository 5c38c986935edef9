#include "workflows/engine/headlines.hpp"
#include "workflows/engine/program_version.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// Names at the top that no stage can claim.
constexpr std::array<std::string_view, 9> kReserved{
    "schema", "program", "workflow", "wall_s", "wall", "stages", "sha256", "warnings", "headlines"};

}  // namespace

std::string result_json(const Workflow& workflow, const std::vector<StageOutcome>& outcomes,
                        double overhead) {
  Json result = {{"schema", 1}, {"program", program_version()}, {"workflow", workflow.name}};

  Json stages = Json::object(), warnings = Json::array();
  std::map<std::string, std::string> found_by;  // type of stage, by name of the fact
  std::vector<std::string> all_facts;
  double stage_seconds = 0.0;
  for (const auto& [record, decision] : outcomes) {
    stage_seconds += record.seconds;
    all_facts.push_back(record.facts);
    Json facts = Json::parse(record.facts);
    facts.erase("headlines");
    for (const std::string& text : decision.warnings)
      warnings.push_back(fmt::format("{}: {}", record.stage, text));
    stages[record.stage] = {{"uses", record.uses},
                            {"seconds", record.seconds},
                            {"cached", decision.action == Action::reuse},
                            {"why", decision.why},
                            {"key", record.key},
                            {"program", record.program},
                            {"facts", facts}};
    for (const auto& [name, value] : facts.items()) {
      if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) continue;
      if (value.is_null()) continue;
      const bool ambiguous = found_by[name] == record.uses && result[name] != value;
      result[name] = ambiguous ? Json(nullptr) : value;
      found_by[name] = record.uses;
    }
  }
  result["warnings"] = warnings;
  result["headlines"] = Json::parse(add_headlines("{}", merged_headlines(all_facts)))
                            .value("headlines", Json::array());
  result["wall_s"] = stage_seconds + overhead;
  result["wall"] = {{"stages_s", stage_seconds},
                    {"overhead_s", overhead},
                    {"meaning",
                     "stages_s: the sessions that computed these stages, whenever that was; "
                     "overhead_s: this call outside the stages; wall_s: their sum"}};
  result["stages"] = stages;
  return seal(result);
}

}  // namespace flowslide
