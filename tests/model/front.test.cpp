#include "model/front.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// n points of equal mass at 1/n, 2/n, ..., 1, shuffled.
std::vector<Place> row(int n, unsigned seed) {
  std::vector<Place> p;
  for (int i = 1; i <= n; ++i) p.push_back({double(i) / n, 3.0});
  std::shuffle(p.begin(), p.end(), std::mt19937(seed));
  return p;
}

}  // namespace

TEST_CASE("Fronts by mass do not depend on the number of points, the fifth point does") {
  for (const int n : {200, 7400, 100'000}) {
    std::vector<Place> p = row(n, 1);
    const Fronts f = fronts(p);
    CAPTURE(n);
    const double point = 1.0 / n;
    CHECK(std::abs(f.q995 - 0.995) <= point);
    CHECK(std::abs(f.q99 - 0.99) <= point);
    CHECK(std::abs(f.q95 - 0.95) <= point);
    CHECK(std::abs(f.equal_mass - (1.0 - 5.0 / 7400.0)) <= point);
    CHECK(f.fifth == Approx(1.0 - 4.0 * point).epsilon(1e-12));
  }
}

TEST_CASE("With the points of the case study the front of equal mass is next to its fifth point") {
  std::vector<Place> p = row(7400, 2);
  const Fronts f = fronts(p);
  CHECK(std::abs(f.equal_mass - f.fifth) < 1.5 / 7400.0);
}

TEST_CASE("A front counts mass, not points") {
  std::vector<Place> p = row(1000, 3);
  for (Place& q : p)
    if (q.at > 0.9) q.mass = 0.03;  // a hundredth of the others: 0.1 % of the mass beyond 0.9
  const Fronts f = fronts(p);
  CHECK(f.q995 < 0.9);
  CHECK(f.q99 < f.q995);
  CHECK(f.fifth > 0.99);
}

TEST_CASE("Fronts have the same bits for any order of the points") {
  std::vector<Place> a;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  // Masses are powers of two, so that the total does not hang on the order either.
  for (int i = 0; i < 5000; ++i)
    a.push_back({std::round(50.0 * uniform(random)), uniform(random) < 0.5 ? 1.0 : 0.25});
  std::vector<Place> b = a;
  std::shuffle(b.begin(), b.end(), random);
  const Fronts f = fronts(a), g = fronts(b);
  CHECK(f.q995 == g.q995);
  CHECK(f.q95 == g.q95);
  CHECK(f.equal_mass == g.equal_mass);
  CHECK(f.fifth == g.fifth);
}

TEST_CASE("Few points, or none, have fronts too") {
  std::vector<Place> none, two = row(2, 5);
  CHECK(fronts(none).fifth == 0.0);
  CHECK(fronts(two).fifth == 0.5);
  CHECK(fronts(two).q95 == 1.0);
  CHECK(height(none) == 0.0);
  CHECK(height(two) == 1.0);
}
