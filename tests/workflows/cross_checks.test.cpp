#include "workflows/stages/cross_checks.hpp"

#include "core/check.hpp"
#include "report/check_config.hpp"
#include "tests/support/scratch.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace flowslide;
using Catch::Contains;

namespace {

/// A dam 30 m high and 120 m long, of material 1 up to x = 100 and 2 beyond, in squares of 10 m.
SectionMesh dam() {
  SectionMesh s;
  QuadMesh& m = s.mesh;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 12; ++i) {
      m.nodes.push_back({10.0 * i, 10.0 * j});
      m.node_tags.push_back(std::ssize(m.node_tags) + 1);
    }
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 12; ++i) {
      const std::int32_t n = 13 * j + i;
      m.elements.push_back({n, n + 1, n + 14, n + 13});
      m.element_tags.push_back(std::ssize(m.element_tags) + 1);
      m.element_material.push_back(i < 10 ? 1 : 2);
    }
  s.materials = {{"tailings", 1}, {"dam", 2}};
  return s;
}

const std::vector<HistoryMaterial> kSoils{{"tailings", 1, 1900.0}, {"dam", 2, 1900.0}};

MapMaterial soil(double modulus = 20e6) {
  MapMaterial m;
  m.law.of<LinearElastic>() = LinearElastic::Params{modulus, 0.3};
  return m;
}

MapConfig map_config() {
  MapConfig c;
  c.cell = 1.25;
  c.materials = {{"tailings", soil()}, {"dam", soil()}};
  return c;
}

FlowConfig flow_config() {
  FlowConfig c;
  c.cell = 1.25;
  c.end = 10.0;
  c.left_roller = 0.0;
  return c;
}

/// What a rule says about the dam after a change; a control must say nothing.
struct Answer {
  std::string errors, warnings;
};

Answer answer(const Findings& found) {
  return {fmt::format("{}", fmt::join(found.errors, "\n")),
          fmt::format("{}", fmt::join(found.warnings, "\n"))};
}

Answer ask(const std::function<void(FlowConfig&)>& change,
           void (*rule)(const FlowConfig&, const Soil&, Findings&)) {
  FlowConfig c = flow_config();
  Findings control, found;
  rule(c, soil_of(dam(), map_config(), kSoils), control);
  CHECK(control.errors.empty());
  CHECK(control.warnings.empty());
  change(c);
  rule(c, soil_of(dam(), map_config(), kSoils), found);
  return answer(found);
}

}  // namespace

TEST_CASE("The soil of a transfer is what its box and its materials hold") {
  Soil s = soil_of(dam(), map_config(), kSoils);
  CHECK(s.area == Approx(3600.0));
  CHECK(s.counted.right == 120.0);
  MapConfig c = map_config();
  c.materials["dam"].counts_for_runout = false;
  c.box = {.left = 10.0, .right = 200.0, .bottom = 5.0, .top = {}};
  s = soil_of(dam(), c, kSoils);
  CHECK(s.counted.right == 100.0);
  CHECK(s.all.left == 10.0);
  CHECK(s.all.height() == 20.0);  // the lowest row has its centres on the edge of the box
}

TEST_CASE("A toe that a report gives is near the end of the section") {
  const auto at = [](double x) {
    Findings found;
    check_toe(x, flow_config(), soil_of(dam(), map_config(), kSoils), found);
    return answer(found);
  };
  CHECK(at(120.0).errors.empty());
  CHECK_THAT(at(75e3).errors, Contains("74880 m beyond the downstream end"));
  CHECK_THAT(at(200.0).warnings, Contains("80 m beyond") && Contains("reported as 0"));
  CHECK_THAT(at(140.0).warnings, Contains("20 m beyond"));
  CHECK(at(125.0).warnings.empty());
  CHECK_THAT(at(-75.0).errors, Contains("195 m inside the soil"));
  CHECK_THAT(at(110.0).warnings, Contains("10 m inside the soil"));
  CHECK(at(119.0).warnings.empty());
}

