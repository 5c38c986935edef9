#include "core/hash.hpp"
#include "study/numbers/design.hpp"
#include "study/numbers/distribution.hpp"
#include "study/numbers/normal.hpp"
#include "study/numbers/random.hpp"
#include "study/numbers/sobol.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::study;

TEST_CASE("Random numbers are those of the published generator", "[study]") {
  Random random(1234567);
  CHECK(random.next() == 6457827717110365317u);
  CHECK(random.next() == 3203168211198807973u);
  CHECK(random.next() == 9817491932198370423u);
  Random a(5, 0), b(5, 1), again(5, 1);
  const std::uint64_t first = b.next();
  CHECK(a.next() != first);
  CHECK(again.next() == first);
}

TEST_CASE("Each number below n is as likely, each permutation holds all", "[study]") {
  Random random(3);
  std::vector<double> count(5, 0.0);
  for (int i = 0; i < 50000; ++i) count[random.below(5)] += 1.0;
  // Five deviations of a binomial count of mean 10000.
  for (const double c : count) CHECK(std::abs(c - 10000.0) < 5.0 * std::sqrt(10000.0 * 0.8));
  const std::vector<std::size_t> order = random.permutation(100);
  CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == 100);
  CHECK_FALSE(std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("The normal distribution has its known values", "[study]") {
  CHECK(normal_quantile(0.5) == 0.0);
  CHECK(normal_quantile(0.025) == Approx(-1.9599639845400545).epsilon(1e-15));
  CHECK(normal_quantile(0.9) == Approx(1.2815515655446004).epsilon(1e-15));
  CHECK(normal_quantile(1e-10) == Approx(-6.361340902404056).epsilon(1e-14));
  CHECK(normal_probability(0.0) == Approx(0.5).epsilon(1e-15));
  CHECK(normal_probability(-1.96) == Approx(0.024997895148220435).epsilon(1e-13));
  CHECK(normal_probability(3.0) == Approx(0.9986501019683699).epsilon(1e-15));
  CHECK(normal_probability(-8.0) == Approx(6.220960574271819e-16).margin(1e-15));
  for (double p = 1e-6; p < 1.0; p += 0.00137)
    CHECK(std::abs(normal_probability(normal_quantile(p)) - p) < 1e-14);
}

TEST_CASE("Sobol points are the published ones and fill every interval once", "[study]") {
  const auto unit = [](std::uint32_t v) { return static_cast<double>(v) * 0x1p-32; };
  // The first points of the sequence in three dimensions, as in the file of Joe and Kuo's program.
  const std::vector<std::vector<double>> known{
      {0, 0, 0},          {0.5, 0.5, 0.5},       {0.75, 0.25, 0.25},
      {0.25, 0.75, 0.75}, {0.375, 0.375, 0.625}, {0.875, 0.875, 0.125}};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto point = sobol_point(i, 3);
    for (std::size_t d = 0; d < 3; ++d) CHECK(unit(point[d]) == known[i][d]);
  }
  for (std::size_t d = 0; d < kSobolInputs; ++d) {
    std::set<std::uint32_t> cells;
    for (std::size_t i = 0; i < 64; ++i) cells.insert(sobol_point(i, kSobolInputs)[d] >> 26u);
    CHECK(cells.size() == 64);
  }
  CHECK_THROWS_AS(sobol_point(1, kSobolInputs + 1), InputError);
}

TEST_CASE("Samples have the moments of their distributions", "[study]") {
  const auto points = sample_points(Sampling::latin_hypercube, 4000, 1, 1, {});
  const auto values = [&](const Distribution& d) {
    std::vector<double> v;
    for (const auto& p : points) v.push_back(quantile(d, p[0]));
    return v;
  };
  // A stratified sample of 4000 gives mean and deviation to some 1e-3 of the deviation.
  const auto uniform = values({.shape = Shape::uniform, .from = 2.0, .to = 8.0});
  CHECK(mean(uniform) == Approx(5.0).epsilon(1e-3));
  CHECK(deviation(uniform) == Approx(6.0 / std::sqrt(12.0)).epsilon(1e-3));
  const auto triangle = values({.shape = Shape::triangular, .from = 0.0, .mode = 1.0, .to = 4.0});
  CHECK(mean(triangle) == Approx(5.0 / 3.0).epsilon(1e-3));
  CHECK(deviation(triangle) == Approx(std::sqrt((16.0 + 1.0 - 4.0) / 18.0)).epsilon(2e-3));
  const auto normal = values({.shape = Shape::normal, .mean = 25.0, .deviation = 5.0});
  CHECK(mean(normal) == Approx(25.0).epsilon(1e-3));
  CHECK(deviation(normal) == Approx(5.0).epsilon(5e-3));
  const auto lognormal = values({.shape = Shape::lognormal, .mean = 10.0, .deviation = 4.0});
  CHECK(mean(lognormal) == Approx(10.0).epsilon(5e-3));
  CHECK(deviation(lognormal) == Approx(4.0).epsilon(2e-2));
  const auto cut =
      values({.shape = Shape::normal, .mean = 0.0, .deviation = 1.0, .min = 0.0, .max = 1.0});
  CHECK(*std::min_element(cut.begin(), cut.end()) >= 0.0);
  CHECK(*std::max_element(cut.begin(), cut.end()) <= 1.0);
  // (phi(0) - phi(1)) / (Phi(1) - Phi(0))
  CHECK(mean(cut) == Approx((0.3989422804 - 0.2419707245) / 0.3413447461).epsilon(1e-3));
}

