#include "transfer/zone/zone_extent.hpp"

#include "core/check.hpp"
#include "tests/transfer/zone_grid.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// 10 x 10 squares of 1 m; r_u 0.9 where `is_liquefied(x)`, else 0.1: it falls through 0.7 a
/// quarter of a metre below the lowest liquefied node.
struct Square {
  QuadMesh mesh = rectangle_mesh(10, 10, 1.0, 1.0, 1);
  std::vector<double> r_u;
  template <class F>
  explicit Square(F&& is_liquefied) {
    for (const Vec2& x : mesh.nodes) r_u.push_back(is_liquefied(x) ? 0.9 : 0.1);
  }
  [[nodiscard]] std::vector<Vec2> boundary(const ColumnConfig& config = {}) const {
    return column_boundary(mesh, all_elements(mesh), r_u, 0.7, config);
  }
};

}  // namespace

TEST_CASE("columns of a regular mesh follow its node columns", "[transfer]") {
  const Square square([](Vec2 x) { return x[1] >= (x[0] < 4.5 ? 3.0 : 6.0); });
  const std::vector<Vec2> line = square.boundary();
  REQUIRE(line.size() == 11);
  for (const Vec2& p : line) {
    CHECK(p[0] == Approx(std::round(p[0])));
    CHECK(p[1] == Approx(p[0] < 4.5 ? 2.75 : 5.75));
  }
}

TEST_CASE("what lies above a liquefied point belongs to the zone", "[transfer]") {
  const Square square([](Vec2 x) { return x[1] == 2.0; });
  for (const Vec2& p : square.boundary()) CHECK(p[1] == Approx(1.75));
}

TEST_CASE("a column without liquefaction is closed at its top", "[transfer]") {
  const Square square([](Vec2 x) { return x[0] <= 5.0 && x[1] >= 4.0; });
  for (const Vec2& p : square.boundary()) CHECK(p[1] == Approx(p[0] < 5.5 ? 3.75 : 10.0));
}

TEST_CASE("a lone noisy node does not drag its column down unless asked to", "[transfer]") {
  const Square square([](Vec2 x) { return x[1] >= 6.0 || (x[0] == 3.0 && x[1] == 1.0); });
  for (const Vec2& p : square.boundary()) CHECK(p[1] == Approx(5.75));
  CHECK(square.boundary({.width = {}, .neighbours = 0})[3][1] == Approx(0.75));
}

TEST_CASE("the boundary can be that of nodes", "[transfer]") {
  const Square square([](Vec2 x) { return x[1] >= 6.0; });
  for (const Vec2& p : square.boundary({.width = {}, .neighbours = 1, .interpolate = false}))
    CHECK(p[1] == 6.0);
}

TEST_CASE("the boundary does not jump by a row when r_u crosses its threshold", "[transfer]") {
  Square square([](Vec2 x) { return x[1] >= 6.0; });
  const auto jump = [&square](bool interpolate) {
    const ColumnConfig config{.width = {}, .neighbours = 1, .interpolate = interpolate};
    std::array<double, 2> y{};
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t n = 5 * 11; n < 6 * 11; ++n) square.r_u[n] = 0.7 + (k == 0 ? -1e-6 : 1e-6);
      y[k] = square.boundary(config)[4][1];
    }
    return y[0] - y[1];
  };
  CHECK(jump(true) == Approx(0.0).margin(1e-4));
  CHECK(jump(false) == Approx(1.0));
}

TEST_CASE("narrow columns without nodes are bridged", "[transfer]") {
  const Square square([](Vec2 x) { return x[1] >= 10.0 - x[0]; });
  const std::vector<Vec2> line = square.boundary({.width = 0.25, .neighbours = 0});
  REQUIRE(line.size() == 11);
  CHECK(height_on(line, 6.5) == Approx(3.25));
  CHECK_THROWS_AS(square.boundary({.width = 1e-9, .neighbours = 0}), InputError);
}

TEST_CASE("undefined r_u is not liquefied", "[transfer]") {
  Square square([](Vec2 x) { return x[1] >= 6.0; });
  for (std::size_t n = 0; n < square.mesh.num_nodes(); ++n) {
    if (square.mesh.nodes[n][1] < 8.0) square.r_u[n] = kUnset;
  }
  for (const Vec2& p : square.boundary()) CHECK(p[1] == 8.0);
}

TEST_CASE("a line is level to its left and goes on to its right", "[transfer]") {
  const std::vector<Vec2> line{{-31.2, 21.0}, {12.3, 9.8}};
  CHECK(height_on(line, -100.0) == 21.0);
  CHECK(height_on(line, 12.3) == Approx(9.8));
  CHECK(height_on(line, 20.0) == Approx(9.8 - 7.7 * 11.2 / 43.5));
  CHECK(contains({line, {}}, {-50.0, 21.0}));
  CHECK_FALSE(contains({line, {}}, {-50.0, 20.9}));
}

TEST_CASE("a polygon need not be convex", "[transfer]") {
  ZoneConfig config;
  config.zone = ZoneExtent::polygon;
  config.polygon = {{0, 0}, {4, 2}, {8, 0}, {8, 10}, {0, 10}};
  const QuadMesh mesh = rectangle_mesh(1, 1, 1.0, 1.0, 1);
  const ZoneShape shape = zone_shape(config, mesh, all_elements(mesh), {});
  CHECK(contains(shape, {4.0, 5.0}));
  CHECK(contains(shape, {1.0, 0.6}));
  CHECK(contains(shape, {8.0, 5.0}));
  CHECK_FALSE(contains(shape, {4.0, 1.9}));
  CHECK_FALSE(contains(shape, {9.0, 5.0}));
  CHECK(shape.lower_boundary == std::vector<Vec2>{{0, 0}, {4, 2}, {8, 0}});
  std::ranges::reverse(config.polygon);
  CHECK(zone_shape(config, mesh, all_elements(mesh), {}).lower_boundary == shape.lower_boundary);
}
