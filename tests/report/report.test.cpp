#include "report/report.hpp"

#include "report/audit_table.hpp"
#include "tests/report/dam_case.hpp"
#include "tests/support/scratch.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

namespace {

constexpr const char* kAudit =
    R"({"passed": true, "checks": [{"name": "mass|all", "fem": 1.25, "limit": null},
        {"name": "momentum_x", "error": 3e-13}], "counts": {"points": 7}, "notes": []})";

struct Case {
  Scratch scratch;
  QuadMesh mesh = dam_case::mesh();
  ParticleSet particles = dam_case::particles();

  explicit Case(const dam_case::Flow& flow = {}) {
    dam_case::write_flow(scratch / "mpm.h5", particles, flow);
    dam_case::write_history(scratch / "history.h5", true);
    scratch.write("audit.json", kAudit);
  }
  [[nodiscard]] ReportFacts write(const ReportConfig& config,
                                  const std::vector<std::string>& warnings = {}) const {
    const FemHistory history(scratch / "history.h5");
    const MpmHistory flow(scratch / "mpm.h5");
    return write_report({.history = history,
                         .zone = dam_case::zone(mesh, true),
                         .particles = particles,
                         .audit = scratch / "audit.json",
                         .flow = flow,
                         .provenance = {{"workflow", "dam | case.yaml"}},
                         .warnings = warnings},
                        config, scratch / "report");
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    return read_text_file(scratch / ("report/" + name));
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("The report says what was run, what failed and what to trust") {
  ReportConfig config;
  config.title = "A dam";
  config.figures = false;
  config.regions["lower dam"].outline = {{0, 0}, {75, 0}, {35.42, 11.9}, {20, 11.9}};
  const Case c;
  const ReportFacts facts = c.write(config);
  const std::string report = c.text("report.md");
  CHECK(report.rfind("# A dam\n", 0) == 0);
  CHECK(contains(report, fmt::format("ran out {:.1f} m", facts.runout)));
  CHECK(contains(report, "| depth of liquefaction, pond | 18.00 m |"));
  CHECK(contains(report, "| lower dam | stayed | 0.0 % | 0.00 | 0.00 |"));
  CHECK(contains(report, "halfway between full failure and excessive distortion"));
  CHECK(contains(report, "| workflow | dam \\| case.yaml |"));
  CHECK(contains(report, "a shaking table"));
  CHECK_FALSE(contains(report, "Read this before"));
  CHECK(nlohmann::json::parse(c.text("facts.json"))["runout_m"] == facts.runout);
  CHECK(contains(c.text("runout.csv"), "time_s,runout_m"));
  CHECK(contains(c.text("zone.csv"), "depth_pond_m"));
  CHECK(std::filesystem::exists(c.scratch / "report/flow.pvd"));
  CHECK(std::filesystem::exists(c.scratch / "report/zone.pvd"));
}

TEST_CASE("A run stopped before rest and missing figures are said on top") {
  ReportConfig config;
  config.python = "/nowhere/python3";
  config.paraview = false;
  const Case c({.front = 200.0, .end = 20.0});
  const ReportFacts facts = c.write(config);
  CHECK(facts.warnings.size() == 2);
  const std::string report = c.text("report.md");
  CHECK(contains(report, "had not come to rest"));
  CHECK(contains(report, "stopped before rest"));
  CHECK(contains(report, "python3-matplotlib"));
  CHECK_FALSE(std::filesystem::exists(c.scratch / "report/flow.pvd"));
}

TEST_CASE(
    "Warnings of the stages before stand first, and a runout of 0 says how far from the toe") {
  ReportConfig config;
  config.figures = config.paraview = false;
  config.toe = 500.0;
  const Case c;
  const ReportFacts facts = c.write(config, {"shake: stress.out ends at 4 s."});
  const std::string report = c.text("report.md");
  CHECK(contains(report,
                 "## Read this before using the numbers\n\n- shake: stress.out ends at 4 s."));
  CHECK(facts.warnings.empty());  // its own
  CHECK(nlohmann::json::parse(c.text("facts.json"))["warnings"].size() == 1);
  CHECK(contains(report, fmt::format("{:.1f} m short of the toe", 500.0 - facts.front)));
}

TEST_CASE("A section that holds is reported as such") {
  ReportConfig config;
  config.figures = config.paraview = false;
  config.moved = 1e4;
  const Case c;
  CHECK(c.write(config).failed_volume == 0.0);
  CHECK(contains(c.text("report.md"), "The section "));
}

TEST_CASE("Inputs of another run and unusable folders are refused") {
  ReportConfig config;
  config.figures = config.paraview = false;
  Case c;
  c.scratch.write("report", "a file where the folder should be");
  CHECK_THROWS_AS(c.write(config), FileError);
  std::filesystem::remove(c.scratch / "report");
  std::filesystem::remove(c.scratch / "audit.json");
  CHECK_THROWS_AS(c.write(config), FileError);
  c.scratch.write("audit.json", "{\"passed\": tr");
  CHECK_THROWS_AS(c.write(config), InputError);
  CHECK_FALSE(std::filesystem::exists(c.scratch / "report/report.md"));
  c.mesh.elements.pop_back();
  CHECK_THROWS_AS(c.write(config), InputError);
}

TEST_CASE("An audit becomes tables whatever it holds") {
  const Scratch scratch;
  CHECK(audit_tables(scratch.write("audit.json", kAudit)) ==
        "**checks**\n\n"
        "| name | fem | limit | error |\n|---|---|---|---|\n"
        "| mass\\|all | 1.25 | - |  |\n| momentum_x |  |  | 3e-13 |\n\n"
        "| quantity | value |\n|---|---|\n"
        "| passed | yes |\n| counts, points | 7 |\n| notes | none |\n\n");
  // Another program's, or a trap: tables are made by recursion.
  const std::string deep = "{\"a\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
  CHECK_THROWS_WITH(audit_tables(scratch.write("audit.json", deep)),
                    Catch::Contains("nested more than"));
}