TEST_CASE("A hypercube has one point in every stratum, correlated or not", "[study]") {
  const std::size_t n = 50;
  for (const bool with : {false, true}) {
    std::vector<Correlated> pairs;
    if (with) pairs.push_back({0, 1, -0.8});
    const auto points = sample_points(Sampling::latin_hypercube, n, 3, 7, pairs);
    for (std::size_t d = 0; d < 3; ++d) {
      std::set<int> strata;
      for (const auto& p : points) strata.insert(static_cast<int>(p[d] * static_cast<double>(n)));
      CHECK(strata.size() == n);
    }
  }
}

TEST_CASE("Correlated inputs are, and the others are not", "[study]") {
  for (const Sampling method : {Sampling::latin_hypercube, Sampling::sobol, Sampling::random}) {
    const auto points = sample_points(method, 1024, 3, 11, {{0, 1, 0.7}});
    std::vector<std::vector<double>> z(3);
    for (const auto& p : points)
      for (std::size_t d = 0; d < 3; ++d) z[d].push_back(normal_quantile(p[d]));
    // (1 - r^2) / sqrt(n) is 0.016, three of them.
    CHECK(correlation(z[0], z[1]) == Approx(0.7).margin(0.05));
    CHECK(std::abs(correlation(z[0], z[2])) < 0.1);
  }
  CHECK_THROWS_AS(
      sample_points(Sampling::random, 4, 3, 1, {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}}),
      InputError);
}

TEST_CASE("Samples are the same bits everywhere", "[study][bits]") {
  // What a first build has drawn: sameness over machines, no more; the tests above say what it is.
  const auto digest = [](Sampling method) {
    const Distribution d{.shape = Shape::lognormal, .mean = 25.0, .deviation = 5.0};
    std::string text;
    for (const auto& p : sample_points(method, 64, 2, 3, {{0, 1, 0.5}}))
      for (const double u : p) text += fmt::format("{} {}\n", u, quantile(d, u));
    return sha256(text).substr(0, 16);
  };
  CHECK(digest(Sampling::latin_hypercube) == "91d8024173473989");
  CHECK(digest(Sampling::sobol) == "1902b8338b7e43d2");
  CHECK(digest(Sampling::random) == "251733e8e5c85831");
}

TEST_CASE("Distributions that are none are refused", "[study]") {
  CHECK_THROWS_AS(check({.shape = Shape::uniform, .from = 2.0, .to = 2.0}), InputError);
  CHECK_THROWS_AS(check({.shape = Shape::triangular, .from = 0.0, .mode = 3.0, .to = 2.0}),
                  InputError);
  CHECK_THROWS_AS(check({.shape = Shape::normal, .mean = 1.0, .deviation = 0.0}), InputError);
  CHECK_THROWS_AS(check({.shape = Shape::normal, .mean = 1.0}), InputError);
  CHECK_THROWS_AS(check({.shape = Shape::lognormal, .mean = -1.0, .deviation = 1.0}), InputError);
  CHECK_THROWS_AS(check({.shape = Shape::normal, .mean = 0.0, .deviation = 1.0, .min = 30.0}),
                  InputError);
}

TEST_CASE("Distributions whose numbers overflow, or have no spread, are refused", "[study]") {
  const auto refusal = [](const Distribution& d) {
    try {
      check(d);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  using Catch::Contains;
  const auto of = [](Shape shape, double mean, double deviation) {
    return Distribution{.shape = shape, .mean = mean, .deviation = deviation};
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // The variance of the logarithm is log(1 + (deviation/mean)^2).
  CHECK_THAT(refusal(of(Shape::lognormal, 1.0, 1e200)), Contains("no finite deviation"));
  CHECK_THAT(refusal(of(Shape::lognormal, 1.0, 1e-9)), Contains("one number"));
  CHECK_THAT(refusal(of(Shape::lognormal, 1e308, 1e308)), Contains("larger ones than"));
  CHECK_THAT(refusal(of(Shape::normal, 0.0, 1e308)), Contains("larger ones than"));
  CHECK_THAT(refusal(of(Shape::normal, 1e6, 1e-12)), Contains("spread"));
  CHECK_FALSE(refusal(of(Shape::normal, 0.0, kInfinity)).empty());
  CHECK_THAT(refusal({.shape = Shape::uniform, .from = -1e308, .to = 1e308}),
             Contains("larger ones than"));
  for (const std::string& text :
       {refusal(of(Shape::lognormal, 1.0, 1e200)), refusal(of(Shape::normal, 0.0, kInfinity))})
    CHECK_THAT(text, !Contains("nan"));
  CHECK(refusal(of(Shape::lognormal, 1.0, 1e-6)).empty());  // controls
  CHECK(refusal(of(Shape::lognormal, 5.0, 50.0)).empty());
  CHECK(refusal(of(Shape::normal, 0.0, 1e300)).empty());
}
