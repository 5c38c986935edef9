#include "motion/synthetic.hpp"

#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "motion/fourier.hpp"
#include "motion/measures.hpp"
#include "motion/process.hpp"

#include <algorithm>
#include <cstdint>

namespace flowslide {
namespace {

/// splitmix64 (Steele, Lea and Flood 2014), so that no library decides what a seed means.
class Random {
 public:
  explicit Random(int seed) : state_(static_cast<std::uint64_t>(seed)) {}

  /// Uniform in (0, 1).
  double uniform() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return (static_cast<double>(z >> 11) + 0.5) * 0x1p-53;
  }
  /// Standard normal (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * log(uniform()));
    return radius * cos(2.0 * kPi * uniform());
  }

 private:
  std::uint64_t state_;
};

/// Smallest even number from `least` on without a prime factor above 5, for the transform.
std::size_t transform_size(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t prime : {2u, 3u, 5u})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

/// Transfer function of Brune's source spectrum and of the ground filter of Kanai and Tajimi, both
/// causal so that the motion starts from rest, and of kappa.
std::complex<double> transfer(double f, double f_g, const SyntheticConfig& c) {
  const std::complex<double> s(0.0, f / f_g);
  const std::complex<double> damped = 2.0 * c.bandwidth * s;
  const std::complex<double> ground = (1.0 + damped) / (1.0 + s * s + damped);
  const std::complex<double> source = s / (s + c.corner);
  return source * source * ground * exp(-kPi * c.kappa * f);
}

/// Gamma-shaped envelope with its peak of 1 at t_p (Saragoni and Hart 1974).
double envelope(double t, double t_p, double rise) {
  if (t <= 0.0) return 0.0;
  return exp(rise * (log(t / t_p) + 1.0 - t / t_p));
}

/// What a strong phase adds: cos^2 with half its height at begin and end.
double strong_phase(double t, const SyntheticConfig& c) {
  if (!c.strong_begin) return 0.0;
  const double half = 0.5 * (*c.strong_end - *c.strong_begin);
  const double x = (t - *c.strong_begin - half) / half;
  if (std::abs(x) >= 2.0) return 0.0;
  const double cosine = cos(0.25 * kPi * x);
  return c.strong_ratio * cosine * cosine;
}

/// Ends the envelope, so that the filters ring out before the transform comes round to the start.
double end_taper(double share) {
  constexpr double kBegin = 0.75, kEnd = 0.9;  // of the length
  const double x = std::clamp((share - kBegin) / (kEnd - kBegin), 0.0, 1.0);
  return 0.5 * (1.0 + cos(kPi * x));
}

struct Shape {
  double f_g;  ///< frequency of the ground filter [Hz]
  double t_p;  ///< time of the peak of the envelope [s]
};

GroundMotion shaped(const SyntheticConfig& c, const std::vector<double>& noise, Shape shape) {
  const std::size_t n = noise.size();
  std::vector<double> windowed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double place = static_cast<double>(i), t = place * c.dt;
    windowed[i] = noise[i] * (envelope(t - c.lead, shape.t_p, c.rise) + strong_phase(t, c)) *
                  end_taper(place / static_cast<double>(n));
  }

  std::vector<std::complex<double>> spectrum = half_spectrum(windowed);
  const double df = 1.0 / (static_cast<double>(n) * c.dt);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= transfer(static_cast<double>(k) * df, shape.f_g, c);
  return {.dt = c.dt, .acceleration = samples_of(spectrum, n), .origin = "synthetic"};
}

void check_range(std::string_view what, double value, double least, double most,
                 std::string_view unit) {
  validate(value >= least && value <= most, "synthetic motion: {} {}{} is not between {} and {}{}",
           what, value, unit, least, most, unit);
}

void check_settings(const SyntheticConfig& c) {
  check_range("pga", c.pga, 1e-6, 1e3, " m/s2");
  check_range("tm", c.tm, 0.1, 2.0, " s");
  check_range("d5_95", c.d5_95, 1.0, 200.0, " s");
  check_range("dt", c.dt, 1e-4, 0.02, " s");
  check_range("bandwidth", c.bandwidth, 0.1, 2.0, "");
  check_range("corner", c.corner, 0.02, 1.0, "");
  check_range("kappa", c.kappa, 0.0, 0.2, " s");
  check_range("rise", c.rise, 0.5, 10.0, "");
  check_range("lead", c.lead, 0.0, 600.0, " s");
  validate(c.strong_begin.has_value() == c.strong_end.has_value(),
           "synthetic motion: strong_begin and strong_end belong together");
  validate(c.strong_begin || c.strong_ratio == SyntheticConfig{}.strong_ratio,
           "synthetic motion: strong_ratio {} without strong_begin and strong_end (there is no "
           "strong phase that it could raise) give both, or leave it out",
           c.strong_ratio);
  if (c.strong_begin) {
    const double begin = *c.strong_begin, end = *c.strong_end;
    check_range("strong_ratio", c.strong_ratio, 0.0, 100.0, "");
    check_range("strong_end", end, begin + 2.0 * c.tm, begin + c.d5_95, " s");
    // The flanks of the phase reach half its length beyond it.
    check_range("strong_begin", begin, c.lead + 0.5 * (end - begin), c.lead + 2.0 * c.d5_95, " s");
  }
  validate(c.d5_95 >= 3.0 * c.tm,
           "synthetic motion: d5_95 {} s is shorter than three mean periods of {} s (too few "
           "cycles to be an earthquake)",
           c.d5_95, c.tm);
}

