#include "transfer/sordo2024/compat_sordo2024.hpp"

#include "constitutive/materials.hpp"
#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

constexpr std::array<Vec2, 3> kOrigin{{{-100.0, 20.0}, {0.0, 20.0}, {0.0, -5.0}}};

/// Three 2 m x 1 m patches of 2 x 1 elements far from each other: tailings (168) and embankment
/// (167) at y = 20, foundation (170) at y = -5.
QuadMesh patches() {
  QuadMesh m;
  for (int k = 0; k < 3; ++k) {
    const auto n = static_cast<std::int32_t>(m.nodes.size());
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 3; ++i) m.nodes.push_back({kOrigin[k][0] + i, kOrigin[k][1] + j});
    }
    for (int i = 0; i < 2; ++i) {
      m.elements.push_back({n + i, n + i + 1, n + i + 4, n + i + 3});
      m.element_material.push_back(k == 0 ? 168 : k == 1 ? 167 : 170);
    }
  }
  for (std::size_t n = 0; n < m.num_nodes(); ++n) m.node_tags.push_back(static_cast<int>(n) + 101);
  for (std::size_t e = 0; e < m.num_elements(); ++e)
    m.element_tags.push_back(static_cast<int>(e) + 1);
  return m;
}

/// sigma'_v0 of 60 kPa, K0 0.5, u = 10 kPa everywhere, strain as given.
FemFrame gravity_of(const QuadMesh& m, const StrainIncrement<2>& strain = {}) {
  FemFrame f;
  f.pore_pressure.assign(m.num_nodes(), 10e3);
  f.stress.assign(m.num_elements(), Stress<2>{{-30e3, -60e3, -40e3, 2e3}});
  f.strain.assign(m.num_elements(), strain);
  return f;
}

FemFrame shaking_of(const QuadMesh& m, Vec2 displacement) {
  FemFrame f = gravity_of(m);
  f.displacement.assign(m.num_nodes(), displacement);
  f.velocity.assign(m.num_nodes(), {0.3, -0.1});
  return f;
}

SordoConfig config_of(SordoLiquefied liquefied = SordoLiquefied::all) {
  SordoConfig c;
  c.base_node = 113;  // first node of the foundation
  c.liquefied = liquefied;
  if (liquefied == SordoLiquefied::line) c.line = {{-99.5, 30.0}, {-98.5, 30.0}};
  return c;
}

int tag_of(const ParticleSet& p, std::size_t i) {
  return static_cast<int>(p.history.at("material_id")[i]);
}

}  // namespace

TEST_CASE("points of the gravity state: positions, mass, total stress and no sigma_zz") {
  const QuadMesh mesh = patches();
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), nullptr, config_of());
  CHECK_NOTHROW(check(p));
  REQUIRE(p.size() == 24);
  // Third point of the first element, towards its third node.
  CHECK(p.position[2][0] == Approx(-99.5 + 0.57735 / 2).epsilon(1e-14));
  CHECK(p.position[2][1] == Approx(20.5 + 0.57735 / 2).epsilon(1e-14));
  CHECK(p.mass[2] == Approx(1870.0 / 4));
  CHECK(p.mass[23] == Approx(1900.0 / 4));
  double mass = 0.0;
  for (const double m : p.mass) mass += m;
  CHECK(mass == Approx(2 * (1870.0 + 1690.0 + 1900.0)));
  CHECK(p.stress[2][2] == 0.0);
  CHECK(p.pore_pressure[2] == 0.0);
  CHECK(p.history.at("pore_pressure_transfer")[2] == Approx(10e3));
  CHECK(p.velocity[2] == std::array<double, 3>{0.0, 0.0, 0.0});
}

