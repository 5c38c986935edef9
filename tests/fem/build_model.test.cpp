#include "verify/fem/scene.hpp"

#include <numeric>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;
using Catch::Matchers::Contains;

namespace {

FemConfig compliant(SideKind sides) {
  FemConfig c = config(elastic_soil(), 4.0);
  c.base.motion = BaseMotionKind::outcrop;
  c.base.shear_wave_velocity = 700.0;
  c.base.density = 2200.0;
  c.sides.kind = sides;
  c.sides.width = 3.0;
  c.sides.thickness = 500.0;
  return c;
}

}  // namespace

TEST_CASE("Free-field columns stand beside the section and move as its ends", "[fem]") {
  const SectionMesh s = section({});
  const Model m = build_model(s, compliant(SideKind::free_field));
  CHECK(m.mesh.num_nodes() == s.mesh.num_nodes() + 10);
  CHECK(m.mesh.num_elements() == s.mesh.num_elements() + 8);
  const Layout l = make_layout(m);
  const double mass = std::accumulate(l.mass.begin(), l.mass.end() - 1, 0.0);
  double vertical = 0.0;
  for (const double w : l.weight) vertical -= w;
  CHECK(vertical / 9.81 == Approx(1900.0 * (16.0 + 2.0 * 4.0 * 3.0 * 500.0)));
  CHECK(mass > vertical / 9.81);  // both directions are counted
  for (std::size_t i = s.mesh.num_nodes(); i < m.mesh.num_nodes(); ++i) {
    const double x = m.mesh.nodes[i][0];
    CHECK((x == -3.0 || x == 7.0));
  }
  // the base moves as one: a dashpot for the whole area
  REQUIRE(m.base_dofs.size() == 1);
  CHECK(m.base_dashpots[0] == Approx(2200.0 * 700.0 * (4.0 + 2.0 * 3.0 * 500.0)));
}

TEST_CASE("A base that is not one plane has a dashpot for each node", "[fem]") {
  FemConfig c = compliant(SideKind::tied);
  c.base.rigid_plane = false;
  const Model m = build_model(section({}), c);
  CHECK(m.base_dofs.size() == 4);
  CHECK(std::accumulate(m.base_dashpots.begin(), m.base_dashpots.end(), 0.0) ==
        Approx(2200.0 * 700.0 * 4.0));
}

TEST_CASE("A pond presses on the surface and sets its pore pressure", "[fem]") {
  FemConfig c = config(elastic_soil(), 5.5);
  const SectionMesh s = section({});
  const Model m = build_model(s, c);
  double down = 0.0;
  for (const double f : m.load) down -= f;
  CHECK(down == Approx(9810.0 * 1.5 * 4.0));
  CHECK(m.known_pressure[s.mesh.num_nodes() - 1] == Approx(9810.0 * 1.5));
  Solver r = make_solver(m, {});
  solve_gravity(r, {});
  CHECK(out_of_balance(r) < 1e-12);
  // effective stress does not know of the pond
  for (std::size_t e = 0; e < r.state.stress.size(); ++e) {
    const auto row = r.layout.order[e] / 4;
    const double depth = 3.5 - static_cast<double>(row);
    CHECK(r.state.stress[e][1] == Approx(-(1900.0 - 1000.0) * 9.81 * depth).epsilon(1e-9));
  }
}

TEST_CASE("Free-field columns know the pond above them", "[fem]") {
  // 40 m of water over level ground: the effective stress is that of its buoyant weight
  for (const double table : {4.0, 44.0}) {
    FemConfig c = compliant(SideKind::free_field);
    c.water->table = {{0.0, table}};
    const Model m = build_model(section({}), c);
    Solver r = make_solver(m, {});
    solve_gravity(r, {});
    CHECK(out_of_balance(r) < 1e-12);
    for (std::size_t e = 0; e < r.state.stress.size(); ++e) {
      if (r.layout.order[e] >= 16) continue;
      const auto row = r.layout.order[e] / 4;
      const double depth = 3.5 - static_cast<double>(row);
      CHECK(r.state.stress[e][1] == Approx(-900.0 * 9.81 * depth).epsilon(1e-9));
      CHECK(r.state.stress[e][3] == Approx(0.0).margin(1e-4));
    }
  }
}

TEST_CASE("Messages of the model name what does not fit", "[fem]") {
  const SectionMesh s = section({});
  FemConfig c = config(elastic_soil(), 4.0);
  c.materials["clay"] = c.materials["soil"];
  CHECK_THROWS_WITH(build_model(s, c), Contains("clay"));
  c.materials.erase("soil");
  CHECK_THROWS_WITH(build_model(s, c), Contains("soil"));
  c = config(elastic_soil(), 4.0);
  c.materials["soil"].laws.of<MohrCoulomb>() = MohrCoulomb::Params{};
  CHECK_THROWS_WITH(build_model(s, c), Contains("2 constitutive laws"));
  c = config(elastic_soil(), 4.0);
  c.base.motion = BaseMotionKind::outcrop;
  CHECK_THROWS_WITH(build_model(s, c), Contains("rigid"));
  c = config(elastic_soil(), 4.0);
  c.water->drains = {"toe"};
  CHECK_THROWS_WITH(build_model(s, c), Contains("toe"));
}
