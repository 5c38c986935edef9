#include "report/told_run.hpp"

#include "report/section_lines.hpp"
#include "report/settings_text.hpp"
#include "tests/report/dam_case.hpp"
#include "tests/support/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

const std::vector<ToldStage> kStages{
    {"motion", "motion.prepare", "preset = \"x\"\n",
     R"({"motion_pga_m_s2": 2.943, "motion_tm_s": 0.39, "motion_arias_m_s": 0.56,
         "motion_d5_95_s": 10.4,
         "motion_pgv_m_s": 0.167})"},
    {"shake", "fem.run",
     "materials = table of [\"clay \\\"x\\\"\", \"sand\"]\nmaterials.\"clay \\\"x\\\"\".density = "
     "1900 kg/m3\n"
     "materials.\"sand\".density = 1700 kg/m3\nmaterials.\"sand\".pm4sand = given\n"
     "materials.\"sand\".pm4sand.phi_cv = 0.5759586531581288 rad\n",
     "{}"},
    {"zone", "transfer.zone", "strength.table = [[25000 Pa, 1000 Pa], [150000 Pa, 4000 Pa]]\n",
     "{}"},
    {"map", "transfer.map",
     "c_soft_ratio = 0.5\nmaterials.\"base\".tags = [2, 5]\nmaterials.\"sand\".tags = [1]\n"
     "materials.\"sand\".mohr_coulomb.youngs_modulus = 2e+07 Pa\n",
     "{}"},
    {"flow", "mpm.run",
     "cell = 2.5 m\nground.surface = [[0 m, -2 m], [36 m, -2 m], [36.5 m, 1e-03 m]]\n"
     "ground.friction = 0.7\n",
     "{}"}};

}  // namespace

TEST_CASE("Settings of the stages before are read back") {
  const auto settings = read_settings_text(kStages[1].settings);
  REQUIRE(settings.size() == 5);
  CHECK(settings[1].path == "materials.\"clay \\\"x\\\"\".density");
  const SettingsTable table = settings_table(settings, "materials");
  CHECK(table.names == std::vector<std::string>{"clay \"x\"", "sand"});
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].first == "density");
  CHECK(table.rows[0].second == std::vector<std::string>{"1900 kg/m3", "1700 kg/m3"});
  CHECK(table.rows[1].second == std::vector<std::string>{"", "0.5759586531581288 rad"});
  CHECK(find_setting(kStages[4].settings, "cell") == "2.5 m");
  CHECK(find_setting(kStages[4].settings, "cel").empty());
  CHECK(rows_of("[[1 m, -2.5 kg/m3], [3e+02 m, 4 m]]") ==
        std::vector<std::vector<double>>{{1.0, -2.5}, {300.0, 4.0}});
  for (const char* other : {"", "2.5 m", "[1 m, 2 m]", "[[[1]]]", "\"[[\"", "[]"}) {
    CAPTURE(other);
    CHECK(rows_of(other).empty());
  }
  CHECK(soil_names(kStages) ==
        std::vector<std::pair<int, std::string>>{{2, "base"}, {5, "base"}, {1, "sand"}});
  CHECK(ground_line(kStages).values == std::vector<double>{0, -2, 36, -2, 36.5, 1e-3});
  CHECK(ground_line({}).rows() == 0);
  CHECK(number_in(R"({"a": 2})", "a") == 2.0);
  CHECK(std::isnan(number_in("{", "a")));
}

