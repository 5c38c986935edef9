#include "study/numbers/normal.hpp"
#include "study/numbers/random.hpp"
#include "study/statistics/threshold.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::study;

namespace {

/// Rows of a ramp from 10 to 18 with the plateau 220 and noise, over x from 3 to 30.
void rows_of_ramp(std::vector<double>& x, std::vector<double>& y, double noise) {
  Random random(17);
  for (int i = 0; i < 60; ++i) {
    x.push_back(3.0 + 27.0 * random.uniform());
    y.push_back(220.0 * std::clamp((x.back() - 10.0) / 8.0, 0.0, 1.0) +
                noise * normal_quantile(random.uniform()));
  }
}

}  // namespace

TEST_CASE("A ramp is found where there is one", "[study]") {
  std::vector<double> x, y;
  rows_of_ramp(x, y, 10.0);
  const Ramp r = fit_ramp(x, y, 1);
  // Places are 27 / 50 = 0.54 apart.
  CHECK(r.breach.value == Approx(10.0).margin(1.0));
  CHECK(r.saturation.value == Approx(18.0).margin(1.0));
  CHECK(r.plateau.value == Approx(220.0).margin(5.0));
  CHECK(r.breach.low <= 10.0);
  CHECK(r.breach.high >= 10.0);
  CHECK(r.saturation.low <= 18.0);
  CHECK(r.saturation.high >= 18.0);
  CHECK(r.no_breach < kMostWithout);
  CHECK(r.no_saturation < kMostWithout);
  CHECK(r.r2 > r.line_r2 + 0.05);
}

TEST_CASE("A straight line from zero has neither breach nor plateau", "[study]") {
  Random random(5);
  std::vector<double> x, y;
  for (int i = 0; i < 60; ++i) {
    x.push_back(30.0 * random.uniform());
    y.push_back(7.0 * x.back() + 5.0 * normal_quantile(random.uniform()));
  }
  const Ramp r = fit_ramp(x, y, 1);
  CHECK(r.no_breach > kMostWithout);
  CHECK(r.no_saturation > kMostWithout);
}

TEST_CASE("What does not hang on x has no thresholds", "[study]") {
  Random random(6);
  std::vector<double> x, y;
  for (int i = 0; i < 40; ++i) {
    x.push_back(30.0 * random.uniform());
    y.push_back(150.0 + 10.0 * normal_quantile(random.uniform()));
  }
  CHECK(fit_ramp(x, y, 1).no_breach > 0.5);
  CHECK_FALSE(is_set(fit_ramp({1, 2, 3}, {1, 2, 3}, 1).breach.value));
  CHECK_FALSE(is_set(fit_ramp(std::vector<double>(10, 1.0), std::vector<double>(10, 2.0), 1)
                         .breach.value));
}
