#include "transfer/zone/distortion.hpp"

#include "tests/transfer/zone_grid.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Q of a mesh whose nodes are moved by `map`, all elements strained above the threshold.
template <class Map>
Distortion moved(const QuadMesh& mesh, Map&& map) {
  std::vector<Vec2> positions;
  for (const Vec2& x : mesh.nodes) positions.push_back(map(x));
  const std::vector<StrainIncrement<2>> strain(mesh.num_elements(),
                                               StrainIncrement<2>{{0.0, 0.0, 0.0, 0.1}});
  return distortion(mesh, all_elements(mesh), positions, strain, 0.03);
}

}  // namespace

TEST_CASE("pure shear keeps the Jacobian", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(3, 3, 1.0, 2.0, 1);
  const Distortion q = moved(mesh, [](Vec2 x) { return Vec2{x[0] + 0.8 * x[1], x[1]}; });
  CHECK(q.gauss == Approx(1.0).epsilon(1e-14));
  CHECK(q.centre == Approx(1.0).epsilon(1e-14));
  CHECK(q.count == 9);
}

TEST_CASE("a stretch scales Q by its determinant, at the centre and at every Gauss point",
          "[transfer]") {
  const Distortion q = moved(rectangle_mesh(3, 3, 1.0, 2.0, 1), [](Vec2 x) {
    return Vec2{1.1 * x[0], 0.8 * x[1]};
  });
  CHECK(q.gauss == Approx(0.88).epsilon(1e-14));
  CHECK(q.centre == Approx(0.88).epsilon(1e-14));
}

TEST_CASE("hourglassing is seen at the Gauss points and not at the centre", "[transfer]") {
  // Corners moved by (c xi eta, 0) with xi = +-1: det = 1 + c eta over the unit half-width 1.
  const QuadMesh mesh = rectangle_mesh(1, 1, 2.0, 2.0, 1);
  const double c = 0.3;
  const Distortion q = moved(mesh, [c](Vec2 x) {
    return Vec2{x[0] + c * (x[0] - 1.0) * (x[1] - 1.0), x[1]};
  });
  CHECK(q.centre == Approx(1.0).epsilon(1e-14));
  CHECK(q.gauss == Approx(1.0 - c / std::sqrt(3.0)).epsilon(1e-14));
}

TEST_CASE("only elements above the strain threshold count", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(2, 1, 1.0, 1.0, 1);
  std::vector<Vec2> positions = mesh.nodes;
  for (const std::size_t n : {std::size_t{2}, std::size_t{5}}) positions[n][0] = 1.5;
  std::vector<StrainIncrement<2>> strain(2);
  const std::vector<std::int32_t> all{0, 1};
  CHECK(distortion(mesh, all, positions, strain, 0.03).count == 0);
  CHECK(distortion(mesh, all, positions, strain, 0.03).gauss == 1.0);
  CHECK(distortion(mesh, all, positions, strain, 0.03).centre == 1.0);
  // eps_q = gamma / sqrt(3) in simple shear: 3 % is gamma = 5.196 %.
  strain[1] = {{0.0, 0.0, 0.0, 0.0519}};
  CHECK(distortion(mesh, all, positions, strain, 0.03).count == 0);
  strain[1] = {{0.0, 0.0, 0.0, 0.0521}};
  const Distortion q = distortion(mesh, all, positions, strain, 0.03);
  CHECK(q.count == 1);
  CHECK(q.gauss == Approx(0.5));
}
