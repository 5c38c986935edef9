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

/// Trailing means of the energy and its pre-failure envelope, from the first liquefaction on.
struct EnergyLevels {
  std::vector<double> energy, envelope;
  std::size_t liquefied = 0;  ///< number of samples if nothing has
};

EnergyLevels energy_levels(const AutomaticTransfer& rule, const ZoneHistory& h,
                           std::span<const double> base_energy) {
  const std::size_t n = h.time.size();
  FLOWSLIDE_EXPECT(base_energy.size() == n);
  EnergyLevels r;
  const bool sliding = rule.energy == EnergyFrame::sliding;  // holds means already
  const std::vector<double>& energy = sliding ? h.sliding_energy
                                      : rule.energy == EnergyFrame::relative
                                          ? h.kinetic_energy_relative
                                          : h.kinetic_energy;
  r.energy = trailing_mean(h.time, energy, sliding ? 0.0 : rule.smoothing);
  std::vector<double> base = trailing_mean(h.time, base_energy, sliding ? 0.0 : rule.smoothing);
  for (std::size_t i = 1; i < n; ++i) base[i] = std::max(base[i], base[i - 1]);

  r.liquefied = n;
  for (const std::vector<double>& depth : h.depth) {
    const auto first = std::ranges::find_if(depth, [](double d) { return d > 0.0; });
    r.liquefied = std::min(r.liquefied, static_cast<std::size_t>(first - depth.begin()));
  }
  if (r.liquefied == n) return r;

  // What moves before anything has liquefied is taken for shaking, a slide too: of a dam that fails
  // first by yielding, the envelope holds that slide, and onset is the later one that outgrows it.
  // Ratios of two energies that are both near zero say nothing.
  const double significant = r.liquefied > 0 ? 0.1 * base[r.liquefied - 1] : 0.0;
  double largest = 0.0;
  // stiff ground follows slow motion of its base so well that its own ratio says little
  constexpr double kLeast = 0.1;
  double ratio = sliding ? kLeast : 0.0;
  for (std::size_t i = 0; i < r.liquefied; ++i) {
    largest = std::max(largest, r.energy[i]);
    if (base[i] > 0.0 && base[i] >= significant) ratio = std::max(ratio, r.energy[i] / base[i]);
  }
  for (const double b : base) r.envelope.push_back(std::max(largest, ratio * b));
  return r;
}

EnergyOnset onset_of(const EnergyLevels& x, std::size_t grown) {
  std::size_t begin = grown;
  while (begin > x.liquefied && x.energy[begin - 1] > x.envelope[begin - 1]) --begin;
  return {begin, grown, x.energy[grown], x.envelope[grown]};
}

}  // namespace

std::optional<EnergyOnset> find_onset(const AutomaticTransfer& rule, const ZoneHistory& h,
                                      std::span<const double> base_energy) {
  const std::size_t n = h.time.size();
  const EnergyLevels x = energy_levels(rule, h, base_energy);
  // The mean drags a burst out by its own length.
  const double hold = rule.smoothing + rule.sustain;
  const auto above = [&](std::size_t i) { return x.energy[i] > rule.growth * x.envelope[i]; };
  for (std::size_t i = x.liquefied; i < n; ++i) {
    if (h.time[i] + hold > h.time[n - 1]) break;
    std::size_t k = i;
    while (k < n && above(k) && h.time[k] < h.time[i] + hold) ++k;
    if (k < n && above(k) && x.energy[k] > x.energy[i]) return onset_of(x, i);
  }
  return std::nullopt;
}

std::optional<EnergyOnset> rising_at_end(const AutomaticTransfer& rule, const ZoneHistory& h,
                                         std::span<const double> base_energy) {
  const std::size_t n = h.time.size();
  const EnergyLevels x = energy_levels(rule, h, base_energy);
  std::size_t first = n;
  while (first > x.liquefied && x.energy[first - 1] > rule.growth * x.envelope[first - 1]) --first;
  if (first == n) return std::nullopt;
  return onset_of(x, first);
}

}  // namespace flowslide
