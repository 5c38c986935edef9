#include "model/shape_quad.hpp"
#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

namespace {

Elements distorted(Model& model) {
  model = build_model(section({.distortion = 0.25}), config(elastic_soil(), 4.0));
  return make_layout(model).elements;
}

}  // namespace

TEST_CASE("A linear field strains every quadrilateral alike and has no hourglass part", "[fem]") {
  Model model;
  const Elements g = distorted(model);
  const Layout l = make_layout(model);
  double area = 0.0;
  for (std::size_t e = 0; e < g.size(); ++e) {
    double ux_x = 0, ux_y = 0, hour = 0, shares = 0;
    for (int i = 0; i < 4; ++i) {
      const auto [x, y] = model.mesh.nodes[l.nodes[e][i]];
      const double u = 0.3 + 2.0 * x - 0.7 * y;
      ux_x += g.bx[i][e] * u;
      ux_y += g.by[i][e] * u;
      hour += g.gamma[i][e] * u;
      shares += g.share[i][e];
    }
    CHECK(ux_x == Approx(2.0).epsilon(1e-12));
    CHECK(ux_y == Approx(-0.7).epsilon(1e-12));
    CHECK(std::abs(hour) < 1e-13);
    CHECK(shares == Approx(1.0).epsilon(1e-13));
    area += g.area[e];
  }
  CHECK(area == Approx(16.0).epsilon(1e-12));
}

TEST_CASE("The shares of the nodes are the integrals of their shape functions", "[fem]") {
  Model model;
  const Elements g = distorted(model);
  const Layout l = make_layout(model);
  const double at = 1.0 / std::sqrt(3.0);
  for (std::size_t e = 0; e < g.size(); ++e) {
    const auto quad = corners(model.mesh, model.mesh.nodes, l.order[e]);
    std::array<double, 4> sum{};
    for (const double xi : {-at, at})
      for (const double eta : {-at, at})
        for (int i = 0; i < 4; ++i) sum[i] += shape(xi, eta)[i] * jacobian(quad, xi, eta);
    for (int i = 0; i < 4; ++i) CHECK(g.share[i][e] * g.area[e] == Approx(sum[i]).epsilon(1e-12));
  }
}

TEST_CASE("Hourglass energy of a rectangle is that of its deviatoric strain", "[fem]") {
  const SectionMesh s = section({.columns = 1, .rows = 1, .width = 3.0, .height = 0.5});
  FemConfig c = config(elastic_soil(), 0.5);
  c.sides.kind = SideKind::fixed;
  const Model model = build_model(s, c);
  const Elements g = make_layout(model).elements;
  // u_x = q xi eta strains xx by q eta/a, half of it is kept as a deviator:
  // 2 G (q eta/(2 a))^2 2 integrated over the area
  // 2 G (q eta/(2 a))^2 over the area
  const double q = 0.01, a = 1.5, b = 0.25;
  CHECK(0.5 * g.hss[0] * q * q == Approx(2.0 * q * q / (4.0 * a * a) * (4.0 * a * b / 3.0)));
  CHECK(g.hst[0] == Approx(0.0).margin(1e-15));
}
