#include "report/composition.hpp"

#include "model/particle_set.hpp"
#include "report/facts.hpp"

#include <algorithm>

namespace flowslide {
namespace {

/// Foremost points of which the composition is told.
constexpr double kForemost = 0.01;

std::vector<FrontShare> shares_beyond(const ParticleSet& p, const FinalState& end, double front) {
  std::vector<double> mass(p.materials.size(), 0.0);
  double total = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i] || end.position[i][0] < front) continue;
    mass[static_cast<std::size_t>(p.material[i])] += p.mass[i];
    total += p.mass[i];
  }
  std::vector<FrontShare> shares;
  for (std::size_t m = 0; m < mass.size(); ++m)
    if (mass[m] > 0.0) shares.push_back({p.materials[m].name, mass[m] / total});
  std::stable_sort(shares.begin(), shares.end(),
                   [](const FrontShare& a, const FrontShare& b) { return a.share > b.share; });
  return shares;
}

}  // namespace

Composition composition(const ParticleSet& p, const FinalState& end, double toe) {
  static_assert(kFrontShares[2] == kForemost, "the foremost 1 % lie beyond the front of 1 %");
  Composition c;
  std::vector<Place> counted, up, liquefied;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    const double x = end.position[i][0];
    counted.push_back({x, p.mass[i]});
    up.push_back({end.position[i][1], p.mass[i]});
    if (p.materials[static_cast<std::size_t>(p.material[i])].liquefied)
      liquefied.push_back({x, p.mass[i]});
    if (is_set(toe) && x > toe) c.mass_past_toe += p.mass[i];
  }
  if (counted.empty()) return c;
  c.fronts = fronts(counted);
  c.height = height(up);
  c.foremost = shares_beyond(p, end, c.fronts.q99);
  c.liquefied = !liquefied.empty();
  c.liquefied_fronts = fronts(liquefied);
  return c;
}

}  // namespace flowslide