TEST_CASE("Loads are held against the weight of the soil") {
  const double weight = 20e3 * soil_of(dam(), map_config(), kSoils).all.height();
  const auto with = [](double pressure, double shear) {
    return ask(
        [&](FlowConfig& c) {
          c.tractions = {
              {.from = {10.0, 30.0}, .to = {50.0, 30.0}, .pressure = pressure, .shear = shear}};
        },
        check_tractions);
  };
  CHECK(with(19.0 * weight, 0.0).warnings.empty());
  CHECK_THAT(with(21.0 * weight, 0.0).warnings, Contains("tractions[0]") && Contains("21 times"));
  CHECK_THAT(with(0.0, -21.0 * weight).warnings, Contains("21 times"));
  CHECK_THAT(with(1001.0 * weight, 0.0).errors, Contains("check number and unit"));
}

TEST_CASE("A toe on the left is seen") {
  const auto sloping = [](double left, double right) {
    SectionMesh s = dam();
    for (Vec2& p : s.mesh.nodes) p[1] *= left + (right - left) * p[0] / 120.0;
    Findings found;
    check_edges(flow_config(), soil_of(s, map_config(), kSoils), found);
    return answer(found).warnings;
  };
  CHECK(sloping(1.0, 0.05).empty());
  CHECK(sloping(0.6, 1.0).empty());
  CHECK_THAT(sloping(0.05, 1.0), Contains("toe on the left"));
}

TEST_CASE("Rollers and outlets stand outside the soil") {
  const auto with = [](auto change) { return ask(change, check_edges); };
  CHECK_THAT(with([](FlowConfig& c) { c.left_roller = 30.0; }).errors, Contains("left_roller"));
  CHECK_THAT(with([](FlowConfig& c) { c.left_roller = -30.0; }).warnings, Contains("stands free"));
  CHECK_THAT(with([](FlowConfig& c) { c.right_roller = 90.0; }).errors, Contains("right_roller"));
  CHECK_THAT(with([](FlowConfig& c) { c.right_roller = 120.0; }).warnings,
             Contains("nothing can pass the toe"));
  CHECK(with([](FlowConfig& c) { c.right_roller = 300.0; }).errors.empty());
  CHECK_THAT(with([](FlowConfig& c) { c.outlet.right = 100.0; }).errors, Contains("outlet.right"));
  CHECK_THAT(with([](FlowConfig& c) { c.outlet.bottom = 5.0; }).errors, Contains("outlet.bottom"));
  CHECK_THAT(with([](FlowConfig& c) { c.outlet.right = 120.0; }).errors,
             Contains("runout would be 0"));
  CHECK(with([](FlowConfig& c) { c.outlet.right = 500.0; }).errors.empty());
}

TEST_CASE("The ground lies under the soil") {
  const auto on = [](std::vector<std::vector<double>> surface) {
    return ask([&](FlowConfig& c) { c.ground.surface = surface; }, check_ground);
  };
  CHECK_THAT(on({{0.0, 20.0}}).errors, Contains("15 m below it"));
  CHECK_THAT(on({{0.0, -40.0}}).warnings, Contains("as all of the soil by 40 m"));
  CHECK(on({{0.0, -10.0}, {120.0, 0.0}, {200.0, -5.0}}).errors.empty());
  // A cliff below the toe is one thing, one below the soil another.
  CHECK(on({{0.0, 0.0}, {120.0, 0.0}, {120.0, -50.0}}).warnings.empty());
  CHECK_THAT(on({{0.0, 0.0}, {100.0, 0.0}, {100.0, -50.0}}).warnings,
             Contains("x = 105 m, y = 0 m hangs 50 m above"));
  // Ground that falls away under a base that does not, by more than an element.
  CHECK_THAT(on({{0.0, 0.0}, {120.0, -14.0}}).warnings, Contains("y = 0 m hangs 12.2"));
  CHECK(on({{0.0, 0.0}, {120.0, -9.0}}).warnings.empty());
  CHECK(on({{0.0, 0.0}, {120.0, 0.0}, {400.0, 14.0}}).warnings.empty());
  CHECK_THAT(on({{0.0, 0.0}, {130.0, 0.0}, {130.0, 20.0}}).warnings,
             Contains("rises to y = 20 m at x = 130 m, 20 m above the toe"));
}