TEST_CASE("each tag carries the law that the script's users give it, and the notes its defects") {
  const QuadMesh mesh = patches();
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), nullptr, config_of());
  REQUIRE(p.materials.size() == 3);
  CHECK(p.materials[0].name == "embankment 167");
  CHECK(p.materials[1].name == "foundation 170");
  CHECK(p.materials[2].name == "liquefied 175");
  CHECK_FALSE(p.materials[1].counts_for_runout);
  for (const MaterialSpec& m : p.materials) CHECK_NOTHROW(from_parameters(m.law, m.parameters));
  CHECK(p.materials[2].parameters.at("cohesion") == 5.6e3);
  CHECK(p.materials[2].parameters.at("residual_cohesion") == 2.8e3);
  CHECK(p.notes == sordo2024_defects());
  std::set<std::string> ids;
  for (const std::string& line : sordo2024_defects()) ids.insert(line.substr(0, 4));
  CHECK(ids.size() == sordo2024_defects().size());
  CHECK(*ids.begin() == "S01 ");
}

TEST_CASE("strength softens with the script's deviatoric strain and phi travels as a tangent") {
  const QuadMesh mesh = patches();
  // Simple shear gamma = 0.04: eps_q = gamma/sqrt 3 = 0.023094, 32.735 % from 0.01 to 0.05. A
  // uniform field is not quite uniform between the centres, hence the tolerance.
  StrainIncrement<2> shear;
  shear[3] = 0.04;
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh, shear), nullptr, config_of());
  const std::size_t embankment = 8;
  REQUIRE(tag_of(p, embankment) == 167);
  const double gamma = p.history.at("gamma_xy")[embankment];
  CHECK(gamma == Approx(0.04).epsilon(0.2));
  const double eps_q = gamma / std::sqrt(3.0);
  const double degree = (eps_q - 0.01) / 0.04;
  CHECK(p.history.at("svars_6")[embankment] == Approx(eps_q).epsilon(1e-12));
  CHECK(p.history.at("plastic_strain")[embankment] == p.history.at("svars_6")[embankment]);
  CHECK(p.history.at("svars_2")[embankment] == Approx(20e3 - 19e3 * degree).epsilon(1e-12));
  CHECK(p.history.at("svars_0")[embankment] ==
        Approx(std::tan((35.0 - 15.0 * degree) * 3.14159 / 180.0)).epsilon(1e-12));
  const std::size_t foundation = 16;
  CHECK(p.history.at("nstate_vars")[foundation] == 0.0);
  CHECK(p.history.at("svars_6")[foundation] == 0.0);
}

TEST_CASE("layers follow the element's initial stress; 50 kPa belongs below, 300 kPa to none") {
  const QuadMesh mesh = patches();
  FemFrame gravity = gravity_of(mesh);
  gravity.stress[0][1] = -50e3;
  gravity.stress[1][1] = 1e3;
  const ParticleSet p = map_sordo2024(mesh, gravity, nullptr, config_of());
  CHECK(tag_of(p, 0) == 175);
  CHECK(tag_of(p, 4) == 176);
  gravity.stress[0][1] = -300e3;
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, nullptr, config_of()),
                    Contains("element 1 ") && Contains("exactly 300000 Pa"));
  gravity.stress[0][1] = -300.1e3;
  CHECK(tag_of(map_sordo2024(mesh, gravity, nullptr, config_of()), 0) == 169);
}

TEST_CASE("the water table is tested by elevation alone") {
  QuadMesh mesh = patches();
  for (std::size_t n = 6; n < 9; ++n) mesh.nodes[n][1] = 14.0;  // lower side of the embankment
  for (std::size_t n = 9; n < 12; ++n) mesh.nodes[n][1] = 14.3;
  // Points at 14.06 and 14.24 m around 18.427/1.303 = 14.142 m; at x = 0 the line is at 18.4 m.
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), nullptr, config_of());
  CHECK(tag_of(p, 8) == 166);
  CHECK(tag_of(p, 10) == 167);
}

