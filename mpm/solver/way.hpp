#pragma once
#include "mpm/solver/simulation.hpp"

#include <algorithm>
#include <cmath>

/// How far a step takes the points, looked at when the forces are known and nothing has moved.
/// docs/theory/time-step.md, section Acceleration
namespace flowslide::mpm {

/// By how much acceleration may exceed what the last step's speeds and rates were to give.
inline constexpr double kWayOverLimit = 2.5, kStrainOverLimit = 4.0;
/// Beyond these the step makes no sense, however it came to it: cells, and |L| dt.
inline constexpr double kFarthestWay = 1.0, kLargestStrain = 0.9;

/// Change of a node's velocity up to which no point near it needs to be looked at [m/s].
template <int Dim>
double little_gain(const Simulation<Dim>& s) noexcept {
  return 0.5 * std::min(s.settings.velocity_limit, s.settings.strain_limit) * s.grid.h / s.dt;
}

/// Calls f(node, square of its change of velocity) for every contact node, with what the walls gave
/// in the last step: before them the lowest nodes carry the weight of all soil above and seem to
/// fall. Weighed as by update_momentum.
template <int Dim, class F>
void gains_at_walls(const Simulation<Dim>& s, double light, F&& f) noexcept {
  using L = NodeLayout<Dim>;
  const Contact<Dim>& c = s.contact;
  const double floor = kMassFloor * s.full_mass;
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    const auto& q = s.grid.nodes[c.nodes[k]].q;
    const double m = q[L::mass];
    if (!(m > floor)) continue;
    double change2 = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const double gain = q[L::force + d] + c.given[k][d] / m;
      change2 += gain * gain;
    }
    const double share = light > 0.0 ? std::min(1.0, m / light) : 1.0;
    f(c.nodes[k], share * share * change2);
  }
}

/// True where no node gains more. Called by every thread, with the same answer.
template <int Dim>
bool gains_little(const Simulation<Dim>& s, const StepScratch<Dim>& scratch) noexcept {
  const double gain = little_gain(s);
  return scratch.gain2_at_walls <= gain * gain &&
         std::all_of(scratch.tile.begin(), scratch.tile.end(),
                     [&](const TileScratch<Dim>& t) { return t.gain2 <= gain * gain; });
}

/// The same of the nodes that the points of a tile reach.
template <int Dim>
bool tile_gains_little(const Simulation<Dim>& s, const StepScratch<Dim>& scratch,
                       const Tile<Dim>& tile) noexcept {
  const double gain = little_gain(s);
  return std::all_of(tile.around.begin(), tile.around.end(), [&](std::int32_t block) {
    return scratch.gain2[static_cast<std::size_t>(block)] <= gain * gain;
  });
}

/// Written so that what is not a number is the farthest.
inline Way farther(const Way& a, const Way& b) noexcept {
  return {a.length <= b.length || std::isnan(b.length) ? b.length : a.length,
          a.strain <= b.strain || std::isnan(b.strain) ? b.strain : a.strain};
}

/// Of the first `count` points in scratch.velocity and scratch.gradient.
template <int Dim>
Way way_of(const TileScratch<Dim>& scratch, std::int32_t count, double dt, double h) noexcept {
  Way most;
  for (std::int32_t k = 0; k < count; ++k) {
    double speed2 = 0.0, rate2 = 0.0;
    for (const auto& v : scratch.velocity) speed2 += v[k] * v[k];
    for (const auto& l : scratch.gradient) rate2 += l[k] * l[k];
    most = farther(most, {dt * std::sqrt(speed2) / h, dt * std::sqrt(rate2)});
  }
  return most;
}

/// 1 where a step may go this way, else by how much to shorten it; not a number if none would do.
template <int Dim>
double allowed_share(const Simulation<Dim>& s, const Way& way) noexcept {
  const double length = std::min(kWayOverLimit * s.settings.velocity_limit, kFarthestWay);
  const double strain = std::min(kStrainOverLimit * s.settings.strain_limit, kLargestStrain);
  if (way.length <= length && way.strain <= strain) return 1.0;
  if (std::isnan(way.length) || std::isnan(way.strain)) return std::nan("");
  const double share = std::min(length / way.length, strain / way.strain);
  return std::clamp(0.9 * std::sqrt(share), 0.1, 0.7);
}

}  // namespace flowslide::mpm