TEST_CASE("Cells too coarse for the soil are refused, coarse ones warned about") {
  const auto with = [](double cell) {
    return ask([cell](FlowConfig& c) { c.cell = cell; }, check_cells);
  };
  for (const double cell : {10.0, 20.0, 40.0})
    CHECK_THAT(with(cell).errors, Contains("at most 7.5 m"));
  CHECK_THAT(with(5.0).warnings, Contains("6 cells over the height"));
  CHECK(with(2.5).warnings.empty());
}

TEST_CASE("Cells of transfer and runout agree") {
  const auto with = [](double cell, double origin = 0.0) {
    FlowConfig c = flow_config();
    c.cell = cell;
    c.grid_origin = {origin, 0.0};
    Findings found;
    compare_cells(c, map_config(), found);
    return answer(found);
  };
  CHECK(with(1.25, 12.5).warnings.empty());
  CHECK_THAT(with(0.5).errors, Contains("0.8 points per cell"));
  CHECK_THAT(with(2.5).warnings, Contains("4 of them per cell"));
  CHECK_THAT(with(1.25, 0.5).warnings, Contains("grid_origin"));
}

TEST_CASE("More points than the memory holds are refused") {
  const auto with = [](double cell, double width) {
    MapConfig c = map_config();
    c.cell = cell;
    Findings found;
    check_memory(c, soil_of(dam(), c, kSoils), width, 8e9, found);
    return answer(found);
  };
  CHECK(with(1.25, kUnset).errors.empty());
  CHECK_THAT(with(0.01, kUnset).errors, Contains("1.4e+08 points"));
  CHECK_THAT(with(0.25, 100.0).errors, Contains("use larger cells"));
}

TEST_CASE("Materials of the transfer have plausible numbers") {
  const auto with = [](auto change) {
    MapConfig c = map_config();
    Findings control, found;
    check_map_materials(c, kSoils, soil_of(dam(), c, kSoils), control);
    CHECK(control.errors.empty());
    CHECK(control.warnings.empty());
    change(c.materials["tailings"]);
    check_map_materials(c, kSoils, soil_of(dam(), c, kSoils), found);
    return answer(found);
  };
  CHECK_THAT(with([](MapMaterial& m) { m = soil(20.0); }).errors, Contains("youngs_modulus"));
  CHECK_THAT(with([](MapMaterial& m) { m = soil(4e5); }).errors, Contains("pressed flat"));
  CHECK_THAT(with([](MapMaterial& m) { m = soil(2e6); }).warnings, Contains("settle by 28 %"));
  const auto sand = [](double cohesion, double friction_angle) {
    return [=](MapMaterial& m) {
      m.law = {};
      MohrCoulomb::Params& p = m.law.of<MohrCoulomb>().emplace();
      p.youngs_modulus = 20e6;
      p.poisson_ratio = 0.3;
      p.cohesion = cohesion;
      p.friction_angle = friction_angle;
    };
  };
  CHECK(with(sand(25e3, 0.6)).warnings.empty());
  CHECK(with(sand(25e3, 0.0)).warnings.empty());
  CHECK_THAT(with(sand(25e3, 0.011)).warnings, Contains("friction_angle is 0.6303 deg"));
  CHECK_THAT(with(sand(25e6, 0.6)).warnings, Contains("cohesion is 2.5e+04 kPa"));
  CHECK_THROWS_WITH(with([](MapMaterial& m) { m.of = {"clay"}; }),
                    Contains("materials.tailings: the section has no material 'clay'"));
}

