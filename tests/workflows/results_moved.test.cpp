#include "tests/support/paths.hpp"
#include "tests/support/scratch.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/stages/stage_list.hpp"

#include <cmath>
#include <cstdlib>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace flowslide;
namespace fs = std::filesystem;

namespace {

/// What a stage found may move by this much of its size while its version stays: results have the
/// same bits on every processor, but a build with other flags may turn the last ones.
constexpr double kTolerance = 1e-6, kSmall = 1e-12;
/// What is left of sums that should be zero, over what was added, is rounding up to here: its size
/// means nothing, and another build has another.
constexpr double kResidual = 1e-7;

const std::string kDam = test::fixture("opensees/dam-rio270/");
const std::string kImport =
    "schema: 1\nname: imports\nstages:\n"
    "  shake:\n    uses: import.opensees\n    with:\n"
    "      mesh: {nodes: " +
    kDam + "nodeinfo.dat, elements: " + kDam +
    "elementinfo.dat}\n"
    "      materials: {embankment: {tag: 167, density: 1690 kg/m3}, tailings: {tag: 168, density: "
    "1870 kg/m3}, foundation: {tag: 170, density: 1900 kg/m3}}\n"
    "      units: {length: m, time: s, stress: kPa}\n"
    "      gravity: {stress: " +
    kDam + "Gstress.out, strain: " + kDam +
    "Gstrain.out, "
    "pore_pressure: " +
    kDam +
    "GporePressure.out}\n"
    "  mesh:\n    uses: import.mesh\n    with: {gmsh: square.msh}\n"
    "  zone:\n    uses: transfer.zone\n    in: {history: shake.history}\n"
    "    with: {when: gravity, zone: all, liquefiable: [tailings], pond_surface: 30 m, "
    "strength: {table: [[25 kPa, 3 kPa], [325 kPa, 12 kPa]]}}\n"
    "  script:\n    uses: transfer.sordo2024\n"
    "    in: {history: shake.history, zone: zone.zone}\n    with: {cell: 5 m}\n";

constexpr const char* kSquare =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
    "$Elements\n3\n1 3 2 1 1 1 2 5 4\n2 3 2 1 1 2 3 6 5\n3 1 2 7 7 1 2\n$EndElements\n";

bool is_clock(const std::string& key) {
  return key.ends_with("_seconds") || key.ends_with("_per_s");
}

bool is_residual(const std::string& key) {
  for (const char* name : {"error", "out_of_balance", "violation_after"})
    if (key.ends_with(name)) return true;
  return false;
}

/// All JSON files of a result but its record, without what a clock measured.
Json facts_of(const fs::path& folder) {
  Json all = Json::object();
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().extension() != ".json" || file.path().filename() == "stage.json") continue;
    const Json found = Json::parse(read_text_file(file.path()));
    for (const auto& [key, value] : found.items())
      if (!is_clock(key)) all[key] = value;
  }
  return all;
}

/// Adds version and facts of the stages of a workflow by type; of those that a case is about by
/// type and name of the case, if it has one.
struct Case {
  std::string name;
  std::set<std::string> of_types;
};
void run_case(const fs::path& file, const std::vector<std::string>& changes, const fs::path& folder,
              Json& found, const Case& about = {}) {
  const Workflow workflow = load_workflow(file, changes, all_stages());
  run_workflow(workflow, {.folder = folder}, {});
  const std::vector<PlanLine> plan = plan_workflow(workflow, folder);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const StageType& type = workflow.stages[i].type;
    if (!about.name.empty() && !about.of_types.count(type.name)) continue;
    const fs::path result = result_folder(folder, plan[i].stage, plan[i].decision.key);
    found[about.name.empty() ? type.name : type.name + ", " + about.name] = {
        {"version", type.version}, {"facts", facts_of(result)}};
  }
}

Json run_all_cases() {
  const Scratch scratch;
  Json found = Json::object();
  scratch.write("square.msh", kSquare);
  run_case(scratch.write("imports.yaml", kImport), {}, scratch / "imports", found);
  // After that, so that its facts of transfer.zone are kept: a shaken zone says more.
  const std::string chain = test::source("tests/bits/chain.yaml");
  const std::vector<std::string> recorders{"stages.shake.with.opensees_recorders=true"};
  run_case(chain,
           {recorders[0], "stages.flow.with.end=1 s",
            "stages.report={uses: report.runout, in: {history: shake.history, zone: zone.zone, "
            "particles: map.particles, audit: map.audit, flow: flow.history}, with: {figures: "
            "false}}"},
           scratch / "chain", found);
  // The same shaking; the soil above what liquefied keeps its strength.
  run_case(chain, {recorders[0], "stages.flow.with.end=0.05 s", "stages.zone.with.zone=liquefied"},
           scratch / "chain", found, {"zone: liquefied", {"transfer.zone", "transfer.map"}});
  return found;
}

