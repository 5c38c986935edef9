#include "core/elementary_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <catch2/catch.hpp>

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Uniform in (0, 1); the same numbers everywhere.
class Random {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
  }
  double between(double a, double b) { return a + (b - a) * (*this)(); }
  /// Either sign, any size between 2^-e and 2^e.
  double wide(int e) {
    const double size = std::ldexp(between(1.0, 2.0), static_cast<int>(between(-e, e)));
    return (*this)() < 0.5 ? -size : size;
  }

 private:
  std::uint64_t state_ = 1;
};

/// Error in units in the last place of the result.
double units(double value, long double exact) {
  const auto rounded = static_cast<double>(exact);
  const int exponent = std::max(std::ilogb(rounded), -1022);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) *
                             std::ldexp(1.0L, 52 - exponent));
}

/// Largest error over 40,000 arguments that `draw` makes.
template <class F, class Exact, class Draw>
double largest(F&& f, Exact&& exact, Draw&& draw) {
  Random random;
  double most = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const auto [x, y] = draw(random);
    const double error = units(f(x, y), exact(x, y));
    most = error > most || std::isnan(error) ? error : most;
    if (std::isnan(error)) break;
  }
  return most;
}
struct Arguments {
  double x, y = 0.0;
};

}  // namespace

// The references are those of the library in 64 bits, whose own error is a two-thousandth of a
// unit.
TEST_CASE("Exponentials and logarithms are accurate to one unit in the last place",
          "[core][bits]") {
  const auto exp = [](double x, double) { return flowslide::exp(x); };
  const auto exact_exp = [](double x, double) { return std::exp(static_cast<long double>(x)); };
  CHECK(largest(exp, exact_exp, [](Random& r) { return Arguments{r.between(-708, 709)}; }) < 1.0);
  CHECK(largest(exp, exact_exp, [](Random& r) { return Arguments{r.between(-1, 1)}; }) < 1.0);
  CHECK(largest(exp, exact_exp, [](Random& r) { return Arguments{r.wide(9)}; }) < 1.0);
  CHECK(largest(exp, exact_exp, [](Random& r) { return Arguments{r.between(-745, -708)}; }) < 1.5);

  const auto log = [](double x, double) { return flowslide::log(x); };
  const auto exact_log = [](double x, double) { return std::log(static_cast<long double>(x)); };
  CHECK(largest(log, exact_log, [](Random& r) { return Arguments{r.between(0.5, 2.0)}; }) < 1.0);
  CHECK(largest(log, exact_log, [](Random& r) { return Arguments{std::abs(r.wide(1020))}; }) < 1.0);
  CHECK(largest(log, exact_log, [](Random& r) { return Arguments{1.0 + r.wide(40) * 0x1p-41}; }) <
        1.0);
  CHECK(flowslide::log(0x1p-1074) == Approx(-1074.0 * std::log(2.0)).epsilon(1e-15));

  const auto pow = [](double x, double y) { return flowslide::pow(x, y); };
  const auto exact_pow = [](double x, double y) {
    return std::pow(static_cast<long double>(x), static_cast<long double>(y));
  };
  CHECK(largest(pow, exact_pow, [](Random& r) {
          return Arguments{std::abs(r.wide(20)), r.between(-30, 30)};
        }) < 1.0);
  CHECK(largest(pow, exact_pow, [](Random& r) {
          return Arguments{r.between(0.9, 1.1), r.between(-5000, 5000)};
        }) < 1.0);
  CHECK(largest(pow, exact_pow, [](Random& r) {
          return Arguments{r.between(0.0, 2.0), r.between(0.0, 2.0)};
        }) < 1.0);
}