TEST_CASE("Water stands in the section") {
  const auto at = [](double level) {
    FemConfig c;
    c.water.emplace().table = {{0.0, level}, {120.0, 0.0}};
    Findings found;
    check_water(c, dam().mesh, found);
    return answer(found);
  };
  // Elements of 10 m do not follow the table.
  CHECK_THAT(at(30.0).warnings, Contains("first node above it") && !Contains("highest point"));
  CHECK_THAT(at(1e9).errors, Contains("more than the section is high"));
  CHECK_THAT(at(35.0).warnings, Contains("5 m above the highest point"));
  FemConfig dry;
  dry.water.emplace().table = {{0.0, -5.0}};
  Findings found;
  check_water(dry, dam().mesh, found);
  CHECK_THAT(answer(found).warnings, Contains("cannot liquefy"));
}

TEST_CASE("Residual strength is a small share of the stress it belongs to") {
  const auto with = [](double stress, double strength) {
    Findings found;
    check_strength({.table = {{stress, strength}}}, found);
    return answer(found);
  };
  CHECK(with(25e3, 3e3).warnings.empty());
  CHECK(with(5e3, 4e3).warnings.empty());  // near the surface
  CHECK_THAT(with(25e3, 3e6).errors, Contains("120 times the stress"));
  CHECK_THAT(with(25e3, 15e3).warnings, Contains("0.6 times"));
  CHECK_THAT(with(25e3, 3.0).warnings, Contains("0.00012 times"));
  Findings rising, falling;
  check_strength({.table = {{25e3, 3e3}, {250e3, 11e3}}}, rising);
  check_strength({.table = {{25e3, 11e3}, {250e3, 3e3}}}, falling);
  CHECK(rising.warnings.empty());
  CHECK_THAT(answer(falling).warnings, Contains("row 2: S_r falls to 3 kPa from 11 kPa"));
}

TEST_CASE("Depths count from a pond above the soil") {
  const auto at = [](double y) {
    ZoneConfig c;
    c.liquefiable = {"tailings"};
    c.pond_surface = y;
    Findings found;
    check_pond(c, dam().mesh, kSoils, found);
    return answer(found).warnings;
  };
  CHECK(at(30.0).empty());
  CHECK_THAT(at(0.0), Contains("all depths of liquefaction will be 0"));
  CHECK_THAT(at(90.0), Contains("60 m above"));
  CHECK(at(16.0).empty());
  CHECK_THAT(at(10.0), Contains("lies 20 m below the top of the liquefiable soil"));
}

TEST_CASE("The pond of a report stands in the section") {
  const auto at = [](double pond, std::optional<double> surface) {
    Findings found;
    check_freeboard(pond, dam().mesh, surface, found);
    return answer(found);
  };
  CHECK(at(28.0, 30.0).errors.empty());
  CHECK(at(28.0, 30.0).warnings.empty());
  CHECK(at(28.0, std::nullopt).warnings.empty());
  CHECK_THAT(at(31.0, 30.0).errors, Contains("above the highest ground at y = 30 m"));
  CHECK_THAT(at(-1.0, 30.0).errors, Contains("there is no pond"));
  CHECK_THAT(at(15.0, 30.0).warnings, Contains("one datum"));
}

TEST_CASE("A section that stood has moved less than one that failed") {
  ReportConfig config;
  CHECK_NOTHROW(check(config));
  config.stood = config.moved;
  CHECK_THROWS_WITH(check(config), Contains("stood: 1 m is not below moved: 1 m"));
}

TEST_CASE("The shaking ends by the rule that chooses the transfer") {
  StopAtTransferConfig stop;
  ZoneConfig zone;
  stop.liquefiable = zone.liquefiable = {"tailings"};
  stop.pond_surface = zone.pond_surface = 30.0;
  Findings control, found;
  compare_transfer_rules(stop, zone, control);
  CHECK(control.warnings.empty());
  stop.r_u.threshold = 0.9;
  compare_transfer_rules(stop, zone, found);
  CHECK_THAT(answer(found).warnings, Contains("r_u.threshold 0.9 -> 0.7"));
  // columns decide depths, and these the onset: they are settings of the rule
  Findings columns;
  stop.r_u.threshold = zone.r_u.threshold;
  stop.columns.neighbours = 0;
  compare_transfer_rules(stop, zone, columns);
  CHECK_THAT(answer(columns).warnings, Contains("columns.neighbours 0 -> 1"));
}

