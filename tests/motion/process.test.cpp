#include "motion/process.hpp"

#include "core/check.hpp"
#include "motion/butterworth.hpp"
#include "motion/measures.hpp"
#include "signals.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::harmonic;
using flowslide::test::sampled;

namespace {

/// Largest |x| in the middle half, away from the ends.
double middle_peak(const GroundMotion& m) {
  const auto n = static_cast<std::ptrdiff_t>(m.acceleration.size());
  double most = 0.0;
  for (std::ptrdiff_t i = n / 4; i < 3 * n / 4; ++i)
    most = std::max(most, std::abs(m.acceleration[static_cast<std::size_t>(i)]));
  return most;
}

double gain(double frequency, const BandPass& band) {
  return middle_peak(filtered(harmonic(1.0, frequency, 0.001, 40.0), band));
}

}  // namespace

TEST_CASE("scaling reaches the peak to the last bit", "[motion]") {
  const GroundMotion motion =
      sampled(0.01, 10.0, [](double t) { return std::sin(5.0 * t) / (1.0 + t); });
  for (const double target : {0.3 * kGravity, 1.0 / 3.0, 7.7e-3}) {
    const GroundMotion scaled = scaled_to_pga(motion, target);
    CHECK(pga(scaled) == target);
    CHECK(scaled.acceleration[100] / motion.acceleration[100] ==
          Approx(target / pga(motion)).epsilon(1e-12));
  }
  // Signs stay.
  const GroundMotion down{.dt = 0.1, .acceleration = {0.0, -2.0, 1.0}, .origin = "m"};
  CHECK(scaled_to_pga(down, 1.0).acceleration == std::vector<double>{0.0, -1.0, 0.5});
  CHECK_THROWS_AS(scaled_to_pga(motion, 0.0), InputError);
  CHECK_THROWS_AS(scaled_to_pga(motion, kUnset), InputError);
}

TEST_CASE("a polynomial baseline is removed to rounding", "[motion]") {
  const auto fit = GENERATE(BaselineFit::acceleration, BaselineFit::velocity);
  const int degree = GENERATE(0, 1, 4);
  CAPTURE(fit, degree);
  const GroundMotion drift = sampled(0.01, 20.0, [=](double t) {
    return degree == 0 ? 0.7 : 0.7 - 0.2 * t + (degree == 1 ? 0.0 : 1e-4 * std::pow(t, degree));
  });
  // The trapezoid of the velocity is exact up to degree 1, and errs by dt^2 / 12 a'' T beyond.
  const double trapezoid = degree < 2 ? 0.0 : 0.01 * 0.01 / 12.0 * 1e-4 * 12.0 * 400.0;
  CHECK(pga(baseline_corrected(drift, degree, fit)) <=
        1e-11 * pga(drift) + (fit == BaselineFit::velocity ? trapezoid : 0.0));
  CHECK_THROWS_WITH(baseline_corrected(drift, 9, fit), Contains("between 0 and 8"));
}

TEST_CASE("a baseline correction takes the drift and leaves the shaking", "[motion]") {
  const auto shaking = [](double t) { return std::sin(2.0 * kPi * t) * std::exp(-0.2 * t); };
  const GroundMotion clean = sampled(0.01, 30.0, shaking);
  const GroundMotion drifting =
      sampled(0.01, 30.0, [&](double t) { return shaking(t) + 0.02 + 0.001 * t; });
  REQUIRE(std::abs(velocity(drifting).back()) > 1.0);
  const GroundMotion corrected = baseline_corrected(drifting, 1, BaselineFit::velocity);
  // The fit takes its share of the shaking, too.
  CHECK(std::abs(velocity(corrected).back()) < 0.1);
  CHECK(pga(corrected) == Approx(pga(clean)).epsilon(0.05));
}

TEST_CASE("Butterworth gains are those of its formula", "[motion]") {
  const int order = GENERATE(2, 3, 4);
  CAPTURE(order);
  const double corner = 2.0;
  for (const double ratio : {0.5, 1.0, 2.0}) {
    const double f = ratio * corner;
    const double low = 1.0 / std::sqrt(1.0 + std::pow(ratio, 2 * order));
    const double high = 1.0 / std::sqrt(1.0 + std::pow(ratio, -2 * order));
    CAPTURE(ratio);
    // The bilinear transform shifts 4 Hz by (pi f dt)^2 / 3 = 5e-5; sampling the peak, 1e-4.
    CHECK(gain(f, {.low_pass = corner, .order = order, .phase = FilterPhase::causal}) ==
          Approx(low).epsilon(1e-3));
    CHECK(gain(f, {.low_pass = corner, .order = order}) == Approx(low * low).epsilon(1e-3));
    CHECK(gain(f, {.high_pass = corner, .order = order, .phase = FilterPhase::causal}) ==
          Approx(high).epsilon(1e-3));
    CHECK(gain(f, {.high_pass = corner, .order = order}) == Approx(high * high).epsilon(1e-3));
  }
  const BandPass band{.high_pass = 0.2, .low_pass = 20.0, .order = order};
  CHECK(gain(2.0, band) == Approx(1.0).epsilon(1e-3));
  CHECK(gain(100.0, band) < 1e-2);
}

