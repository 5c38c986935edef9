#include "study/numbers/normal.hpp"
#include "study/numbers/random.hpp"
#include "study/statistics/effects.hpp"
#include "study/statistics/least_squares.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/repeats.hpp"
#include "study/statistics/summary.hpp"
#include "study/statistics/threshold.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::study;

TEST_CASE("Equal values share a rank", "[study]") {
  CHECK(ranks({3.0, 1.0, 2.0}) == std::vector<double>{3.0, 1.0, 2.0});
  CHECK(ranks({5.0, 1.0, 5.0, 5.0}) == std::vector<double>{3.0, 1.0, 3.0, 3.0});
}

TEST_CASE("Rank correlation has the value of the textbook", "[study]") {
  // IQ and hours of television a week, the example of the article "Spearman's rank correlation
  // coefficient" of Wikipedia: -29/165.
  const std::vector<double> iq{106, 100, 86, 101, 99, 103, 97, 113, 112, 110};
  const std::vector<double> hours{7, 27, 2, 50, 28, 29, 20, 12, 6, 17};
  const Estimate e = spearman(iq, hours, 1);
  CHECK(e.value == Approx(-29.0 / 165.0).epsilon(1e-12));
  CHECK(e.rows == 10);
  CHECK(e.low < e.value);
  CHECK(e.high > e.value);
  // Ten rows say next to nothing.
  CHECK(e.low < 0.0);
  CHECK(e.high > 0.0);
}

TEST_CASE("A monotone relation has rank correlation 1, rows with gaps do not count", "[study]") {
  const std::vector<double> x{1, 2, 3, 4, 5, kUnset}, y{1, 8, 27, 64, 125, 0};
  CHECK(spearman(x, y, 1).value == Approx(1.0));
  CHECK(spearman(x, y, 1).rows == 5);
  CHECK_FALSE(is_set(spearman({1, 2, 3}, {1, 2, 3}, 1).value));
  CHECK_FALSE(is_set(spearman({1, 1, 1, 1}, {1, 2, 3, 4}, 1).value));
}

TEST_CASE("The interval of a mean is that of theory, and holds it as often as it says", "[study]") {
  int holds = 0;
  constexpr int kStudies = 200, kRows = 40;
  double width = 0.0;
  for (int s = 0; s < kStudies; ++s) {
    Random random(static_cast<std::uint64_t>(s) + 100);
    std::vector<double> v;
    for (int i = 0; i < kRows; ++i) v.push_back(2.0 + normal_quantile(random.uniform()));
    const Estimate e = bootstrap(kRows, 1, [&](const std::vector<std::size_t>& rows) {
      double sum = 0.0;
      for (const std::size_t row : rows) sum += v[row];
      return sum / kRows;
    });
    holds += e.low <= 2.0 && 2.0 <= e.high;
    width += (e.high - e.low) / kStudies;
  }
  // 2 * 1.96 / sqrt(40), 2 to 3 % shorter by the percentile method; 95 % of 200 is 190 +- 3.1.
  CHECK(width == Approx(2.0 * 1.96 / std::sqrt(40.0)).epsilon(0.05));
  CHECK(holds > 190 - 13);
  CHECK(holds < 200);
}

TEST_CASE("Rows that come and go together are one observation", "[study]") {
  // ten values, each in four rows: the interval of their mean is that of ten rows
  std::vector<double> v, once;
  Resampling shared = 1, apart = 1, once_only = 1;
  Random random(7);
  for (std::size_t i = 0; i < 10; ++i) {
    once.push_back(normal_quantile(random.uniform()));
    for (int k = 0; k < 4; ++k) {
      v.push_back(once.back());
      shared.units.push_back(i);
    }
  }
  const auto width = [](const std::vector<double>& values, const Resampling& how) {
    const Estimate e = bootstrap(values.size(), how, [&](const std::vector<std::size_t>& rows) {
      double sum = 0.0;
      for (const std::size_t row : rows) sum += values[row];
      return sum / static_cast<double>(rows.size());
    });
    return e.high - e.low;
  };
  CHECK(width(v, shared) == Approx(width(once, once_only)));
  CHECK(width(v, apart) < 0.6 * width(once, once_only));  // the control: half as wide
  // each stratum keeps its rows: two constants have one mean
  Resampling strata = 1;
  strata.strata = {0, 0, 1, 1};
  CHECK(width({1.0, 1.0, 5.0, 5.0}, strata) == 0.0);
  CHECK(width({1.0, 1.0, 5.0, 5.0}, 1) > 1.0);
}