TEST_CASE("Sections have the size of sections") {
  const auto with = [](double factor, double far = 0.0, double higher = 1.0) {
    SectionMesh s = dam();
    for (Vec2& p : s.mesh.nodes) p = {factor * p[0], factor * higher * p[1]};
    if (far != 0.0) s.mesh.nodes.back() = {far, 30.0};
    Findings found;
    check_size(s.mesh, found);
    return answer(found);
  };
  CHECK(with(1.0).warnings.empty());
  CHECK_THAT(with(1.0, 1e300).errors, Contains("misplaced node"));
  CHECK_THAT(with(1000.0).errors, Contains("another unit of length"));
  CHECK_THAT(with(100.0).warnings, Contains("more than 10 km"));
  CHECK_THAT(with(1.0, 0.0, 50.0).warnings, Contains("more than a kilometre high"));
  CHECK_THAT(with(1e-3).warnings, Contains("less than 5 m"));
  CHECK_THAT(with(0.5, 0.0, 8.0).warnings, Contains("x and y exchanged"));
}

TEST_CASE("Terrain lies under the dam and has heights there") {
  const Scratch scratch;
  const auto rows = [](const std::string& row) {
    std::string text;
    for (int i = 0; i < 30; ++i) text += row + "\n";
    return text;
  };
  std::string level, gap, marks, step, cliff;
  for (int i = 0; i < 100; ++i) {
    level += "100 ";
    cliff += i < 18 ? "100 " : "20 ";
    step += i == 90 ? "0 " : "100 ";
    marks += i == 90 ? "0 " : fmt::format("{} ", 100 - i % 7);
    gap += i == 30 || i == 80 ? "-9999 " : "100 ";
  }
  const std::string header =
      "ncols 100\nnrows 30\nxllcorner 500000\nyllcorner 7000000\ncellsize 10\n";
  scratch.write("level.asc", header + rows(level));
  scratch.write("gap.asc", header + rows(gap));
  scratch.write("marks.asc", header + rows(marks));
  scratch.write("step.asc", header + rows(step));
  scratch.write("cliff.asc", header + rows(cliff));
  scratch.write("cut.asc", header.substr(0, 20));
  scratch.write("coarse.asc",
                "ncols 4\nnrows 2\nxllcorner -1000\nyllcorner -1000\ncellsize 1000\n"
                "100 100 100 100\n100 100 100 100\n");
  const auto ask_about = [&](const char* file, std::array<double, 2> origin,
                             double height = 100.0) {
    FlowConfig c = flow_config();
    c.extrude = ExtrudeSettings{.width = 40.0};
    c.ground.terrain = TerrainSettings{{scratch / file}, origin, 0.0, height};
    Findings found;
    check_terrain(c, soil_of(dam(), map_config(), kSoils), found);
    return answer(found);
  };
  const std::array<double, 2> there{500100.0, 7000100.0};
  CHECK(ask_about("level.asc", there).errors.empty());
  CHECK(ask_about("level.asc", there).warnings.empty());
  CHECK_THAT(ask_about("level.asc", {0.0, 0.0}).errors,
             Contains("x = 0 to 120 m lies 499885 m west and 6999965 m south of the map"));
  CHECK_THAT(ask_about("level.asc", {500600.0, 7000100.0}).warnings, Contains("ends 290 m"));
  CHECK_THAT(ask_about("level.asc", there, 50.0).errors, Contains("below the terrain"));
  CHECK_THAT(ask_about("level.asc", there, 150.0).warnings, Contains("`level`"));
  CHECK_THAT(ask_about("level.asc", there, 112.0).warnings, Contains("as all of the soil by"));
  CHECK_THAT(ask_about("level.asc", {1e300, 0.0}).errors, Contains("lies 1e+300 m east"));
  CHECK_THAT(ask_about("cliff.asc", there).warnings, Contains("hangs") && Contains("at x = "));
  CHECK_THAT(ask_about("coarse.asc", {0.0, 0.0}).warnings, Contains("a height every 1000 m only"));
  CHECK_THROWS_WITH(ask_about("cut.asc", there), Contains("ground.terrain.file: cut.asc"));
  CHECK_THAT(ask_about("gap.asc", {500250.0, 7000100.0}).errors,
             Contains("the terrain has no height"));
  CHECK_THAT(ask_about("gap.asc", {500400.0, 7000100.0}).warnings, Contains("60 of 3000 heights"));
  CHECK_THAT(ask_about("marks.asc", there).warnings,
             Contains("30 of 3000 heights of marks.asc are 0 m, 94 m below all others"));
  CHECK_THAT(ask_about("step.asc", there).warnings,
             Contains("are 0 m, 100 m below") && !Contains("above all others"));
}

