#include "tests/support/paths.hpp"
#include "verify/fem/scene.hpp"

#include <fstream>
#include <map>
#include <set>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

/// fixtures/opensees/dam-rio270: a dam of 1849 elements in OpenSees, whose state at rest is met.
namespace {

const std::string kFolder = test::fixture("opensees/dam-rio270/");

/// The section without its free-field columns.
SectionMesh dam_section() {
  SectionMesh s;
  std::map<double, std::int32_t> index;
  double tag, x, y;
  for (std::ifstream nodes(kFolder + "nodeinfo.dat"); nodes >> tag >> x >> y;) {
    if (x < -340.01 || x > 87.51) continue;
    index[tag] = static_cast<std::int32_t>(s.mesh.num_nodes());
    s.mesh.nodes.push_back({x, y});
    s.mesh.node_tags.push_back(static_cast<std::int64_t>(tag));
  }
  std::array<double, 5> row;
  for (std::ifstream in(kFolder + "elementinfo.dat");
       in >> tag >> row[0] >> row[1] >> row[2] >> row[3] >> row[4];) {
    bool inside = true;
    for (int i = 0; i < 4; ++i) inside = inside && index.count(row[i]) > 0;
    if (!inside) continue;
    s.mesh.elements.push_back({index[row[0]], index[row[1]], index[row[2]], index[row[3]]});
    s.mesh.element_tags.push_back(static_cast<std::int64_t>(tag));
    s.mesh.element_material.push_back(static_cast<std::int32_t>(row[4]));
  }
  s.materials = {{"embankment", 167}, {"tailings", 168}, {"foundation", 170}};
  std::set<std::array<std::int32_t, 2>> edges;
  for (const auto& e : s.mesh.elements)
    for (int i = 0; i < 4; ++i) edges.insert({e[i], e[(i + 1) % 4]});
  std::map<std::string, EdgeSet> sets;
  for (const auto& e : edges) {
    if (edges.count({e[1], e[0]}) > 0) continue;
    const auto both = [&](int d, double value) {
      return std::abs(s.mesh.nodes[e[0]][d] - value) < 1e-6 &&
             std::abs(s.mesh.nodes[e[1]][d] - value) < 1e-6;
    };
    const char* name = both(1, -5.0)     ? "base"
                       : both(0, -340.0) ? "left"
                       : both(0, 87.5)   ? "right"
                                         : "surface";
    sets[name].name = name;
    sets[name].edges.push_back(e);
  }
  for (auto& [unused, set] : sets) s.sets.push_back(set);
  return s;
}

FemMaterialConfig soil_of(double density, double e, double Dr, double G0, double Q, double R) {
  FemMaterialConfig m;
  m.density = density;
  m.void_ratio = e;
  m.permeability = {1e-6, 1e-6};
  m.laws.of<PM4Sand>().emplace();
  m.laws.of<PM4Sand>()->Dr = Dr;
  m.laws.of<PM4Sand>()->G0 = G0;
  m.laws.of<PM4Sand>()->hpo = 0.4;
  m.laws.of<PM4Sand>()->Q = Q;
  m.laws.of<PM4Sand>()->R = R;
  return m;
}

FemConfig dam_config() {
  FemConfig c;
  c.materials["tailings"] = soil_of(1870.0, 0.99, 0.35, 476.0, 11.998, 3.75);
  c.materials["embankment"] = soil_of(1690.0, 1.2, 0.55, 677.0, 10.0, 1.5);
  c.materials["foundation"] = soil_of(1900.0, 0.8, 0.75, 890.0, 10.0, 1.5);
  c.water.emplace();
  c.water->table = {{-38.0, 30.0}, {20.0, 12.51}, {20.5, 12.21}, {60.8, 0.0}};
  c.gravity.permeability = 1e-2;
  c.base.shear_wave_velocity = 760.0;
  c.base.density = 2200.0;
  return c;
}

std::vector<double> first_row(const char* file) {
  std::vector<double> r;
  double x;
  std::ifstream in(kFolder + file);
  in >> x;
  while (in >> x) r.push_back(1e3 * x);
  return r;
}

}  // namespace

TEST_CASE("The dam at rest has the stresses and pore pressures of OpenSees", "[fem]") {
  const SectionMesh section = dam_section();
  REQUIRE(section.mesh.num_elements() == 1835);
  Solver s = make_solver(build_model(section, dam_config()), {});
  CHECK(s.model.mesh.num_elements() == 1849);
  solve_gravity(s, {.permeability = 1e-2, .compacts = true});
  CHECK(out_of_balance(s) < 1e-10);

  const std::vector<double> stress = first_row("Gstress.out");
  REQUIRE(stress.size() == 3 * 1849);
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < s.layout.order.size(); ++k) {
    const auto e = static_cast<std::size_t>(s.layout.order[k]);
    if (e >= section.mesh.num_elements()) continue;
    const std::size_t row = 3 * static_cast<std::size_t>(section.mesh.element_tags[e] - 1);
    const auto& mine = s.state.stress[k];
    for (int i = 0; i < 3; ++i) {
      const double reference = stress[row + i];
      difference += std::pow(mine[i == 2 ? 3 : i] - reference, 2);
      size += reference * reference;
    }
  }
  CHECK(std::sqrt(difference / size) < 0.02);

  const std::vector<double> pressure = first_row("GporePressure.out");
  double worst = 0.0;
  for (std::size_t i = 0; i < section.mesh.num_nodes(); ++i)
    worst =
        std::max(worst, std::abs(s.state.pressure[i] - pressure[section.mesh.node_tags[i] - 1]));
  CHECK(worst < 1e3);  // of 343 kPa; the recorder has six digits
}

TEST_CASE("A control with another K_0 does not have the stresses of OpenSees", "[fem]") {
  const SectionMesh section = dam_section();
  FemConfig c = dam_config();
  c.materials["tailings"].k0 = 0.45;
  Solver s = make_solver(build_model(section, c), {});
  solve_gravity(s, {.permeability = 1e-2});
  const std::vector<double> stress = first_row("Gstress.out");
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < s.layout.order.size(); ++k) {
    const auto e = static_cast<std::size_t>(s.layout.order[k]);
    if (e >= section.mesh.num_elements()) continue;
    const double reference = stress[3 * static_cast<std::size_t>(section.mesh.element_tags[e] - 1)];
    difference += std::pow(s.state.stress[k][0] - reference, 2);
    size += reference * reference;
  }
  CHECK(std::sqrt(difference / size) > 0.05);
}
