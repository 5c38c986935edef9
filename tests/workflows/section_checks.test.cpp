#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

/// The mesh of a section against the waves that it is to carry, and whether its soil can liquefy.
using namespace flowslide;
using Catch::Contains;

namespace {

std::string warnings(const Findings& f) {
  CHECK(f.errors.empty());
  return fmt::format("{}", fmt::join(f.warnings, "\n"));
}

/// Level ground, 100 m long and 20 m deep.
SectionMesh ground(std::int32_t columns, std::int32_t rows) {
  SectionMesh s;
  for (std::int32_t j = 0; j <= rows; ++j)
    for (std::int32_t i = 0; i <= columns; ++i) {
      s.mesh.nodes.push_back({100.0 * i / columns, 20.0 * j / rows});
      s.mesh.node_tags.push_back(std::ssize(s.mesh.node_tags) + 1);
    }
  for (std::int32_t j = 0; j < rows; ++j)
    for (std::int32_t i = 0; i < columns; ++i) {
      const std::int32_t n = (columns + 1) * j + i;
      s.mesh.elements.push_back({n, n + 1, n + columns + 2, n + columns + 1});
      s.mesh.element_tags.push_back(std::ssize(s.mesh.element_tags) + 1);
      s.mesh.element_material.push_back(1);
    }
  s.materials = {{"sand", 1}};
  EdgeSet surface{"surface", {}};
  for (std::int32_t i = columns; i > 0; --i)
    surface.edges.push_back({(columns + 1) * rows + i, (columns + 1) * rows + i - 1});
  s.sets.push_back(surface);
  return s;
}

/// Elastic soil with shear waves of 100 m/s: G = 1900 kg/m3 x 1e4 m2/s2.
FemConfig elastic() {
  FemConfig c;
  FemMaterialConfig m;
  m.density = 1900.0;
  m.void_ratio = 0.8;
  m.permeability = {1e-5, 1e-5};
  m.laws.of<LinearElastic>() = LinearElastic::Params{2.0 * 1.3 * 1.9e7, 0.3};
  c.materials["sand"] = m;
  return c;
}

FemConfig sandy() {
  FemConfig c = elastic();
  c.materials["sand"].laws = {};
  PM4Sand::Params law;
  law.Dr = 0.35;
  law.G0 = 476.0;
  law.hpo = 0.5;
  c.materials["sand"].laws.of<PM4Sand>() = law;
  c.water.emplace().table = {{0.0, 20.0}};
  return c;
}

std::string waves(const FemConfig& c, const SectionMesh& mesh, const MotionBand& band) {
  Findings found;
  check_waves(c, mesh, band, found);
  return warnings(found);
}

}  // namespace

TEST_CASE("Elements that are too high or too long for the waves of a motion are told") {
  // 2 m high: a wave of 100 m/s has 4 of them at 12.5 Hz.
  CHECK(waves(elastic(), ground(50, 10), {0.4, 12.4}).empty());
  CHECK_THAT(waves(elastic(), ground(50, 10), {0.4, 25.0}),
             Contains("500 of 500 elements are too high") && Contains("lie below 25 Hz") &&
                 Contains("a wave length of 4 m in element 1 at (1, 1) m") &&
                 Contains("go with 100 m/s. It is 2 m high, 2 elements in a wave") &&
                 Contains("Take 1 m or less"));
  // 20 m long: a wave of 0.4 s is 40 m.
  CHECK_THAT(waves(elastic(), ground(5, 10), {0.4, 10.0}),
             Contains("50 of 50 elements are too long") && Contains("its mean is 2.5 Hz") &&
                 Contains("Take 12 m or less"));
  CHECK(waves(elastic(), ground(50, 10), {}).empty());  // nothing is known of the motion
}

TEST_CASE("The stiffness of sand at rest is that of its depth and water") {
  // In the middle of the highest row, 1.25 m deep, p' is 8.3 kPa and
  // G = 476 sqrt(101.3 kPa x 8.3 kPa): V_s = 85 m/s, and 4 elements of 2.5 m are a wave of 8.5 Hz.
  CHECK(waves(sandy(), ground(50, 8), {0.4, 8.4}).empty());
  CHECK_THAT(waves(sandy(), ground(50, 8), {0.4, 10.0}),
             Contains("50 of 400 elements are too high") && Contains("85 m/s"));
  FemConfig dry = sandy();
  dry.water.reset();  // twice the stress, 1.2 times the speed
  CHECK(waves(dry, ground(50, 8), {0.4, 10.0}).empty());
}

