#include "motion/measures.hpp"

#include "core/conventions.hpp"
#include "motion/fourier.hpp"
#include "motion/spectrum.hpp"

#include <algorithm>
#include <bit>

namespace flowslide {
namespace {

double peak(const std::vector<double>& x) {
  double most = 0.0;
  for (const double v : x) most = std::max(most, std::abs(v));
  return most;
}

/// Husid curve without its factor: integral of a^2 up to each sample.
std::vector<double> energy_curve(const GroundMotion& motion) {
  const std::vector<double>& a = motion.acceleration;
  std::vector<double> sum(a.size(), 0.0);
  for (std::size_t i = 1; i < a.size(); ++i)
    sum[i] = sum[i - 1] + 0.5 * motion.dt * (a[i - 1] * a[i - 1] + a[i] * a[i]);
  return sum;
}

double time_of_share(const std::vector<double>& energy, double dt, double share) {
  const double target = share * energy.back();
  const auto above = std::upper_bound(energy.begin() + 1, energy.end() - 1, target);
  const auto i = static_cast<std::size_t>(above - energy.begin());
  const double gain = energy[i] - energy[i - 1];
  const double part = gain > 0.0 ? (target - energy[i - 1]) / gain : 0.0;
  return dt * (static_cast<double>(i - 1) + std::clamp(part, 0.0, 1.0));
}

}  // namespace

double pga(const GroundMotion& motion) { return peak(motion.acceleration); }
double pgv(const GroundMotion& motion) { return peak(velocity(motion)); }

std::vector<double> velocity(const GroundMotion& motion) {
  const std::vector<double>& a = motion.acceleration;
  std::vector<double> v(a.size(), 0.0);
  for (std::size_t i = 1; i < a.size(); ++i) v[i] = v[i - 1] + 0.5 * motion.dt * (a[i - 1] + a[i]);
  return v;
}

double arias_intensity(const GroundMotion& motion) {
  return kPi / (2.0 * kGravity) * energy_curve(motion).back();
}

double arias_time(const GroundMotion& motion, double share) {
  FLOWSLIDE_EXPECT(share >= 0.0 && share <= 1.0);
  return time_of_share(energy_curve(motion), motion.dt, share);
}

double significant_duration(const GroundMotion& motion, double from, double to) {
  FLOWSLIDE_EXPECT(from >= 0.0 && from <= to && to <= 1.0);
  const std::vector<double> energy = energy_curve(motion);
  return time_of_share(energy, motion.dt, to) - time_of_share(energy, motion.dt, from);
}

double cumulative_absolute_velocity(const GroundMotion& motion) {
  const std::vector<double>& a = motion.acceleration;
  double sum = 0.0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    const double p = std::abs(a[i - 1]), q = std::abs(a[i]);
    // Two triangles where the straight line between the samples crosses zero.
    const bool crosses = a[i - 1] * a[i] < 0.0;
    sum += 0.5 * motion.dt * (crosses ? (p * p + q * q) / (p + q) : p + q);
  }
  return sum;
}

double mean_period(const GroundMotion& motion) {
  constexpr double kLowest = 0.25, kHighest = 20.0;  // [Hz]
  constexpr double kSpacing = 0.05;   // [Hz], the coarsest that the definition allows
  constexpr double kShortest = 1e-6;  // [s], of which a transform of that spacing takes 256 MB
  validate(motion.dt >= kShortest,
           "{}: a time step of {} s (the mean period needs at least {} s; instruments sample at "
           "milliseconds) is its unit right?",
           motion.origin, motion.dt, kShortest);
  const double needed = std::max(static_cast<double>(motion.acceleration.size()),
                                 std::ceil(1.0 / (kSpacing * motion.dt)));
  const std::size_t n = std::bit_ceil(static_cast<std::size_t>(needed));
  std::vector<double> padded = motion.acceleration;
  padded.resize(n, 0.0);
  const std::vector<std::complex<double>> c = half_spectrum(padded);

  const double df = 1.0 / (static_cast<double>(n) * motion.dt);
  double weighted = 0.0, weights = 0.0;
  for (std::size_t k = 1; k < c.size(); ++k) {
    const double f = static_cast<double>(k) * df;
    if (f < kLowest || f > kHighest) continue;
    const double square = c[k].real() * c[k].real() + c[k].imag() * c[k].imag();
    weights += square;
    weighted += square / f;
  }
  validate(weights > 0.0,
           "{}: nothing between {} and {} Hz (the mean period is taken there) check the time step "
           "of {} s",
           motion.origin, kLowest, kHighest, motion.dt);
  return weighted / weights;
}

double frequency_below(const GroundMotion& motion, double share) {
  FLOWSLIDE_EXPECT(share >= 0.0 && share <= 1.0);
  const std::size_t n = std::bit_ceil(motion.acceleration.size());
  std::vector<double> padded = motion.acceleration;
  padded.resize(n, 0.0);
  const std::vector<std::complex<double>> c = half_spectrum(padded);
  std::vector<double> below(c.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < c.size(); ++k) below[k] = sum += std::norm(c[k]);
  const auto at = std::ranges::lower_bound(below, share * sum);
  return static_cast<double>(at - below.begin()) / (static_cast<double>(n) * motion.dt);
}

MotionMeasures measure(const GroundMotion& motion, const Progress& progress) {
  check(motion);
  return {.pga = pga(motion),
          .pgv = pgv(motion),
          .arias = arias_intensity(motion),
          .d5_95 = significant_duration(motion),
          .tm = mean_period(motion),
          .cav = cumulative_absolute_velocity(motion),
          .masi = masi(motion, PeakSearch::samples, progress)};
}

}  // namespace flowslide
