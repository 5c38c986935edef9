#include "motion/butterworth.hpp"

#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "motion/process.hpp"

#include <algorithm>

namespace flowslide {
namespace {

enum class Side { low, high };

/// One section of second order, or of first order with b2 = a2 = 0.
struct Section {
  double b0, b1, b2, a1, a2;
};

/// Poles of the Butterworth circle in pairs, s^2 + 2 sin(theta) s + 1, by the bilinear transform
/// with the corner prewarped.
std::vector<Section> design(Side side, int order, double corner, double dt) {
  const double k = tan(kPi * corner * dt);
  std::vector<Section> sections;
  for (int i = 0; i < order / 2; ++i) {
    const double c = 2.0 * sin(kPi * (2 * i + 1) / (2.0 * order));
    const double norm = 1.0 / (1.0 + c * k + k * k);
    const double b = side == Side::low ? k * k * norm : norm;
    sections.push_back({b, side == Side::low ? 2.0 * b : -2.0 * b, b, 2.0 * (k * k - 1.0) * norm,
                        (1.0 - c * k + k * k) * norm});
  }
  if (order % 2 == 1) {
    const double b = (side == Side::low ? k : 1.0) / (1.0 + k);
    sections.push_back({b, side == Side::low ? b : -b, 0.0, (k - 1.0) / (k + 1.0), 0.0});
  }
  return sections;
}

/// Transposed direct form II, from rest.
template <class Iterator>
void apply(const Section& s, Iterator first, Iterator last) {
  double z1 = 0.0, z2 = 0.0;
  for (; first != last; ++first) {
    const double x = *first;
    const double y = s.b0 * x + z1;
    z1 = s.b1 * x - s.a1 * y + z2;
    z2 = s.b2 * x - s.a2 * y;
    *first = y;
  }
}

void check_corner(const GroundMotion& motion, double corner) {
  const double nyquist = 0.5 / motion.dt;
  validate(corner > 0.0 && corner < nyquist,
           "{}: a corner of {} Hz is not between 0 and the Nyquist frequency of {:.4g} Hz (step "
           "{:.4g} s)",
           motion.origin, corner, nyquist, motion.dt);
}

}  // namespace

GroundMotion filtered(const GroundMotion& motion, const BandPass& band, const Progress& progress) {
  constexpr double kLongestPad = 3600.0;  // [s]
  check(motion);
  validate(band.high_pass || band.low_pass, "a filter without corners (high_pass, low_pass)");
  validate(band.order >= 1 && band.order <= 10, "a filter of order {} is not between 1 and 10",
           band.order);
  if (band.high_pass) check_corner(motion, *band.high_pass);
  if (band.low_pass) check_corner(motion, *band.low_pass);
  validate(!band.high_pass || !band.low_pass || *band.high_pass < *band.low_pass,
           "high_pass {} Hz is not below low_pass {} Hz (nothing would remain) swap them",
           band.high_pass.value_or(0.0), band.low_pass.value_or(0.0));

  std::vector<Section> sections;
  if (band.high_pass) sections = design(Side::high, band.order, *band.high_pass, motion.dt);
  if (band.low_pass)
    for (const Section& s : design(Side::low, band.order, *band.low_pass, motion.dt))
      sections.push_back(s);

  const double lowest = band.high_pass ? *band.high_pass : *band.low_pass;
  const double pad_time = 1.5 * band.order / lowest;
  validate(pad_time <= kLongestPad,
           "{}: a corner of {} Hz needs {:.3g} s of padding (no ground motion has such periods)",
           motion.origin, lowest, pad_time);
  validate(pad_time / motion.dt <= kMostSamples,
           "{}: a corner of {} Hz needs {:.3g} samples of padding at a step of {} s (at most {:g}) "
           "raise it, or resample first",
           motion.origin, lowest, pad_time / motion.dt, motion.dt, kMostSamples);
  const bool zero_phase = band.phase == FilterPhase::zero;
  const auto after = static_cast<std::size_t>(std::ceil(pad_time / motion.dt));
  const std::size_t before = zero_phase ? after : 0;

  std::vector<double> x(before, 0.0);
  x.insert(x.end(), motion.acceleration.begin(), motion.acceleration.end());
  x.resize(x.size() + after, 0.0);
  for (const Section& s : sections) {
    progress.poll();
    apply(s, x.begin(), x.end());
  }
  for (std::size_t i = 0; zero_phase && i < sections.size(); ++i) {
    progress.poll();
    apply(sections[i], x.rbegin(), x.rend());
  }

  GroundMotion out{.dt = motion.dt, .acceleration = std::move(x), .origin = motion.origin};
  if (!band.keep_padding) {
    const auto first = out.acceleration.begin() + static_cast<std::ptrdiff_t>(before);
    out.acceleration.assign(first, first + static_cast<std::ptrdiff_t>(motion.acceleration.size()));
  }
  out.origin += fmt::format(
      "; Butterworth {} to {} Hz, order {}, {} phase{}", band.high_pass.value_or(0.0),
      band.low_pass ? fmt::format("{}", *band.low_pass) : std::string("infinite"), band.order,
      kFilterPhases[static_cast<std::size_t>(band.phase)],
      band.keep_padding ? fmt::format(", {} samples of padding before", before) : std::string());
  return out;
}

}  // namespace flowslide