/// The end of the whole length is faded out; after a long lead the shaking would fall into that.
void check_lead(const SyntheticConfig& c) {
  constexpr double kMostDurations = 4.0;
  validate(c.lead <= kMostDurations * c.d5_95,
           "synthetic motion: lead {} s is more than {:g} times d5_95 of {} s (the motion is made "
           "in one piece whose end is faded out, and the shaking would fall into that) take at "
           "most {:g} s; fem.run finds the state at rest by itself and needs no lead",
           c.lead, kMostDurations, c.d5_95, kMostDurations * c.d5_95);
}

/// Root of a continuous function of log(x), by the regula falsi with halved ends (Illinois).
/// Returns the best x if there is no change of sign.
template <class F>
double root_near(F&& f, double x, double tolerance) {
  constexpr double kStep = 0.1;
  constexpr int kIterations = 60;
  double a = log(x), fa = f(x);
  if (std::abs(fa) < tolerance) return x;
  double b = a, fb = fa;
  // Both measures grow with the logarithm that is passed here.
  for (int i = 0; i < kIterations && fa * fb > 0.0; ++i) {
    a = b, fa = fb;
    b += std::copysign(std::clamp(std::abs(fb), 0.01, kStep), -fb);
    fb = f(exp(b));
  }
  double c = b;
  for (int i = 0; i < kIterations; ++i) {
    c = (a * fb - b * fa) / (fb - fa);
    const double fc = f(exp(c));
    if (std::abs(fc) < tolerance) break;
    if (fc * fb < 0.0) {
      a = b, fa = fb;
    } else {
      fa *= 0.5;
    }
    b = c, fb = fc;
  }
  return exp(c);
}

/// Number of samples.
std::size_t count_samples(const SyntheticConfig& config) {
  check_settings(config);
  check_lead(config);
  // Three quarters of it, 2.6 durations, hold all but 1 % of the energy of any envelope.
  const double length = config.lead + 3.5 * config.d5_95;
  validate(length / config.dt <= kMostSamples,
           "synthetic motion: {:.4g} s at a step of {} s are {:.3g} samples (at most {:g}) raise "
           "dt or shorten lead",
           length, config.dt, length / config.dt, kMostSamples);
  return transform_size(static_cast<std::size_t>(length / config.dt));
}

}  // namespace

double synthetic_duration(const SyntheticConfig& config) {
  return config.dt * static_cast<double>(count_samples(config) - 1);
}

GroundMotion synthesize(const SyntheticConfig& config, const Progress& progress) {
  constexpr double kTolerance = 2e-3;
  constexpr int kRounds = 20;
  std::vector<double> noise(count_samples(config));
  Random random(config.seed);
  for (double& x : noise) x = random.normal();

  // Period follows the ground filter and duration the envelope, with little influence crosswise.
  Shape shape{.f_g = 0.7 / config.tm, .t_p = 0.55 * config.d5_95};
  const auto period_error = [&](double ground_period) {
    progress.poll();
    const Shape trial{.f_g = 1.0 / ground_period, .t_p = shape.t_p};
    return log(mean_period(shaped(config, noise, trial)) / config.tm);
  };
  const auto duration_error = [&](double t_p) {
    progress.poll();
    const Shape trial{.f_g = shape.f_g, .t_p = t_p};
    return log(significant_duration(shaped(config, noise, trial)) / config.d5_95);
  };
  double tm_error = kUnset, d_error = kUnset;
  for (int round = 0; round < kRounds; ++round) {
    shape.t_p = root_near(duration_error, shape.t_p, 0.2 * kTolerance);
    shape.f_g = 1.0 / root_near(period_error, 1.0 / shape.f_g, 0.2 * kTolerance);
    GroundMotion motion = shaped(config, noise, shape);
    tm_error = std::abs(mean_period(motion) / config.tm - 1.0);
    d_error = std::abs(significant_duration(motion) / config.d5_95 - 1.0);
    if (tm_error < kTolerance && d_error < kTolerance) {
      motion = scaled_to_pga(motion, config.pga);
      motion.origin = fmt::format(
          "synthetic, Tm {} s, D5-95 {} s, PGA {:.4g} g, seed {}, bandwidth {}, corner {}",
          config.tm, config.d5_95, config.pga / kGravity, config.seed, config.bandwidth,
          config.corner);
      return motion;
    }
  }
  throw NumericsError(fmt::format(
      "synthetic motion: Tm {} s and D5-95 {} s were not reached together (off by {:.2g} % and "
      "{:.2g} % after {} rounds) change seed, bandwidth or corner",
      config.tm, config.d5_95, 100.0 * tm_error, 100.0 * d_error, kRounds));
}

}  // namespace flowslide
