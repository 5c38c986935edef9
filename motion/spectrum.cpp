#include "motion/spectrum.hpp"

#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "motion/measures.hpp"

#include <algorithm>

namespace flowslide {
namespace {

/// Exact step of the oscillator for a(t) = a0 + (a1 - a0) t / dt: its particular solution is
/// straight in t, and the rest vibrates freely.
class Oscillator {
 public:
  Oscillator(double omega, double damping, double dt)
      : dt_(dt), omega2_(omega * omega), lag_(2.0 * damping / omega) {
    const double root = std::sqrt(1.0 - damping * damping);
    const double decay = exp(-damping * omega * dt);
    const double c = decay * cos(omega * root * dt);
    const double s = decay * sin(omega * root * dt);
    uu_ = c + damping / root * s;
    uv_ = s / (omega * root);
    vu_ = -omega * s / root;
    vv_ = c - damping / root * s;
  }

  void step(double a0, double a1) {
    const double slope = (a1 - a0) / dt_;
    const double v_forced = -slope / omega2_;
    const double u_forced = (lag_ * slope - a0) / omega2_;
    const double u_free = u - u_forced, v_free = v - v_forced;
    u = uu_ * u_free + uv_ * v_free + u_forced + v_forced * dt_;
    v = vu_ * u_free + vv_ * v_free + v_forced;
  }

  double u = 0.0, v = 0.0;  ///< relative to the ground [m], [m/s]

 private:
  double dt_, omega2_, lag_;
  double uu_ = 0.0, uv_ = 0.0, vu_ = 0.0, vv_ = 0.0;
};

/// Largest |u| on the Hermite cubic of a step in which the velocity changes its sign.
double peak_between(double u0, double v0, double u1, double v1, double dt) {
  const double m0 = v0 * dt, m1 = v1 * dt;
  // u' = 0 is a s^2 + b s + m0 = 0 on 0 <= s <= 1, with one root as the signs of m0 and m1 differ.
  const double a = 6.0 * (u0 - u1) + 3.0 * (m0 + m1);
  const double b = 6.0 * (u1 - u0) - 4.0 * m0 - 2.0 * m1;
  const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(0.0, b * b - 4.0 * a * m0)), b));
  double most = 0.0;
  for (const double s : {q / a, m0 / q}) {
    if (!(s >= 0.0 && s <= 1.0)) continue;
    const double r = 1.0 - s;
    const double u =
        r * r * (1.0 + 2.0 * s) * u0 + s * s * (3.0 - 2.0 * s) * u1 + s * r * (r * m0 - s * m1);
    most = std::max(most, std::abs(u));
  }
  return most;
}

}  // namespace

double spectral_displacement(const GroundMotion& motion, double period, double damping,
                             PeakSearch search) {
  validate(period > 0.0 && std::isfinite(period), "the period {} s is not positive", period);
  validate(damping >= 0.0 && damping < 1.0,
           "a damping ratio of {} is not between 0 and 1 (write 5 % as 0.05)", damping);
  const std::vector<double>& a = motion.acceleration;
  Oscillator oscillator(2.0 * kPi / period, damping, motion.dt);
  // One free cycle after the motion holds the largest |u| that is still to come.
  const auto tail = static_cast<std::size_t>(std::min(std::ceil(period / motion.dt), 1e7)) + 1;
  double most = 0.0;
  for (std::size_t i = 1; i < a.size() + tail; ++i) {
    const double a0 = i <= a.size() ? a[i - 1] : 0.0;
    const double a1 = i < a.size() ? a[i] : 0.0;
    const double u = oscillator.u, v = oscillator.v;
    oscillator.step(a0, a1);
    most = std::max(most, std::abs(oscillator.u));
    if (search == PeakSearch::between && v * oscillator.v < 0.0)
      most = std::max(most, peak_between(u, v, oscillator.u, oscillator.v, motion.dt));
  }
  return most;
}

std::vector<double> pseudo_acceleration(const GroundMotion& motion, std::span<const double> periods,
                                        double damping, PeakSearch search,
                                        const Progress& progress) {
  check(motion);
  std::vector<double> psa;
  for (const double period : periods) {
    progress.poll();
    const double omega = 2.0 * kPi / period;
    psa.push_back(period == 0.0
                      ? pga(motion)
                      : omega * omega * spectral_displacement(motion, period, damping, search));
  }
  return psa;
}

double masi(const GroundMotion& motion, PeakSearch search, const Progress& progress) {
  constexpr double kFrom = 0.1, kSpacing = 0.01;  // [s]
  constexpr int kIntervals = 140;                 // up to 1.5 s
  std::vector<double> periods;
  for (int i = 0; i <= kIntervals; ++i) periods.push_back(kFrom + kSpacing * i);
  const std::vector<double> psa = pseudo_acceleration(motion, periods, 0.05, search, progress);
  double sum = 0.5 * (psa.front() + psa.back());
  for (std::size_t i = 1; i + 1 < psa.size(); ++i) sum += psa[i];
  return sum * kSpacing;
}

}  // namespace flowslide