TEST_CASE("zero phase keeps a symmetric pulse symmetric, causal begins with its cause",
          "[motion]") {
  const GroundMotion pulse =
      sampled(0.01, 20.0, [](double t) { return std::exp(-20.0 * (t - 10.0) * (t - 10.0)); });
  const BandPass zero{.high_pass = 0.3, .low_pass = 5.0};
  const std::vector<double> y = filtered(pulse, zero).acceleration;
  const double peak = pga(filtered(pulse, zero));
  for (std::size_t i = 0; i < y.size(); i += 50)
    CHECK(y[i] == Approx(y[y.size() - 1 - i]).margin(1e-3 * peak));
  CHECK(std::abs(y[600]) > 1e-3 * peak);  // 4 s before the pulse

  BandPass causal = zero;
  causal.phase = FilterPhase::causal;
  CHECK(std::abs(filtered(pulse, causal).acceleration[600]) < 1e-9 * peak);
}

TEST_CASE("kept padding lets velocity come to rest", "[motion]") {
  const GroundMotion step = sampled(0.01, 5.0, [](double t) { return std::sin(t); });
  REQUIRE(std::abs(velocity(step).back()) > 0.5);
  const GroundMotion kept = filtered(step, {.high_pass = 0.2, .keep_padding = true});
  const GroundMotion trimmed = filtered(step, {.high_pass = 0.2});
  CHECK(kept.acceleration.size() == step.acceleration.size() + 2 * 3000);  // 1.5 * 4 / 0.2 Hz
  CHECK(trimmed.acceleration.size() == step.acceleration.size());
  CHECK(kept.acceleration[3000] == trimmed.acceleration[0]);
  CHECK(std::abs(velocity(kept).back()) < 1e-6);
  CHECK(std::abs(velocity(trimmed).back()) > 1e-3);
}

TEST_CASE("filters that are no band are refused", "[motion]") {
  const GroundMotion m = harmonic(1.0, 1.0, 0.01, 10.0);
  CHECK_THROWS_WITH(filtered(m, {}), Contains("without corners"));
  CHECK_THROWS_WITH(filtered(m, {.low_pass = 50.0}), Contains("Nyquist frequency of 50"));
  CHECK_THROWS_WITH(filtered(m, {.high_pass = kUnset}), Contains("nan Hz"));
  CHECK_THROWS_WITH(filtered(m, {.high_pass = 0.0}), Contains("0 Hz"));
  CHECK_THROWS_WITH(filtered(m, {.high_pass = 5.0, .low_pass = 1.0}), Contains("swap"));
  CHECK_THROWS_WITH(filtered(m, {.high_pass = 1.0, .order = 0}), Contains("order 0"));
  CHECK_THROWS_WITH(filtered(m, {.high_pass = 1e-4}), Contains("padding"));
}

TEST_CASE("resampling keeps what both steps can hold", "[motion]") {
  const auto wave = [](double t) {
    return std::exp(-0.5 * (t - 10.0) * (t - 10.0)) * std::sin(2.0 * kPi * 3.0 * t);
  };
  const GroundMotion motion = sampled(0.02, 20.0, wave);
  const double dt = GENERATE(0.005, 0.013, 0.02, 0.05);
  CAPTURE(dt);
  const GroundMotion out = resampled(motion, dt, ResampleMethod::band_limited);
  CHECK(out.dt == dt);
  CHECK(out.acceleration.size() == static_cast<std::size_t>(20.0 / dt * (1.0 + 1e-12)) + 1);
  double worst = 0.0;
  for (std::size_t i = 0; i < out.acceleration.size(); ++i)
    worst = std::max(worst, std::abs(out.acceleration[i] - wave(static_cast<double>(i) * dt)));
  CHECK(worst < 1e-4);  // side lobes of the Kaiser window
  // Straight lines do worse by h^2 / 8 omega^2 = 1.8 %.
  const GroundMotion straight = resampled(motion, 0.01, ResampleMethod::linear);
  CHECK(std::abs(straight.acceleration[1001] - wave(10.01)) < 0.018);
}

TEST_CASE("a longer step does not fold high frequencies down", "[motion]") {
  const GroundMotion motion = harmonic(1.0, 20.0, 0.005, 8.0);  // above the new 12.5 Hz
  CHECK(middle_peak(resampled(motion, 0.04, ResampleMethod::band_limited)) < 1e-3);
  CHECK(middle_peak(resampled(motion, 0.04, ResampleMethod::linear)) > 0.5);
}

TEST_CASE("straight resampling passes through the samples", "[motion]") {
  const GroundMotion motion{.dt = 0.1, .acceleration = {0.0, 1.0, -1.0, 2.0}, .origin = "m"};
  const GroundMotion fine = resampled(motion, 0.05, ResampleMethod::linear);
  const std::vector<double> expected{0.0, 0.5, 1.0, 0.0, -1.0, 0.5, 2.0};
  REQUIRE(fine.acceleration.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(fine.acceleration[i] == Approx(expected[i]).margin(1e-12));
  CHECK_THROWS_AS(resampled(motion, 0.0, ResampleMethod::linear), InputError);
  CHECK_THROWS_AS(resampled(motion, 1.0, ResampleMethod::linear), InputError);
  CHECK_THROWS_WITH(resampled(motion, 1e-12, ResampleMethod::linear), Contains("samples"));
}