TEST_CASE("What levels have in common is not diluted by mixing them", "[study]") {
  std::vector<std::string> level;
  std::vector<double> x, y;
  for (const int factor : {1, 3, 9})
    for (int i = 1; i <= 8; ++i) {
      level.push_back(std::to_string(factor));
      x.push_back(i);
      y.push_back(factor * (i + 1));
    }
  CHECK(spearman_within(level, x, y, 1).value == Approx(1.0));
  CHECK(spearman_within(level, x, y, 1).rows == 24);
  CHECK(spearman(x, y, 1).value < 0.75);  // the control
  // three rows of a level tell nothing, and do not count
  level.insert(level.end(), {"few", "few", "few"});
  x.insert(x.end(), {1, 2, 3});
  y.insert(y.end(), {3, 2, 1});
  CHECK(spearman_within(level, x, y, 1).value == Approx(1.0));
  CHECK(spearman_within(level, x, y, 1).rows == 24);
}

TEST_CASE("Equal seeds give equal intervals", "[study]") {
  const std::vector<double> x{1, 4, 2, 8, 5, 7}, y{2, 3, 1, 9, 4, 9};
  CHECK(spearman(x, y, 4).low == spearman(x, y, 4).low);
  CHECK(fit_line(x, y, 4).slope.low != fit_line(x, y, 5).slope.low);
}

TEST_CASE("Least squares are exact on what they can express", "[study]") {
  const std::vector<double> one(5, 1.0), a{1, 2, 3, 4, 7}, b{2, 0, 1, 5, 3};
  std::vector<double> y;
  for (std::size_t i = 0; i < 5; ++i) y.push_back(3.0 - 2.0 * a[i] + 0.5 * b[i]);
  const auto c = least_squares({one, a, b}, y);
  REQUIRE(c.size() == 3);
  CHECK(c[0] == Approx(3.0));
  CHECK(c[1] == Approx(-2.0));
  CHECK(c[2] == Approx(0.5));
  CHECK(least_squares({one, a, a}, y).empty());
}

TEST_CASE("A line has the coefficients of the textbook", "[study]") {
  // Anscombe (1973), first set: 3.000 + 0.5001 x, R^2 0.6665.
  const std::vector<double> x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const Line line = fit_line(x, y, 1);
  CHECK(line.intercept.value == Approx(3.0001).epsilon(1e-4));
  CHECK(line.slope.value == Approx(0.5001).epsilon(1e-4));
  CHECK(line.r2 == Approx(0.66654).epsilon(1e-4));
  CHECK(line.slope.low > 0.0);
}

TEST_CASE("Quantiles and exceedance", "[study]") {
  CHECK(quantile_of({4.0, 1.0, 3.0, 2.0}, 0.5) == Approx(2.5));
  CHECK(quantile_of({4.0, 1.0, 3.0, 2.0}, 1.0) == 4.0);
  const Exceedance e = exceedance({{30.0}, {10.0}, {20.0}});
  CHECK(e.value == std::vector<double>{10.0, 20.0, 30.0});
  CHECK(e.share[0] == Approx(0.75));
  CHECK(e.share[2] == Approx(0.25));
  // sqrt(ln 40 / 6), Massart (1990)
  CHECK(e.band == Approx(std::sqrt(std::log(40.0) / 6.0)));
  for (const double share : {0.0, 0.05, 0.3, 0.5, 0.95, 1.0})
    CHECK(weighted_quantile(e, share) == Approx(quantile_of({30.0, 10.0, 20.0}, share)));
  // Two repeats of one row and another row: as many rows as weights.
  const Exceedance repeated = exceedance({{30.0, 0.5}, {10.0, 1.0}, {20.0, 0.5}});
  CHECK(repeated.share == std::vector<double>{1.0 - 1.0 / 3.0, 1.0 - 1.5 / 3.0, 1.0 - 2.0 / 3.0});
  CHECK(repeated.band == Approx(std::sqrt(std::log(40.0) / 4.0)));
  CHECK(is_set(weighted_quantile(repeated, 0.5)));
  CHECK_FALSE(is_set(weighted_quantile(exceedance({}), 0.5)));
}

