#include "motion/measures.hpp"

#include "core/check.hpp"
#include "motion/process.hpp"
#include "signals.hpp"

#include <complex>
#include <limits>

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::harmonic;
using flowslide::test::sampled;

TEST_CASE("measures of a constant acceleration", "[motion]") {
  const double a = 2.0, end = 10.0;
  const GroundMotion box = sampled(0.01, end, [=](double) { return -a; });
  CHECK(pga(box) == a);
  CHECK(pgv(box) == Approx(a * end).epsilon(1e-12));
  CHECK(arias_intensity(box) == Approx(kPi / (2.0 * kGravity) * a * a * end).epsilon(1e-12));
  CHECK(significant_duration(box) == Approx(0.9 * end).epsilon(1e-12));
  CHECK(significant_duration(box, 0.25, 0.75) == Approx(0.5 * end).epsilon(1e-12));
  CHECK(arias_time(box, 0.3) == Approx(0.3 * end).epsilon(1e-12));
  CHECK(arias_time(box, 0.0) == 0.0);
  CHECK(arias_time(box, 1.0) == Approx(end));
  CHECK(cumulative_absolute_velocity(box) == Approx(a * end).epsilon(1e-12));
}

TEST_CASE("measures of a harmonic acceleration over whole cycles", "[motion]") {
  const double a = 3.0, f = 2.0, end = 20.0, omega = 2.0 * kPi * f;
  const GroundMotion sine = harmonic(a, f, 0.001, end);
  CHECK(pga(sine) == Approx(a).epsilon(1e-12));
  // v = (a / omega) (1 - cos); the trapezoid errs by (omega dt)^2 / 12.
  CHECK(pgv(sine) == Approx(2.0 * a / omega).epsilon(2e-5));
  CHECK(arias_intensity(sine) == Approx(kPi / (2.0 * kGravity) * a * a * end / 2.0).epsilon(1e-9));
  // Energy grows by steps of half a period, an eighth of a second.
  CHECK(significant_duration(sine) == Approx(0.9 * end).margin(0.125));
  CHECK(cumulative_absolute_velocity(sine) == Approx(2.0 / kPi * a * end).epsilon(2e-5));
  // The window of 40 cycles leaks to both sides, and 1 / f weighs the lower one more.
  CHECK(mean_period(sine) == Approx(1.0 / f).epsilon(1e-2));
}

TEST_CASE("mean period weights with squared amplitude", "[motion]") {
  // Whole cycles in 2^14 samples, so that no other frequency has a part.
  const double dt = 0.005, span = 16384 * dt;
  const double f1 = 41.0 / span, f2 = 410.0 / span, f3 = 2000.0 / span;
  REQUIRE(f1 > 0.25);
  REQUIRE(f3 > 20.0);
  GroundMotion motion = sampled(dt, span - dt, [=](double t) {
    return 1.0 * std::sin(2 * kPi * f1 * t) + 3.0 * std::cos(2 * kPi * f2 * t) +
           5.0 * std::sin(2 * kPi * f3 * t);
  });
  REQUIRE(motion.acceleration.size() == 16384);
  CHECK(mean_period(motion) == Approx((1.0 / f1 + 9.0 / f2) / 10.0).epsilon(1e-9));
  const GroundMotion slow = sampled(5.0, 100.0, [](double t) { return std::sin(t); });
  CHECK_THROWS_AS(mean_period(slow), InputError);
}

TEST_CASE("frequency below which a share of the energy lies", "[motion]") {
  // Two sines over whole cycles: 9 parts of the energy at 2 Hz and 1 at 8 Hz.
  const GroundMotion both = sampled(0.005, 20.48, [](double t) {
    return 3.0 * std::sin(4.0 * kPi * t) + std::sin(16.0 * kPi * t);
  });
  CHECK(frequency_below(both, 0.5) == Approx(2.0).margin(0.1));
  CHECK(frequency_below(both, 0.8) == Approx(2.0).margin(0.1));
  CHECK(frequency_below(both, 0.95) == Approx(8.0).margin(0.1));
}

TEST_CASE("measures of a decaying sine", "[motion]") {
  const double a = 4.0, beta = 0.25, omega = 2.0 * kPi * 5.0;
  const GroundMotion motion =
      sampled(0.002, 60.0, [=](double t) { return a * std::exp(-beta * t) * std::sin(omega * t); });
  const double energy = a * a * omega * omega / (4.0 * beta * (beta * beta + omega * omega));
  CHECK(arias_intensity(motion) == Approx(kPi / (2.0 * kGravity) * energy).epsilon(1e-5));
  // The envelope of the energy is 1 - exp(-2 beta t); its steps are a tenth of a second.
  CHECK(significant_duration(motion) == Approx(std::log(19.0) / (2.0 * beta)).margin(0.1));
  // Its spectrum is omega / |(beta + i 2 pi f)^2 + omega^2|.
  double weighted = 0.0, weights = 0.0;
  for (double f = 0.25; f <= 20.0; f += 1e-3) {
    const std::complex<double> s(beta, 2.0 * kPi * f);
    const double c2 = 1.0 / std::norm(s * s + omega * omega);
    weighted += c2 / f;
    weights += c2;
  }
  CHECK(mean_period(motion) == Approx(weighted / weights).epsilon(1e-3));
}

TEST_CASE("measures scale as they must", "[motion]") {
  const GroundMotion motion = sampled(0.01, 20.0, [](double t) {
    return std::exp(-0.2 * t) * (std::sin(9.0 * t) + 0.3 * std::sin(31.0 * t));
  });
  GroundMotion twice = motion;
  for (double& x : twice.acceleration) x *= -2.0;
  const MotionMeasures m = measure(motion), n = measure(twice);
  CHECK(n.pga == Approx(2.0 * m.pga));
  CHECK(n.pgv == Approx(2.0 * m.pgv));
  CHECK(n.cav == Approx(2.0 * m.cav));
  CHECK(n.masi == Approx(2.0 * m.masi));
  CHECK(n.arias == Approx(4.0 * m.arias));
  CHECK(n.tm == Approx(m.tm));
  CHECK(n.d5_95 == Approx(m.d5_95));
}

TEST_CASE("what is no motion is not measured", "[motion]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GroundMotion good{.dt = 0.01, .acceleration = {0.0, 1.0, 0.0}, .origin = "m"};
  CHECK_NOTHROW(check(good));
  for (const GroundMotion& bad :
       {GroundMotion{.dt = nan, .acceleration = {1.0, 2.0}, .origin = "m"},
        GroundMotion{.dt = 0.0, .acceleration = {1.0, 2.0}, .origin = "m"},
        GroundMotion{.dt = 0.01, .acceleration = {1.0}, .origin = "m"},
        GroundMotion{.dt = 0.01, .acceleration = {0.0, 0.0}, .origin = "m"},
        GroundMotion{.dt = 0.01, .acceleration = {1.0, nan}, .origin = "m"}})
    CHECK_THROWS_AS(measure(bad), InputError);
  // Picoseconds: the transform would take 300 TB.
  const GroundMotion fast{.dt = 1e-12, .acceleration = {0.0, 1.0, 0.0}, .origin = "m"};
  CHECK_THROWS_WITH(measure(fast), Catch::Contains("is its unit right?"));
}
