#include "report/runout.hpp"

#include "core/check.hpp"

#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

struct Points {
  std::vector<std::array<double, 3>> position;
  std::vector<std::uint8_t> counts;
  std::vector<double> mass;
};

/// Points at x = 1, 2, ..., n in no particular order, all of mass 2.
Points row(int n) {
  Points p;
  for (int i = 0; i < n; ++i) {
    p.position.push_back({1.0 + (7 * i) % n, -3.0, 0.0});
    p.counts.push_back(1);
    p.mass.push_back(2.0);
  }
  return p;
}

}  // namespace

TEST_CASE("The front is the fifth-farthest point") {
  const Points p = row(20);
  CHECK(front_position(p.position, p.counts) == 16.0);
  CHECK(runout(p.position, p.counts, 10.0) == 6.0);
}

TEST_CASE("Runout is zero if the flow does not pass the toe") {
  const Points p = row(20);
  CHECK(runout(p.position, p.counts, 16.0) == 0.0);
  CHECK(runout(p.position, p.counts, 75.0) == 0.0);
}

TEST_CASE("The foundation does not count") {
  Points p = row(20);
  for (std::size_t i = 0; i < p.position.size(); ++i)
    if (p.position[i][0] > 18.0) p.counts[i] = 0;
  CHECK(front_position(p.position, p.counts) == 14.0);
}

TEST_CASE("Points at the same x have ranks of their own") {
  Points p = row(6);
  for (auto& x : p.position) x[0] = 4.0;
  CHECK(front_position(p.position, p.counts) == 4.0);
}

TEST_CASE("Four detached points do not move the front, five do") {
  Points p = row(20);
  int moved = 0;
  for (auto& x : p.position)
    if (x[0] > 16.0) {
      x[0] += 1000.0;
      ++moved;
    }
  REQUIRE(moved == 4);
  CHECK(front_position(p.position, p.counts) == 16.0);
  for (auto& x : p.position)
    if (x[0] == 16.0) x[0] += 1000.0;
  CHECK(front_position(p.position, p.counts) == 1016.0);
}

TEST_CASE("The mass quantile leaves out a share of the mass") {
  const Points p = row(1000);
  CHECK(front_quantile(p.position, p.counts, p.mass, 0.005) == 995.0);
  CHECK(front_quantile(p.position, p.counts, p.mass, 0.0) == 1000.0);
  Points heavy = row(1000);
  for (std::size_t i = 0; i < heavy.mass.size(); ++i)
    if (heavy.position[i][0] == 1000.0) heavy.mass[i] = 1e6;
  CHECK(front_quantile(heavy.position, heavy.counts, heavy.mass, 0.005) == 1000.0);
}

TEST_CASE("Refuses what has no front") {
  Points p = row(4);
  CHECK_THROWS_AS(front_position(p.position, p.counts), InputError);
  p = row(8);
  p.counts.pop_back();
  CHECK_THROWS_AS(front_position(p.position, p.counts), InputError);
  p = row(8);
  p.position[3][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(front_position(p.position, p.counts), InputError);
  p.counts[3] = 0;
  CHECK_NOTHROW(front_position(p.position, p.counts));
  CHECK_THROWS_AS(runout(p.position, p.counts, kUnset), InputError);
  p = row(8);
  p.mass[2] = kUnset;
  CHECK_THROWS_AS(front_quantile(p.position, p.counts, p.mass, 0.1), InputError);
  p.mass[2] = 1.0;
  CHECK_THROWS_AS(front_quantile(p.position, p.counts, p.mass, 1.0), InputError);
}