TEST_CASE("The ground of a valley is told once, and its walls stand apart") {
  const Scratch scratch;
  scratch.write("level.asc",
                "ncols 2\nnrows 2\nxllcorner -1000\nyllcorner -1000\ncellsize 5000\n0 0\n0 0\n");
  FlowConfig both = flow_config();
  both.extrude = ExtrudeSettings{.width = 1.0};
  both.ground.surface = {{0.0, -5.0}};
  both.ground.terrain = TerrainSettings{{scratch / "level.asc"}, {0.0, 0.0}, 0.0, 0.0};
  Findings found;
  check_terrain(both, soil_of(dam(), map_config(), kSoils), found);
  CHECK_THAT(answer(found).errors, Contains("ground.surface: and ground.terrain are both given"));
  CHECK_THAT(answer(found).warnings, Contains("extrude.width: 1 m is less than a cell of 1.25 m"));
}

TEST_CASE("Every element of a transfer has a material, and soil that liquefies a law for it") {
  ZoneConfig zone;
  zone.liquefiable = {"tailings"};
  zone.zone = ZoneExtent::automatic;
  const auto with = [&](auto change) {
    MapConfig c = map_config();
    c.materials["tailings"].liquefied = ResidualStrength::Params{
        .youngs_modulus = 20e6, .poisson_ratio = 0.45, .strength = {}, .soft_strength = {}};
    Findings control, found;
    check_map_names(c, dam(), kSoils, zone, control);
    CHECK(control.errors.empty());
    CHECK(control.warnings.empty());
    change(c);
    check_map_names(c, dam(), kSoils, zone, found);
    return answer(found);
  };
  CHECK_THAT(with([](MapConfig& c) { c.materials.erase("dam"); }).errors,
             Contains("element 11 is of the material 'dam'"));
  CHECK(with([](MapConfig& c) {
          c.materials.erase("dam");
          c.box = {.left = 0.0, .right = 100.0, .bottom = {}, .top = {}};
        }).errors.empty());
  CHECK_THAT(with([](MapConfig& c) { c.materials["tailings"].liquefied.reset(); }).warnings,
             Contains("'tailings' can liquefy"));
  CHECK_THAT(with([](MapConfig& c) {
               c.box = {.left = 340.0, .right = {}, .bottom = {}, .top = {}};
             }).errors,
             Contains("box: holds no part of the section, which spans x = 0 to 120 m"));
}

TEST_CASE("A region of a report holds soil") {
  const auto with = [](std::vector<std::vector<double>> outline) {
    Findings found;
    check_region("part", {std::move(outline)}, dam().mesh, found);
    return answer(found);
  };
  CHECK_THAT(with({{0, 0}, {1, 1}}).errors, Contains("regions.part: 2 corners"));
  CHECK_THAT(with({{0, 0}, {75, 0}, {0, 0}}).errors, Contains("lie on one line"));
  CHECK_THAT(with({{1e3, 0}, {1.1e3, 0}, {1e3, 10}}).warnings,
             Contains("regions.part: holds no part of the section, which spans x = 0 to 120 m"));
  for (const double size : {100.0, 1.0}) {  // of many elements, and within one
    const Answer got = with({{1, 1}, {1 + size, 1}, {1, 1 + size}});
    CHECK(got.errors.empty());
    CHECK(got.warnings.empty());
  }
}
