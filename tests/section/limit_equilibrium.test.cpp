#include "section/limit_equilibrium.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "section/slip_search.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

constexpr double kDegree = kPi / 180.0;

SlopeModel slope(double cohesion, double friction_deg) {
  SlopeModel m;
  m.soils = {{.name = "soil",
              .unit_weight = 20e3,
              .cohesion = cohesion,
              .friction = friction_deg * kDegree,
              .r_u = {},
              .residual = {}}};
  m.ground = {{-40.0, 10.0}, {0.0, 10.0}, {20.0, 0.0}, {60.0, 0.0}};
  m.zones = {
      {0, {{-40.0, -20.0}, {60.0, -20.0}, {60.0, 0.0}, {20.0, 0.0}, {0.0, 10.0}, {-40.0, 10.0}}}};
  return m;
}

/// A thin slab parallel to the slope, with steep ends.
std::vector<Vec2> slab(double depth) {
  std::vector<Vec2> s{{0.5, 9.75}};
  for (double x = 1.0; x <= 19.0; x += 1.0) s.push_back({x, 10.0 - 0.5 * x - depth});
  s.push_back({19.4, 0.3});
  return s;
}

}  // namespace

TEST_CASE("dry sand on a plane through the slope stands at tan phi / tan alpha") {
  // A wedge on a straight base: every method gives the same, whatever acts between slices.
  const std::vector<Vec2> plane{{-5.0, 10.0}, {20.0, 0.0}};
  const SlopeModel m = slope(0.0, 30.0);
  const std::vector<Slice> slices = cut_slices(m, plane, 0.5);
  const double exact = std::tan(30.0 * kDegree) / (10.0 / 25.0);
  CHECK(ordinary(slices).value() == Approx(exact).epsilon(1e-9));
  CHECK(spencer(slices).value().factor == Approx(exact).epsilon(1e-6));
}

TEST_CASE("a slab of dry sand parallel to the slope approaches the infinite slope") {
  const SlopeModel m = slope(0.0, 30.0);
  const auto result = spencer(cut_slices(m, slab(0.05), 0.1));
  REQUIRE(result);
  CHECK(result->factor == Approx(std::tan(30.0 * kDegree) / 0.5).epsilon(0.02));
}

TEST_CASE("water lowers the factor by what it takes off the friction") {
  const std::vector<Vec2> plane{{-5.0, 10.0}, {20.0, 0.0}};
  SlopeModel m = slope(0.0, 30.0);
  m.soils[0].r_u = 0.25;
  const double cosine2 = 1.0 / (1.0 + 0.4 * 0.4);
  const double exact = std::tan(30.0 * kDegree) / 0.4 * (1.0 - 0.25 / cosine2);
  CHECK(ordinary(cut_slices(m, plane, 0.5)).value() == Approx(exact).epsilon(1e-9));
}

TEST_CASE("undrained strength on a circle follows from moments alone") {
  const SlopeModel m = slope(20e3, 0.0);
  const Vec2 centre{12.0, 18.0};
  const double radius = 20.0;
  const double left = centre[0] - std::sqrt(radius * radius - 64.0);
  const double right = centre[0] + std::sqrt(radius * radius - 324.0);
  const std::vector<Slice> slices = cut_slices(m, arc(centre, radius, left, right, 400), 1.0);
  double moment = 0.0, length = 0.0;
  for (const Slice& s : slices) {
    moment += s.weight * (centre[0] - s.base[0]);
    length += s.width / std::cos(s.angle);
  }
  const double exact = 20e3 * length * radius / moment;
  // The sliding mass lies left of the centre; moments about it are positive.
  CHECK(bishop(slices).value() == Approx(exact).epsilon(2e-3));
  CHECK(spencer(slices)->factor == Approx(exact).epsilon(2e-3));
}

TEST_CASE("columns weigh what lies above and stand on their own soil") {
  SlopeModel m = slope(0.0, 30.0);
  m.soils.push_back({.name = "crust",
                     .unit_weight = 15e3,
                     .cohesion = 0.0,
                     .friction = 0.0,
                     .r_u = {},
                     .residual = {{0.0, 1e3}, {100e3, 11e3}}});
  m.zones.push_back({1, above_level(m.zones[0].outline, 8.0)});
  m.water_table = {{-40.0, 9.0}, {2.0, 9.0}, {20.0, 0.0}, {60.0, 0.0}};
  const Column deep = column_above(m, {-10.0, 4.0});
  CHECK(deep.weight == Approx(2.0 * 15e3 + 4.0 * 20e3));
  CHECK(deep.pore_pressure == Approx(5.0 * 9810.0));
  CHECK(deep.tan_friction == Approx(std::tan(30.0 * kDegree)));
  const Column shallow = column_above(m, {-10.0, 8.5});
  CHECK(shallow.cohesion == Approx(1e3 + 0.1 * (1.5 * 15e3 - 0.5 * 9810.0)));
  CHECK_FALSE(column_above(m, {-10.0, -30.0}).inside);
  CHECK_FALSE(column_above(m, {-10.0, 11.0}).inside);
}

TEST_CASE("the search finds no more than any circle it could have taken") {
  const SlopeModel m = slope(10e3, 20.0);
  const SlipSearch search{
      .entry = {-15.0, 0.0}, .exit = {15.0, 25.0}, .floor = -5.0, .slice_width = 0.5};
  const CriticalCircle best = search_circles(m, search);
  for (const double r : {16.0, 20.0, 25.0, 30.0})
    for (const double x : {8.0, 12.0, 16.0})
      for (const double y : {14.0, 18.0, 22.0}) {
        if (r <= y - 0.0 || y - r < -5.0) continue;
        const double left = x - std::sqrt(r * r - (y - 10.0) * (y - 10.0));
        const double right = x + std::sqrt(r * r - y * y);
        if (left < -15.0 || left > 0.0 || right < 20.0 || right > 25.0) continue;
        const auto f = bishop(cut_slices(m, arc({x, y}, r, left, right, 60), 0.5));
        if (f) CHECK(best.factor <= *f + 1e-3);
      }
  const CriticalSurface other = search_surfaces(m, search);
  CHECK(other.factor == Approx(best.factor).epsilon(0.03));
}

TEST_CASE("slopes that cannot be computed are refused") {
  SlopeModel m = slope(0.0, 30.0);
  m.water_table = {{-40.0, 12.0}, {60.0, 0.0}};
  CHECK_THROWS_WITH(check(m), Contains("water table stands 2 m above the ground at x = -40"));
  m = slope(-1.0, 30.0);
  CHECK_THROWS_AS(check(m), InputError);
  m = slope(1e3, 30.0);
  m.ground[1][0] = -50.0;
  CHECK_THROWS_WITH(check(m), Contains("x must rise"));
  m = slope(1e3, 30.0);
  CHECK_THROWS_AS(search_circles(m, {.entry = {-5.0, 0.0}, .exit = {20.0, 25.0}, .floor = 9.9}),
                  NumericsError);
}
