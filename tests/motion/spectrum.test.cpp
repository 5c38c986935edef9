#include "motion/spectrum.hpp"

#include "core/check.hpp"
#include "motion/process.hpp"
#include "signals.hpp"

#include <array>

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::harmonic;
using flowslide::test::sampled;

namespace {

double psa(const GroundMotion& motion, double period, double damping,
           PeakSearch search = PeakSearch::between) {
  return pseudo_acceleration(motion, std::array{period}, damping, search)[0];
}

}  // namespace

TEST_CASE("resonance grows to 1 / (2 zeta)", "[motion]") {
  const double a = 1.5, period = 0.5;
  // exp(-zeta omega t) is below 1e-10 at the end.
  const GroundMotion sine = harmonic(a, 1.0 / period, 0.0025, 40.0);
  CHECK(psa(sine, period, 0.05) == Approx(a / 0.1).epsilon(1e-3));
  CHECK(psa(sine, period, 0.10) == Approx(a / 0.2).epsilon(1e-3));
  CHECK(psa(sine, 2.0 * period, 0.05) < 0.4 * a / 0.1);
}

TEST_CASE("a sudden acceleration is overshot by exp(-pi zeta / sqrt(1 - zeta^2))", "[motion]") {
  const GroundMotion box = sampled(0.02, 10.0, [](double) { return 3.0; });
  const double damping = GENERATE(0.0, 0.05, 0.2);
  const double peak = 3.0 * (1.0 + std::exp(-kPi * damping / std::sqrt(1.0 - damping * damping)));
  for (const double period : {0.1, 0.37, 2.0}) {
    CAPTURE(damping, period);
    // The cubic between samples errs by (2 pi dt / T)^4 / 384 of the oscillation, 0.7 % at 0.1 s.
    CHECK(psa(box, period, damping) ==
          Approx(peak).epsilon(std::pow(2.0 * kPi * 0.02 / period, 4) / 384.0 + 1e-9));
  }
}

TEST_CASE("the peak after a short pulse counts", "[motion]") {
  // Undamped, pulse shorter than half a period: PSA = 2 a sin(pi t_d / T), reached after the pulse.
  const double pulse = 0.2, period = 1.0, dt = 0.0005;
  const GroundMotion box = sampled(dt, pulse, [](double) { return 2.0; });
  CHECK(psa(box, period, 0.0) == Approx(4.0 * std::sin(kPi * pulse / period)).epsilon(2e-3));
}

TEST_CASE("steps are exact for straight acceleration", "[motion]") {
  const GroundMotion coarse = sampled(0.02, 8.0, [](double t) {
    return std::sin(7.0 * t) * std::exp(-0.3 * t) + 0.4 * std::cos(40.0 * t);
  });
  const GroundMotion fine = resampled(coarse, 0.002, ResampleMethod::linear);
  for (const double period : {0.05, 0.3, 1.0, 8.0}) {
    CAPTURE(period);
    const double at_samples = psa(coarse, period, 0.05, PeakSearch::samples);
    const double between = psa(coarse, period, 0.05, PeakSearch::between);
    const double fine_peak = psa(fine, period, 0.05, PeakSearch::between);
    CHECK(at_samples <= between);
    // The response is the same curve, its peak read off ten times more closely; the rest is the
    // cubic's error of the coarse steps.
    CHECK(between == Approx(fine_peak).epsilon(period < 0.1 ? 0.08 : 1e-3));
  }
  // An oscillator that is as good as rigid follows the ground.
  CHECK(psa(coarse, 1e-3, 0.05, PeakSearch::samples) == Approx(1.4).epsilon(0.15));
  CHECK(psa(coarse, 0.0, 0.05) ==
        Approx(psa(coarse, 1e-5, 0.9, PeakSearch::samples)).epsilon(1e-3));
}

TEST_CASE("the step of Nigam and Jennings equals a solution by small steps", "[motion]") {
  const GroundMotion motion =
      sampled(0.02, 3.0, [](double t) { return std::sin(11.0 * t) * std::sin(3.0 * t); });
  const double period = 0.4, zeta = 0.05, omega = 2.0 * kPi / period;
  // Runge-Kutta of fourth order with 100 steps to a sample.
  double u = 0.0, v = 0.0, most = 0.0;
  for (std::size_t i = 1; i < motion.acceleration.size(); ++i) {
    const double a0 = motion.acceleration[i - 1], a1 = motion.acceleration[i];
    for (int k = 0; k < 100; ++k) {
      const double h = motion.dt / 100.0;
      const auto pull = [&](double share, double x, double y) {
        const double a = a0 + (a1 - a0) * (k + share) / 100.0;
        return -a - 2.0 * zeta * omega * y - omega * omega * x;
      };
      const double u1 = v, v1 = pull(0.0, u, v);
      const double u2 = v + 0.5 * h * v1, v2 = pull(0.5, u + 0.5 * h * u1, v + 0.5 * h * v1);
      const double u3 = v + 0.5 * h * v2, v3 = pull(0.5, u + 0.5 * h * u2, v + 0.5 * h * v2);
      const double u4 = v + h * v3, v4 = pull(1.0, u + h * u3, v + h * v3);
      u += h / 6.0 * (u1 + 2.0 * u2 + 2.0 * u3 + u4);
      v += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    }
    most = std::max(most, std::abs(u));
  }
  CHECK(spectral_displacement(motion, period, zeta, PeakSearch::samples) ==
        Approx(most).epsilon(1e-8));
}

TEST_CASE("MASI of a sudden acceleration is 1.4 s times its PSA", "[motion]") {
  const GroundMotion box = sampled(0.002, 5.0, [](double) { return 1.0; });
  const double peak = 1.0 + std::exp(-kPi * 0.05 / std::sqrt(1.0 - 0.0025));
  CHECK(masi(box, PeakSearch::between) == Approx(1.4 * peak).epsilon(1e-5));
}

TEST_CASE("periods and damping are checked", "[motion]") {
  const GroundMotion m = harmonic(1.0, 1.0, 0.01, 2.0);
  CHECK_THROWS_AS(psa(m, -1.0, 0.05), InputError);
  CHECK_THROWS_AS(psa(m, kUnset, 0.05), InputError);
  CHECK_THROWS_AS(psa(m, 1.0, 5.0), InputError);
  CHECK_THROWS_AS(psa(m, 1.0, kUnset), InputError);
}