/// Where two JSON values differ by more than the tolerance: "a/b: 1 was 2"; empty if nowhere.
std::string difference(const Json& now, const Json& before, const std::string& place = {}) {
  if (now.is_number() && before.is_number()) {
    const double a = now, b = before, larger = std::max(std::abs(a), std::abs(b));
    if (std::abs(a - b) <= kTolerance * larger + kSmall) return {};
    if (is_residual(place) && larger <= kResidual) return {};
  } else if (now.is_structured() && now.type() == before.type() && now.size() == before.size()) {
    const Json flat_now = now.flatten(), flat_before = before.flatten();
    for (const auto& [key, value] : flat_before.items()) {
      const std::string which = place + key;
      if (!flat_now.contains(key)) return which + " is gone";
      if (!value.is_structured())
        if (const std::string d = difference(flat_now[key], value, which); !d.empty()) return d;
    }
    return {};
  } else if (now == before) {
    return {};
  }
  return fmt::format("{}: {} was {}", place, now.dump(), before.dump());
}

/// What is wrong with a stage's results against those that are kept; empty if nothing is.
std::string verdict(const std::string& type, const Json& now, const Json& kept) {
  if (!kept.contains(type)) return fmt::format("results of {} are not kept", type);
  const int version = now["version"], before = kept[type]["version"];
  if (version != before)
    return fmt::format("version of {} is {}, and the facts that are kept are of {}", type, version,
                       before);
  const std::string moved = difference(now["facts"], kept[type]["facts"]);
  if (moved.empty()) return {};
  return fmt::format("results of {} moved: raise its version ({})", type, moved);
}

constexpr const char* kHowToRenew =
    "fixtures/results/facts.json is made again, for new versions and new stages, by "
    "FLOWSLIDE_RENEW_FACTS=1 build/release/workflows/test_workflows \"results of a stage*\"";

}  // namespace

TEST_CASE("results of a stage move only with its version", "[workflows][bits]") {
  const std::string file = test::fixture("results/facts.json");
  const Json now = run_all_cases();
  Json kept = fs::exists(file) ? Json::parse(read_text_file(file)) : Json::object();
  if (std::getenv("FLOWSLIDE_RENEW_FACTS")) {
    for (const auto& [type, found] : now.items())
      if (verdict(type, found, kept).find("raise its version") == std::string::npos)
        kept[type] = found;
    std::ofstream(file) << kept.dump(1) << "\n";
  }
  INFO(kHowToRenew);
  for (const auto& [type, found] : now.items()) CHECK(verdict(type, found, kept) == "");
  std::set<std::string> untried;
  for (const StageType& type : all_stages())
    if (!now.contains(type.name)) untried.insert(type.name);
  CHECK(untried == std::set<std::string>{});  // give them a case in run_all_cases()
}

TEST_CASE("results that moved are told from those that only rounded", "[workflows]") {
  const Json kept = {{"a.b", {{"version", 2}, {"facts", {{"x", 1.0}, {"list", {{{"y", 2.0}}}}}}}}};
  const auto told = [&](auto change) {
    Json now = kept["a.b"];
    change(now);
    return verdict("a.b", now, kept);
  };
  CHECK(told([](Json&) {}) == "");
  CHECK(told([](Json& j) { j["facts"]["x"] = 1.0 + 1e-9; }) == "");
  CHECK(told([](Json& j) { j["facts"]["x"] = 1.1; }) ==
        "results of a.b moved: raise its version (/x: 1.1 was 1.0)");
  CHECK(told([](Json& j) { j["facts"]["list"][0]["y"] = 3.0; }) ==
        "results of a.b moved: raise its version (/list/0/y: 3.0 was 2.0)");
  // 1e-9 of a permeability is a number like any other; of an error it is nothing.
  const Json small = {{"version", 2}, {"facts", {{"k", 1e-9}, {"list", {{{"error", 4e-16}}}}}}};
  const auto told_small = [&](double k, double error) {
    Json now = small;
    now["facts"]["k"] = k;
    now["facts"]["list"][0]["error"] = error;
    return verdict("s", now, {{"s", small}});
  };
  CHECK(told_small(1e-9, 4e-16) == "");
  CHECK(told_small(1e-9, 9e-9) == "");
  CHECK(told_small(1e-9, 1e-3) ==
        "results of s moved: raise its version (/list/0/error: 0.001 was 4e-16)");
  CHECK(told_small(2e-9, 4e-16) == "results of s moved: raise its version (/k: 2e-09 was 1e-09)");
  CHECK(told([](Json& j) { j["facts"].erase("x"); }).find("moved") != std::string::npos);
  CHECK(told([](Json& j) {
          j["version"] = 3;
          j["facts"]["x"] = 1.1;
        }) == "version of a.b is 3, and the facts that are kept are of 2");
  CHECK(verdict("c.d", kept["a.b"], kept) == "results of c.d are not kept");
}