TEST_CASE("Scatter of repeats is pooled over groups", "[study]") {
  const Repeats repeats = group_rows({0, 0, 1, 1, 1, 2});
  REQUIRE(repeats.groups.size() == 3);
  const Scatter s = scatter(repeats, {1.0, 3.0, 10.0, 11.0, 12.0, 20.0});
  CHECK(s.mean[0] == 2.0);
  CHECK(s.mean[1] == 11.0);
  CHECK(s.repeated == 2);
  // (1 * 2 + 2 * 1) / 3
  CHECK(s.numerical == Approx(std::sqrt(4.0 / 3.0)));
  CHECK(s.of_inputs == Approx(9.0));
  CHECK_FALSE(is_set(s.deviation[2]));
  CHECK_FALSE(is_set(scatter(group_rows({0, 1}), {1.0, 2.0}).numerical));
}

TEST_CASE("Repeats that differ by rounding alone have no scatter", "[study]") {
  const Scatter s = scatter(group_rows({0, 0, 0}), {12.5, 12.500000000000004, 12.5});
  CHECK(s.numerical == 0.0);
  CHECK(scatter(group_rows({0, 0}), {12.5, 12.501}).numerical > 0.0);
}

TEST_CASE("An effect is the difference between the ends of an input", "[study]") {
  std::vector<double> x, y;
  std::vector<std::string> word;
  for (int i = 0; i < 30; ++i) {
    x.push_back(i);
    y.push_back(2.0 * i);
    word.emplace_back(i % 3 == 0 ? "a" : i % 3 == 1 ? "b" : "c");
  }
  // Thirds 0..9 and 20..29 have the means 4.5 and 24.5.
  const Effect e = effect_of_number(x, y, 1);
  CHECK(e.swing.value == Approx(40.0));
  CHECK(e.swing.low < 40.0);
  CHECK(e.swing.high > 40.0);
  const Effect levels = effect_of_number({1, 1, 3, 3}, {5, 7, 1, 3}, 1);
  CHECK(levels.swing.value == Approx(-4.0));
  CHECK(levels.low_label == "1");
  const Effect words = effect_of_choice(word, y, 1);
  CHECK(words.low_label == "a");
  CHECK(words.high_label == "c");
  CHECK(words.swing.value == Approx(4.0));
  CHECK_FALSE(is_set(effect_of_number({1, 1}, {1, 2}, 1).swing.value));
}

TEST_CASE("A ratio of means with its interval", "[study]") {
  const Estimate r = ratio_of_means({8, 12, 10, 10}, 1, {5, 5, 4, 6}, 1);
  CHECK(r.value == Approx(2.0));
  CHECK(r.low > 1.5);
  CHECK(r.high < 2.6);
}

TEST_CASE("An input without effect has two ends and the effect zero", "[study]") {
  const Effect none = effect_of_choice({"a", "b", "a", "b"}, {1.0, 1.0, 1.0, 1.0}, 1);
  CHECK(none.low_label == "a");
  CHECK(none.high_label == "b");
  CHECK(none.swing.value == 0.0);
  // Nearly all rows have one value: the ends are the smallest and the largest.
  const Effect few = effect_of_number({1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 3, 4},
                                      {0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 6, 7}, 1);
  CHECK(few.swing.value == 7.0);
}

TEST_CASE("Statistics stop when they are told to", "[study]") {
  std::atomic<bool> stop = false;
  const std::vector<double> x{1, 2, 3, 4, 5, 6, 7, 8, 9}, y{0, 0, 0, 1, 2, 3, 4, 4, 4};
  const Estimate as_ever = spearman(x, y, {1, &stop});
  CHECK(as_ever.low == spearman(x, y, 1).low);
  stop = true;
  CHECK_THROWS_AS(spearman(x, y, {1, &stop}), Interrupted);
  CHECK_THROWS_AS(fit_ramp(x, y, {1, &stop}), Interrupted);
  CHECK_THROWS_AS(fit_line(x, y, {1, &stop}), Interrupted);
  CHECK_THROWS_AS(effect_of_number(x, y, {1, &stop}), Interrupted);
}