TEST_CASE("tailings liquefy above the line before the base shift, or by r_u") {
  const QuadMesh mesh = patches();
  SordoConfig c = config_of(SordoLiquefied::line);
  c.line = {{-99.0, 10.0}, {-98.0, 30.0}};
  FemFrame f = shaking_of(mesh, {0.5, 0.0});
  // Moved by 0.5 m, the first point of the second element is at (-98.29, 20.21), where the line is
  // at 24.2 m; without the movement it would be at -98.79, where the line is at 14.2 m.
  ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), &f, c);
  CHECK(tag_of(p, 0) == 175);
  CHECK(tag_of(p, 1) == 175);
  CHECK(tag_of(p, 4) == 168);
  CHECK(p.position[6][0] == Approx(-98.5 + 0.57735 / 2).epsilon(1e-14));
  CHECK(p.displacement[6][0] == 0.0);
  CHECK(p.velocity[6][0] == Approx(0.3));
  f.pore_pressure.assign(mesh.num_nodes(), 10e3 + 0.71 * 60e3);
  p = map_sordo2024(mesh, gravity_of(mesh), &f, c);
  CHECK(tag_of(p, 4) == 175);
  CHECK(p.history.at("r_u")[4] == Approx(0.71));
}

TEST_CASE("volume follows the deformed element, mass does not") {
  const QuadMesh mesh = patches();
  FemFrame f = shaking_of(mesh, {0.0, 0.0});
  for (std::size_t n = 3; n < 6; ++n) f.displacement[n][1] = 0.1;  // upper side of the tailings
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), &f, config_of());
  CHECK(p.volume[0] == Approx(1.1 / 4));
  CHECK(p.mass[0] == Approx(1870.0 / 4));
  CHECK(p.history.at("epsilon_v")[0] == Approx(0.1));
}

TEST_CASE("points outside the box are dropped and the rest numbered from zero") {
  const QuadMesh mesh = patches();
  SordoConfig c = config_of();
  c.keep_x = {-50.0, 50.0};
  const ParticleSet p = map_sordo2024(mesh, gravity_of(mesh), nullptr, c);
  REQUIRE(p.size() == 16);
  CHECK(p.id.front() == 0);
  CHECK(p.id.back() == 15);
  c.keep_x = {50.0, 60.0};
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity_of(mesh), nullptr, c), Contains("no point"));
}

TEST_CASE("what the script would pass over in silence is an error") {
  const QuadMesh mesh = patches();
  const FemFrame gravity = gravity_of(mesh);
  FemFrame f = shaking_of(mesh, {0.0, 0.0});
  SordoConfig c = config_of();
  c.densities.pop_back();
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, nullptr, c),
                    Contains("material 170 of element 5") && Contains("no mass"));
  c = config_of();
  c.strengths.erase(c.strengths.begin() + 1);
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, nullptr, c), Contains("no row for material 167"));
  c = config_of();
  c.base_node = 101;
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, &f, c), Contains("node 101") && Contains("base"));
  c.base_node = 7;
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, &f, c), Contains("no node 7"));
  c = config_of();
  f.velocity.clear();
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, &f, c), Contains("velocity"));
  f = shaking_of(mesh, {0.0, 0.0});
  f.displacement[4][1] = -3.0;
  CHECK_THROWS_WITH(map_sordo2024(mesh, gravity, &f, c), Contains("element 1") && Contains("area"));
}

TEST_CASE("settings that contradict themselves are refused") {
  const auto refused = [](auto change, const char* text) {
    SordoConfig c = config_of(SordoLiquefied::line);
    change(c);
    CHECK_THROWS_WITH(check(c), Contains(text));
  };
  CHECK_NOTHROW(check(config_of(SordoLiquefied::line)));
  refused([](SordoConfig& c) { c.line.pop_back(); }, "two points");
  refused([](SordoConfig& c) { std::swap(c.line[0], c.line[1]); }, "two points");
  refused([](SordoConfig& c) { c.liquefied = SordoLiquefied::all; }, "ignored");
  refused([](SordoConfig& c) { std::swap(c.layers[0], c.layers[1]); }, "not deeper");
  refused([](SordoConfig& c) { c.strengths.push_back(c.strengths[0]); }, "two rows");
  refused([](SordoConfig& c) { c.strengths[0][6] = 0.0; }, "must be larger");
  refused([](SordoConfig& c) { c.strengths[0][1] = kUnset; }, "friction angle");
  refused([](SordoConfig& c) { c.densities[0][1] = kUnset; }, "not positive");
  refused([](SordoConfig& c) { c.densities[0][0] = 167.5; }, "whole number");
  refused([](SordoConfig& c) { c.keep_y = {1.0, 0.0}; }, "empty");
}