TEST_CASE("A report tells motion, mesh, soils, strengths and grid without the workflow") {
  const Scratch scratch;
  const QuadMesh mesh = dam_case::mesh();
  const ParticleSet particles = dam_case::particles();
  dam_case::write_flow(scratch / "mpm.h5", particles, {});
  dam_case::write_history(scratch / "history.h5", true);
  const FemHistory history(scratch / "history.h5");
  const MpmHistory flow(scratch / "mpm.h5");
  LiquefactionZone zone = dam_case::zone(mesh, true);
  const ReportInputs in{.history = history,
                        .zone = zone,
                        .particles = particles,
                        .audit = scratch / "audit.json",
                        .flow = flow,
                        .provenance = {},
                        .stages = kStages};
  const std::string told = told_inputs(in);
  for (const char* part :
       {"| peak ground acceleration PGA | 0.3 g |", "| Arias intensity | 0.56 m/s |",
        "| significant duration D5-95 | 10.4 s |", "| mean period Tm | 0.39 s |",
        "| parameter | clay \"x\" | sand |", "| density | 1900 kg/m3 | 1700 kg/m3 |",
        "| pm4sand.phi_cv | - | 33 deg |", "| 150 kPa | 4 kPa |", "c_soft / S_r = 0.5",
        "| mohr_coulomb.youngs_modulus | - | 20 MPa |", "| cell size | 2.5 m |"}) {
    CAPTURE(part);
    CHECK_THAT(told, Contains(part));
  }
  CHECK_THAT(told, Contains(fmt::format("| material points | {} |", particles.size())));
  const FinalState end = final_state(particles, flow, {});
  const std::string words = told_judgement(in, {}, compute_facts(zone, flow, end, {}), end);
  // Layers of 6 m with 3, 5 and 7 kPa; half of it was left in the end (dam_case).
  CHECK_THAT(words, Contains("(3 to 7 kPa)"));
  CHECK_THAT(words, Contains("50 % of that strength was left"));
  CHECK_THAT(words, Contains("Under the pond the soil liquefied to a depth of 18.0 m"));
  CHECK_THAT(words, Contains("70 % of it went into the soil, 30 % into friction"));
  CHECK_THAT(words, Contains("| cell size | 2.5 m |"));
  ReportFacts whole = compute_facts(zone, flow, end, {});
  whole.liquefaction_depth = {{"all", 12.0}};  // what a zone without windows has
  CHECK_THAT(told_judgement(in, {}, whole, end), Contains("- The soil liquefied to a depth of 12"));
  CHECK_THAT(told_inputs({.history = history,
                          .zone = zone,
                          .particles = particles,
                          .audit = "",
                          .flow = flow,
                          .provenance = {}}),
             Contains("not known to the report"));
  zone.transfer_frame = -1;  // the gravity state
  CHECK_THAT(told_judgement(in, {}, whole, end),
             Contains("- The soil is assumed to liquefy to a depth of 12"));
}

TEST_CASE("The surface of still water is level on a coarse mesh, and a pond stands above it") {
  // Water at y = 7.3 on elements of 4 m; ground at 8 left of x = 8, at 4 right of it.
  QuadMesh m;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 2; ++j) {
      m.nodes.push_back({4.0 * i, 4.0 * j});
      m.node_tags.push_back(static_cast<std::int64_t>(m.nodes.size()));
    }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < (i < 2 ? 2 : 1); ++j) {
      const int a = 3 * i + j;
      m.elements.push_back({a, a + 3, a + 4, a + 1});
      m.element_tags.push_back(static_cast<std::int64_t>(m.elements.size()));
      m.element_material.push_back(1);
    }
  std::vector<double> pressure;
  for (const Vec2& n : m.nodes) pressure.push_back(9810.0 * std::max(0.0, 7.3 - n[1]));
  const Table water = water_surface(m, pressure);
  REQUIRE(water.rows() >= 8);
  for (std::size_t r = 0; r < water.rows(); ++r) {
    const double x = water.values[3 * r];
    CAPTURE(x);
    CHECK(water.values[3 * r + 1] == Approx(7.3));
    CHECK(water.values[3 * r + 2] == Approx(x < 8.0 ? 8.0 : 4.0));
  }
  const Table dry = water_surface(m, std::vector<double>(m.num_nodes(), 0.0));
  CHECK(std::isnan(dry.values[1]));
}
