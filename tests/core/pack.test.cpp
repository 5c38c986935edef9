#include "core/pack_pair.hpp"

#include <numeric>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("Roots and reciprocals of lanes are those of the library to round-off", "[core]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-100.0, 100.0);
  for (int i = 0; i < 2000; ++i) {
    Pack x;
    for (int k = 0; k < Pack::lanes; ++k) x.v[k] = std::pow(10.0, exponent(random));
    const Pack a = reciprocal(x), minus = reciprocal(-x), b = inverse_sqrt(x), c = sqrt(x);
    for (int k = 0; k < Pack::lanes; ++k) {
      CHECK(a[k] == Approx(1.0 / x[k]).epsilon(1e-15));
      CHECK(minus[k] == -a[k]);
      CHECK(b[k] == Approx(1.0 / std::sqrt(x[k])).epsilon(1e-15));
      CHECK(c[k] == Approx(std::sqrt(x[k])).epsilon(1e-15));
    }
  }
  CHECK(sqrt(Pack(0.0))[0] == 0.0);
}

TEMPLATE_TEST_CASE("A sum over points has the order of the widest registers", "[core]", Pack,
                   PackPair) {
  constexpr int lanes = kLanes<TestType>, widest = 8 * lanes / Pack::lanes, n = 1003;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> x(n), part(widest, 0.0);
  OrderedSum<TestType> sum;
  for (double& value : x) value = uniform(random);
  for (int i = 0; i < n; i += lanes)
    sum.add(select(first_lanes<TestType>(n - i),
                   load_lanes<TestType>(&x[i], std::min(lanes, n - i)), TestType(0.0)));
  for (int i = 0; i < n; ++i) part[i % widest] += x[i];
  CHECK(sum.total() == std::accumulate(part.begin(), part.end(), 0.0));
  CHECK(sum.total() != std::accumulate(x.begin(), x.end(), 0.0));  // control: the order matters
}

TEMPLATE_TEST_CASE("Lanes are loaded, counted and stored as many as there are", "[core]", double,
                   Pack, PackPair) {
  constexpr int lanes = kLanes<TestType>;
  std::vector<double> from(lanes);
  std::iota(from.begin(), from.end(), 1.0);
  for (int n = 1; n <= lanes; ++n) {
    const auto x = load_lanes<TestType>(from.data(), n);
    OrderedSum<TestType> sum;
    sum.add(select(first_lanes<TestType>(n), x, TestType(0.0)));
    CHECK(sum.total() == 0.5 * n * (n + 1));
    CHECK(max_lanes(x) == double(n));
    std::vector<double> to(lanes, -1.0);
    store_lanes(to.data(), 2.0 * x, n);
    for (int k = 0; k < lanes; ++k) CHECK(to[k] == (k < n ? 2.0 * from[k] : -1.0));
  }
}