TEST_CASE("Functions of angles are accurate to the units that they promise", "[core]") {
  const auto sin = [](double x, double) { return flowslide::sin(x); };
  const auto cos = [](double x, double) { return flowslide::cos(x); };
  const auto tan = [](double x, double) { return flowslide::tan(x); };
  const auto exact_sin = [](double x, double) { return std::sin(static_cast<long double>(x)); };
  const auto exact_cos = [](double x, double) { return std::cos(static_cast<long double>(x)); };
  const auto exact_tan = [](double x, double) { return std::tan(static_cast<long double>(x)); };
  const auto check = [&](auto&& draw) {
    CHECK(largest(sin, exact_sin, draw) < 1.0);
    CHECK(largest(cos, exact_cos, draw) < 1.0);
    CHECK(largest(tan, exact_tan, draw) < 2.0);
  };
  check([](Random& r) { return Arguments{r.between(-4.0, 4.0)}; });
  check([](Random& r) { return Arguments{r.wide(28)}; });
  // next to the multiples of a right angle, where the result is what the subtraction leaves
  check([](Random& r) {
    return Arguments{std::floor(r.between(-3e8, 3e8)) * (0.5 * 3.14159265358979323846)};
  });

  const auto atan2 = [](double y, double x) { return flowslide::atan2(y, x); };
  const auto exact_atan2 = [](double y, double x) {
    return std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  };
  CHECK(largest(atan2, exact_atan2, [](Random& r) {
          return Arguments{r.between(-1, 1), r.between(-1, 1)};
        }) < 2.0);
  CHECK(largest(atan2, exact_atan2, [](Random& r) {
          return Arguments{r.wide(30), r.wide(30)};
        }) < 2.0);
  CHECK(largest(atan2, exact_atan2, [](Random& r) {
          return Arguments{0x1p1000 * r.between(-1, 1), 0x1p1000 * r.between(-1, 1)};
        }) < 2.0);
  const auto asin = [](double x, double) { return flowslide::asin(x); };
  const auto exact_asin = [](double x, double) { return std::asin(static_cast<long double>(x)); };
  CHECK(largest(asin, exact_asin, [](Random& r) { return Arguments{r.between(-1, 1)}; }) < 2.0);
  CHECK(largest(asin, exact_asin, [](Random& r) { return Arguments{r.wide(20) * 0x1p-21}; }) < 2.0);
  const auto hypot = [](double x, double y) { return flowslide::hypot(x, y); };
  const auto exact_hypot = [](double x, double y) {
    return std::hypot(static_cast<long double>(x), static_cast<long double>(y));
  };
  CHECK(largest(hypot, exact_hypot, [](Random& r) {
          return Arguments{r.wide(20), r.wide(20)};
        }) < 2.0);
  CHECK(largest(hypot, exact_hypot, [](Random& r) {
          return Arguments{r.wide(500) * 0x1p520, r.wide(500) * 0x1p520};
        }) < 2.0);
}

TEST_CASE("Elementary functions end where the numbers do", "[core]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(flowslide::exp(0.0) == 1.0);
  CHECK(flowslide::exp(710.0) == kInfinity);
  CHECK(flowslide::exp(-746.0) == 0.0);
  CHECK(flowslide::exp(-kInfinity) == 0.0);
  CHECK(flowslide::log(1.0) == 0.0);
  CHECK(flowslide::log(0.0) == -kInfinity);
  CHECK(flowslide::log(kInfinity) == kInfinity);
  CHECK(flowslide::pow(0.0, 0.5) == 0.0);
  CHECK(flowslide::pow(0.0, -0.5) == kInfinity);
  CHECK(flowslide::pow(kInfinity, -1.0) == 0.0);
  CHECK(flowslide::pow(10.0, 400.0) == kInfinity);
  CHECK(flowslide::pow(10.0, -400.0) == 0.0);
  CHECK(flowslide::pow(nan, 0.0) == 1.0);
  CHECK(flowslide::pow(-3.0, 3) == -27.0);
  CHECK(flowslide::pow(2.0, -2) == 0.25);
  CHECK(flowslide::sin(0.0) == 0.0);
  CHECK(flowslide::cos(0.0) == 1.0);
  CHECK(flowslide::atan2(0.0, -1.0) == std::atan2(0.0, -1.0));
  CHECK(flowslide::atan2(-0.0, -1.0) == std::atan2(-0.0, -1.0));
  CHECK(flowslide::atan2(0.0, 0.0) == 0.0);
  CHECK(flowslide::atan2(-2.0, 0.0) == std::atan2(-2.0, 0.0));
  CHECK(flowslide::asin(-1.0) == std::asin(-1.0));
  CHECK(flowslide::hypot(0.0, 0.0) == 0.0);
  CHECK(flowslide::hypot(3e300, 4e300) == Approx(5e300).epsilon(1e-15));
  for (const double x : {nan, -1.0}) CHECK(std::isnan(flowslide::log(x)));
  CHECK(std::isnan(flowslide::exp(nan)));
  CHECK(std::isnan(flowslide::pow(-1.0, 0.5)));
  CHECK(std::isnan(flowslide::pow(2.0, nan)));
  for (const double x : {nan, kInfinity, 1e9}) {
    CHECK(std::isnan(flowslide::sin(x)));
    CHECK(std::isnan(flowslide::cos(x)));
    CHECK(std::isnan(flowslide::tan(x)));
  }
  CHECK(std::isnan(flowslide::asin(1.1)));
  CHECK(std::isnan(flowslide::atan2(nan, 1.0)));
}

TEMPLATE_TEST_CASE_SIG("A lane has the bits of a double", "[core][bits]", ((int N), N), 2,
                       std::min(4, flowslide::kPackLanes), flowslide::kPackLanes) {
  const auto same = [](double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
  };
  const double special[] = {0.0,    -0.0,  kInfinity, -kInfinity, std::nan(""), 1.0,    -1.0,
                            1e-310, 708.5, 709.9,     -708.5,     -740.0,       -800.0, 1e300};
  Random random;
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    flowslide::PackOf<N> x;
    for (int k = 0; k < N; ++k)
      x.v[k] = i % 5 == 0 ? special[static_cast<std::size_t>(14.0 * random())]
                          : random.wide(i % 5 == 1 ? 1000 : 8);
    const auto e = exp(x), l = log(x);
    for (int k = 0; k < N; ++k)
      different += !same(e[k], flowslide::exp(x[k])) || !same(l[k], flowslide::log(x[k]));
  }
  CHECK(different == 0);
}
