#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "motion/process.hpp"

#include <algorithm>

namespace flowslide {
namespace {

constexpr double kHalfWidth = 32.0;  // zero crossings of the sinc on each side
constexpr double kKaiser = 8.0;      // side lobes 80 dB down

double sinc(double x) { return x == 0.0 ? 1.0 : sin(kPi * x) / (kPi * x); }

/// Modified Bessel function I_0 of a square, sum (x^2/4)^k / k!^2.
double bessel_of_square(double x2) {
  double sum = 1.0, term = 1.0;
  for (int k = 1; term > 1e-17 * sum; ++k) sum += term *= 0.25 * x2 / (double(k) * k);
  return sum;
}

double kaiser(double x) {
  static const double kNorm = bessel_of_square(kKaiser * kKaiser);
  return std::abs(x) >= 1.0 ? 0.0 : bessel_of_square(kKaiser * kKaiser * (1.0 - x * x)) / kNorm;
}

double linear_at(const std::vector<double>& a, double place) {
  const auto i = std::min(static_cast<std::size_t>(place), a.size() - 2);
  const double part = place - static_cast<double>(i);
  return a[i] + part * (a[i + 1] - a[i]);
}

/// `cut` is the cut-off as a share of the Nyquist frequency of `a`. The motion is at rest outside.
double band_limited_at(const std::vector<double>& a, double place, double cut) {
  const double reach = kHalfWidth / cut;
  const auto first = static_cast<std::ptrdiff_t>(std::ceil(place - reach));
  const auto last = static_cast<std::ptrdiff_t>(std::floor(place + reach));
  double sum = 0.0, weights = 0.0;
  for (std::ptrdiff_t i = first; i <= last; ++i) {
    const double x = place - static_cast<double>(i);
    const double weight = sinc(cut * x) * kaiser(x / reach);
    weights += weight;
    if (i >= 0 && i < static_cast<std::ptrdiff_t>(a.size()))
      sum += weight * a[static_cast<std::size_t>(i)];
  }
  return sum / weights;
}

}  // namespace

GroundMotion resampled(const GroundMotion& motion, double dt, ResampleMethod method,
                       const Progress& progress) {
  check(motion);
  validate(dt > 0.0 && std::isfinite(dt), "a time step of {} s is not positive", dt);
  validate(dt <= motion.duration(), "{}: a time step of {} s is longer than the motion ({:.4g} s)",
           motion.origin, dt, motion.duration());
  validate(motion.duration() / dt <= kMostSamples,
           "{}: a time step of {} s makes {:.3g} samples (more than {:.0e} are not meant) "
           "is its unit right?",
           motion.origin, dt, motion.duration() / dt, kMostSamples);
  const double ratio = dt / motion.dt;
  const double cut = std::min(1.0, 1.0 / ratio);
  // A last sample that rounding puts beyond the end belongs to it.
  const auto n = static_cast<std::size_t>(motion.duration() / dt * (1.0 + 1e-12)) + 1;
  GroundMotion out{.dt = dt, .acceleration = std::vector<double>(n), .origin = motion.origin};
  for (std::size_t i = 0; i < n; ++i) {
    progress.poll();
    const double place = static_cast<double>(i) * ratio;
    out.acceleration[i] = method == ResampleMethod::linear
                              ? linear_at(motion.acceleration, place)
                              : band_limited_at(motion.acceleration, place, cut);
  }
  out.origin += fmt::format("; resampled from {:.6g} to {:.6g} s ({})", motion.dt, dt,
                            kResampleMethods[static_cast<std::size_t>(method)]);
  return out;
}

}  // namespace flowslide
