#include "config/manual.hpp"
#include "config/yaml.hpp"
#include "importers/opensees.hpp"
#include "mpm/run/flow_config.hpp"
#include "report/config.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/sordo2024/map_sordo2024.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/stages/fem_run.hpp"
#include "workflows/stages/stage_list.hpp"

#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

/// What reading these settings says.
template <class T>
std::string problem(const std::string& text) {
  const Scratch scratch;
  scratch.write("with.yaml", text);
  try {
    (void)read_settings<T>(load_yaml(scratch / "with.yaml"), "");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

constexpr const char* kOlder = "is written as in an older version";

}  // namespace

TEST_CASE("settings of older versions are refused with their new spelling", "[workflows]") {
  CHECK_THAT(problem<ZoneConfig>("densities: [[168, 1870 kg/m3]]"),
             Contains("'densities' " + std::string(kOlder)) &&
                 Contains("'materials: {tailings: {tag: 168, density: 1870 kg/m3}}'"));
  const std::string map = problem<MapConfig>(
      "cell: 1 m\nbox: [0 m, 1 m, 0 m, 1 m]\ncompat: sordo2024\nsordo2024: {frame: 3}\n"
      "materials: {dam: {tags: [1], density: 2 t/m3, linear_elastic: {youngs_modulus: 1 MPa, "
      "poisson_ratio: 0.2}}}");
  CHECK_THAT(map, Contains("'tags' " + std::string(kOlder)) && Contains("'of: [clay, silt]'"));
  CHECK_THAT(map, Contains("'density' " + std::string(kOlder)));
  CHECK_THAT(map, Contains("'box' " + std::string(kOlder)) &&
                      Contains("'box: {left: -340 m, right: 87.5 m, bottom: -5 m, top: 100 m}'"));
  CHECK_THAT(map,
             Contains("'compat' " + std::string(kOlder)) && Contains("'uses: transfer.sordo2024'"));
  CHECK(map.find("unknown key") == std::string::npos);
  CHECK_THAT(problem<SordoTransferConfig>("cell: 1 m\nframe: 3\n"),
             Contains("'frame' " + std::string(kOlder)) && Contains("'when: at, at: 7.01 s'"));
  CHECK_THAT(problem<FlowConfig>("cell: 1 m\nend: 1 s\ntoe: 75 m\n"),
             Contains("'toe' " + std::string(kOlder)) &&
                 Contains("'uses: report.runout, with: {toe: 75 m}'"));
  const std::string report =
      problem<ReportConfig>("rest_kinetic: 0.1\nrest_front: 1 m\nrest_window: 5 s\nliquefied: a\n");
  for (const char* key : {"rest_kinetic", "rest_front", "rest_window", "liquefied"})
    CHECK_THAT(report, Contains(fmt::format("'{}' {}", key, kOlder)));
  CHECK_THAT(report, Contains("in mpm.run"));
  CHECK_THAT(problem<OpenSeesConfig>("{}"), !Contains(kOlder));  // control
}

TEST_CASE("all settings of transfer.zone may stand under stop_at_transfer", "[workflows]") {
  // A reference to all of them must not fail for a key that only the zone has.
  const auto keys = nlohmann::json::parse(json_schema<ZoneConfig>())["properties"];
  CHECK(keys.size() > 12);
  for (const auto& [key, unused] : keys.items()) {
    CAPTURE(key);
    CHECK(problem<StopAtTransferConfig>(key + ": {}").find("unknown key") == std::string::npos);
  }
  CHECK_THAT(problem<StopAtTransferConfig>("colour: {}"), Contains("unknown key"));  // control
}

TEST_CASE("the shipped workflows say once what decides two stages", "[workflows]") {
  for (const char* name : {"mochikoshi", "mochikoshi-opensees", "mochikoshi-static"}) {
    CAPTURE(name);
    std::ifstream file(test::source(fmt::format("workflows/{}.yaml", name)));
    std::map<std::string, int> count;
    int lines = 0;
    for (std::string line; std::getline(file, line); ++lines)
      for (const char* once : {"1870 kg/m3", "1690 kg/m3", "1900 kg/m3", "168", "167", "170",
                               "box: {", "pond_surface", "crest: {"})
        count[once] += line.find(once) != std::string::npos;
    CHECK(lines < 140);
    for (const auto& [text, n] : count) {
      CAPTURE(text);
      CHECK(n == 1);
    }
  }
  // and the two rules are one: no stage has anything to say
  const Workflow w = load_workflow(test::source("workflows/mochikoshi.yaml"), {}, all_stages());
  for (const WorkflowStage& stage : w.stages)
    for (const std::string& text : stage.warnings)
      CHECK(text.find("another rule") == std::string::npos);
  const std::vector<std::string> apart{
      "stages.shake.with.stop_at_transfer={liquefiable: [tailings], pond_surface: 20 m}"};
  const Workflow other =
      load_workflow(test::source("workflows/mochikoshi.yaml"), apart, all_stages());
  std::string said;
  for (const WorkflowStage& stage : other.stages)
    for (const std::string& text : stage.warnings) said += text;
  CHECK_THAT(said, Contains("another rule") && Contains("pond_surface 20 m -> 30 m"));
}
