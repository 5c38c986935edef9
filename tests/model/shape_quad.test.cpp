#include "model/shape_quad.hpp"

#include "core/check.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

constexpr std::array<Vec2, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Convex quadrilateral: corners moved by up to 0.8 of the half side, kept if all angles are below
/// 180 degrees by a margin.
std::optional<std::array<Vec2, 4>> distorted(std::mt19937& random, Vec2 origin) {
  std::uniform_real_distribution<double> move(-0.8, 0.8);
  std::array<Vec2, 4> quad = kCorners;
  for (Vec2& c : quad) c = {origin[0] + c[0] + move(random), origin[1] + c[1] + move(random)};
  for (Vec2 c : kCorners)
    if (jacobian(quad, c[0], c[1]) < 0.02) return std::nullopt;
  return quad;
}

}  // namespace

TEST_CASE("shape functions sum to one and are one at their node") {
  for (double xi : {-1.0, -0.3, 0.0, 0.77, 1.0})
    for (double eta : {-1.0, 0.1, 0.9}) {
      const std::array<double, 4> n = shape(xi, eta);
      CHECK(n[0] + n[1] + n[2] + n[3] == Approx(1.0).margin(1e-15));
    }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j)
      CHECK(shape(kCorners[k][0], kCorners[k][1])[j] == (j == k ? 1.0 : 0.0));
}

TEST_CASE("a linear field is interpolated exactly") {
  const std::array<Vec2, 4> quad{{{0, 0}, {4, 1}, {5, 4}, {-1, 3}}};
  std::array<double, 4> f{};
  for (std::size_t k = 0; k < 4; ++k) f[k] = 2.0 - 3.0 * quad[k][0] + 5.0 * quad[k][1];
  const Vec2 x = interpolate(quad, 0.3, -0.6);
  CHECK(interpolate(f, 0.3, -0.6) == Approx(2.0 - 3.0 * x[0] + 5.0 * x[1]).epsilon(1e-14));
}

TEST_CASE("jacobian integrates to the area") {
  const std::array<Vec2, 4> quad{{{0, 0}, {4, 1}, {5, 4}, {-1, 3}}};
  const double g = 1.0 / std::sqrt(3.0);
  const double sum =
      jacobian(quad, -g, -g) + jacobian(quad, g, -g) + jacobian(quad, g, g) + jacobian(quad, -g, g);
  CHECK(sum == Approx(area(quad)).epsilon(1e-14));
}

TEST_CASE("natural coordinates invert the map on distorted elements") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inside(-1.0, 1.0);
  const double origin = GENERATE(0.0, 1000.0);
  double worst = 0.0;
  int missed = 0, tried = 0;
  while (tried < 20000) {
    const auto quad = distorted(random, {origin, -origin});
    if (!quad) continue;
    ++tried;
    const Vec2 expected{inside(random), inside(random)};
    const auto found = natural_coordinates(*quad, interpolate(*quad, expected[0], expected[1]));
    if (!found) {
      ++missed;
      continue;
    }
    const Vec2 back = interpolate(*quad, (*found)[0], (*found)[1]);
    const Vec2 there = interpolate(*quad, expected[0], expected[1]);
    worst = std::max({worst, std::abs(back[0] - there[0]), std::abs(back[1] - there[1])});
    // Far from the origin the point itself carries a round-off of 1e-13 m, which the inverse map
    // magnifies by 1 / Jacobian; only near the origin is the error that of the iteration.
    if (origin == 0.0)
      worst = std::max(
          {worst, std::abs((*found)[0] - expected[0]), std::abs((*found)[1] - expected[1])});
  }
  CAPTURE(origin, worst);
  CHECK(missed == 0);
  CHECK(worst < 1e-12);
}

TEST_CASE("points outside an element are refused, points on its edge are not") {
  const std::array<Vec2, 4> quad{{{0, 0}, {4, 1}, {5, 4}, {-1, 3}}};
  CHECK(natural_coordinates(quad, {0.0, 0.0}));
  CHECK(natural_coordinates(quad, {2.0, 0.5}));
  CHECK_FALSE(natural_coordinates(quad, {2.0, 0.49}));
  CHECK_FALSE(natural_coordinates(quad, {1e6, 1e6}));
  CHECK_FALSE(natural_coordinates(quad, {-1.2, 3.0}));
  CHECK_FALSE(natural_coordinates(quad, {kUnset, 1.0}));
  CHECK(natural_coordinates(quad, {2.0, 0.49}, 0.05));
  const std::array<Vec2, 4> collapsed{{{1, 1}, {1, 1}, {1, 1}, {1, 1}}};
  CHECK_FALSE(natural_coordinates(collapsed, {1.5, 1.0}));
}
