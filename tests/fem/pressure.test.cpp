#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

TEST_CASE("Still water is hydrostatic on distorted elements", "[fem]") {
  const SectionMesh s = section({.distortion = 0.25});
  const Model model = build_model(s, config(elastic_soil(), 4.0));
  const Layout l = make_layout(model);
  const std::vector<double> p = steady_pressure(model, l, make_pressure_system(model, l));
  for (std::size_t i = 0; i < p.size(); ++i)
    CHECK(p[i] == Approx(9810.0 * (4.0 - s.mesh.nodes[i][1])).margin(1e-7));
}

TEST_CASE("Seepage between two levels is linear, whatever the permeabilities", "[fem]") {
  const SectionMesh s = section({.distortion = 0.25});
  FemConfig c = config(elastic_soil(), 4.0);
  c.materials["soil"].permeability = {1e-3, 1e-6};
  Model model = build_model(s, c);
  const auto head = [](Vec2 x) { return 9810.0 * (4.0 - x[1]) + 3000.0 * x[0] + 500.0 * x[1]; };
  for (std::size_t i = 0; i < s.mesh.num_nodes(); ++i) {
    const auto [x, y] = s.mesh.nodes[i];
    const bool outer = x == 0.0 || x == 4.0 || y == 0.0 || y == 4.0;
    model.known_pressure[i] = outer ? head(s.mesh.nodes[i]) : kUnset;
  }
  const Layout l = make_layout(model);
  const std::vector<double> p = steady_pressure(model, l, make_pressure_system(model, l));
  for (std::size_t i = 0; i < p.size(); ++i)
    CHECK(p[i] == Approx(head(s.mesh.nodes[i])).epsilon(1e-10));
}

TEST_CASE("Drained soil and soil above the water have no pressure unknown", "[fem]") {
  FemConfig c = config(elastic_soil(), 2.0);
  const SectionMesh s = section({});
  const Model half = build_model(s, c);
  CHECK(make_pressure_system(half, make_layout(half)).num_equations == 2 * 5);
  c.materials["soil"].drained = true;
  const Model none = build_model(s, c);
  CHECK(make_pressure_system(none, make_layout(none)).num_equations == 0);
}