TEST_CASE("A mesh with too few elements over its height is told") {
  CHECK(waves(elastic(), ground(25, 4), {}).empty());
  CHECK_THAT(waves(elastic(), ground(25, 3), {}),
             Contains("3 elements over the height of the section of 20 m"));
  CHECK_THAT(waves(elastic(), ground(25, 1), {}), Contains("1 element over"));
}

TEST_CASE("Rock that is softer than the soil on it is told") {
  FemConfig c = elastic();
  c.base.shear_wave_velocity = 101.0;
  CHECK(waves(c, ground(50, 10), {}).empty());
  c.base.shear_wave_velocity = 99.0;
  CHECK_THAT(waves(c, ground(50, 10), {}), Contains("less than that of the soil on it, 100 m/s"));
}

TEST_CASE("Soil that is called liquefiable and cannot liquefy is told") {
  const auto with = [](const std::function<void(FemConfig&)>& change) {
    FemConfig c = sandy();
    change(c);
    TransferRuleConfig rule;
    rule.liquefiable = {"sand"};
    Findings found;
    check_liquefiable(c, rule, ground(50, 10), found);
    return warnings(found);
  };
  CHECK(with([](FemConfig&) {}).empty());
  CHECK_THAT(with([](FemConfig& c) { c.water.reset(); }), Contains("no `water`"));
  CHECK(with([](FemConfig& c) { c.water->table = {{0.0, 1.5}}; }).empty());
  CHECK_THAT(with([](FemConfig& c) {
               c.water->table = {{0.0, -1.0}};
             }),
             Contains("passes 2 m below all of it"));
  CHECK_THAT(with([](FemConfig& c) { c.materials["sand"].drained = true; }), Contains("`drained`"));
  CHECK_THAT(
      with([](FemConfig& c) { c.materials["sand"].laws = elastic().materials["sand"].laws; }),
      Contains("is linear_elastic, which gathers no pore pressure"));
  CHECK(with([](FemConfig& c) { c.materials["sand"].permeability = {1e-3, 1e-3}; }).empty());
  CHECK_THAT(with([](FemConfig& c) {
               c.materials["sand"].permeability = {5e-2, 1e-5};
             }),
             Contains("permeability of 0.05 m/s") && Contains("is the unit right?"));
}

TEST_CASE("Water downstream of a section is told") {
  const auto with = [](double left, double right) {
    FemConfig c = sandy();
    c.water->table = {{0.0, left}, {100.0, right}};
    Findings found;
    check_water(c, ground(10, 10).mesh, found);
    return warnings(found);
  };
  CHECK(with(20.0, 15.0).empty());
  CHECK_THAT(with(10.0, 20.0), Contains("10 m on the left") && Contains("flow upstream"));
  CHECK_THAT(with(30.0, 25.0), Contains("5 m above the ground at the downstream end"));
}

TEST_CASE("A water table between rows of nodes is told if it moves by a tenth of the height") {
  const auto with = [](double table, std::int32_t rows) {
    FemConfig c = sandy();
    c.water->table = {{0.0, table}};
    Findings found;
    check_water(c, ground(10, rows).mesh, found);
    return warnings(found);
  };
  CHECK(with(15.0, 4).empty());
  CHECK_THAT(with(11.0, 4),
             Contains("(10, 15) m stands 4 m higher") && Contains("by up to 39 kPa"));
  CHECK(with(13.5, 4).empty());
  CHECK(with(11.0, 20).empty());
}

TEST_CASE("Water downstream that stands higher than upstream is told to be missing in the flow") {
  FemConfig c = sandy();
  c.water->table = {{0.0, 18.0}, {100.0, 26.0}};
  Findings found;
  check_water(c, ground(10, 10).mesh, found);
  CHECK_THAT(warnings(found), Contains("flow upstream") && Contains("computed in air"));
}

TEST_CASE("Where nothing has liquefied, the largest r_u is told") {
  LiquefactionZone zone;
  zone.r_u_node = {kUnset, 0.12, 0.31, 0.05};
  CHECK_THAT(how_near(zone, {}), Contains("largest r_u is 0.31") && Contains("above 0.7"));
  zone.r_u_node = {kUnset, kUnset};
  CHECK_THAT(how_near(zone, {}), Contains("none has 8 kPa"));
}
