#include "core/check.hpp"
#include "transfer/zone/transfer_time.hpp"

#include <algorithm>

namespace flowslide {

std::vector<double> trailing_mean(std::span<const double> time, std::span<const double> value,
                                  double length) {
  FLOWSLIDE_EXPECT(time.size() == value.size());
  std::vector<double> mean(time.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    while (first < i && time[first] <= time[i] - length) ++first;
    double sum = 0.0;
    for (std::size_t k = first; k <= i; ++k) sum += value[k];
    mean[i] = sum / static_cast<double>(i - first + 1);
  }
  return mean;
}

namespace {

/// Share of the section's mass that has to have yielded before the search for a failure begins: a
/// slip surface of some elements, not one element at an edge.
constexpr double kYielded = 0.001;

/// Trailing means of the energy and its pre-failure envelope.
struct EnergyLevels {
  std::vector<double> energy, envelope;
  /// First sample at which something has liquefied or yielded, from which on a failure is looked
  /// for; number of samples if nothing has.
  std::size_t weakened = 0;
};

/// First sample of which `values` exceeds `limit`.
std::size_t first_above(std::span<const double> values, double limit) {
  const auto found = std::ranges::find_if(values, [limit](double v) { return v > limit; });
  return static_cast<std::size_t>(found - values.begin());
}

EnergyLevels energy_levels(const AutomaticTransfer& rule, const ZoneHistory& h,
                           const TransferEvidence& evidence) {
  const std::size_t n = h.time.size();
  FLOWSLIDE_EXPECT(evidence.base_energy.size() == n && evidence.yielded.size() == n);
  EnergyLevels r;
  const bool sliding = rule.energy == EnergyFrame::sliding;  // holds means already
  const std::vector<double>& energy = sliding ? h.sliding_energy
                                      : rule.energy == EnergyFrame::relative
                                          ? h.kinetic_energy_relative
                                          : h.kinetic_energy;
  r.energy = trailing_mean(h.time, energy, sliding ? 0.0 : rule.smoothing);
  std::vector<double> base =
      trailing_mean(h.time, evidence.base_energy, sliding ? 0.0 : rule.smoothing);
  for (std::size_t i = 1; i < n; ++i) base[i] = std::max(base[i], base[i - 1]);

  r.weakened = first_above(evidence.yielded, kYielded);
  for (const std::vector<double>& depth : h.depth)
    r.weakened = std::min(r.weakened, first_above(depth, 0.0));
  if (r.weakened == n) return r;

  // What moves before anything has weakened is taken for shaking.
  // Ratios of two energies that are both near zero say nothing.
  const double significant = r.weakened > 0 ? 0.1 * base[r.weakened - 1] : 0.0;
  double largest = 0.0;
  // stiff ground follows slow motion of its base so well that its own ratio says little
  constexpr double kLeast = 0.1;
  double ratio = sliding ? kLeast : 0.0;
  for (std::size_t i = 0; i < r.weakened; ++i) {
    largest = std::max(largest, r.energy[i]);
    if (base[i] > 0.0 && base[i] >= significant) ratio = std::max(ratio, r.energy[i] / base[i]);
  }
  if (ratio == 0.0 &&
      largest == 0.0) {  // weakened from the first sample on: nothing to compare with
    r.weakened = n;
    return r;
  }
  for (const double b : base) r.envelope.push_back(std::max(largest, ratio * b));
  return r;
}

EnergyOnset onset_of(const EnergyLevels& x, std::size_t grown) {
  std::size_t begin = grown;
  while (begin > x.weakened && x.energy[begin - 1] > x.envelope[begin - 1]) --begin;
  return {begin, grown, x.energy[grown], x.envelope[grown]};
}

}  // namespace

std::optional<EnergyOnset> find_onset(const AutomaticTransfer& rule, const ZoneHistory& h,
                                      const TransferEvidence& evidence) {
  const std::size_t n = h.time.size();
  const EnergyLevels x = energy_levels(rule, h, evidence);
  // The mean drags a burst out by its own length.
  const double hold = rule.smoothing + rule.sustain;
  const auto above = [&](std::size_t i) { return x.energy[i] > rule.growth * x.envelope[i]; };
  for (std::size_t i = x.weakened; i < n; ++i) {
    if (h.time[i] + hold > h.time[n - 1]) break;
    std::size_t k = i;
    while (k < n && above(k) && h.time[k] < h.time[i] + hold) ++k;
    if (k < n && above(k) && x.energy[k] > x.energy[i]) return onset_of(x, i);
  }
  return std::nullopt;
}

std::optional<EnergyOnset> rising_at_end(const AutomaticTransfer& rule, const ZoneHistory& h,
                                         const TransferEvidence& evidence) {
  const std::size_t n = h.time.size();
  const EnergyLevels x = energy_levels(rule, h, evidence);
  std::size_t first = n;
  while (first > x.weakened && x.energy[first - 1] > rule.growth * x.envelope[first - 1]) --first;
  if (first == n) return std::nullopt;
  return onset_of(x, first);
}

}  // namespace flowslide
