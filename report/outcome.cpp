#include "report/outcome.hpp"

#include "model/front.hpp"
#include "model/mesh.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "report/facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

constexpr double kCrestPoints = 4.0;  ///< spacings of points that the edge of the crest is wide
constexpr std::array<double, 4> kRuClasses{0.1, 0.3, 0.7, std::numeric_limits<double>::infinity()};

/// Displacement vectors of a point, horizontal and vertical.
struct Moves {
  std::array<double, 2> shaking, flow;
};

Moves moves_of(const ParticleSet& p, const FinalState& end, std::size_t i) {
  Moves m{};
  for (std::size_t d = 0; d < 2; ++d) {
    m.shaking[d] = p.displacement[i][d];
    m.flow[d] = end.position[i][d] - end.undeformed[i][d] - m.shaking[d];
  }
  return m;
}

double size(const std::array<double, 2>& u) { return std::sqrt(u[0] * u[0] + u[1] * u[1]); }

double exceeded(std::vector<Place>& moved) {
  return std::max(0.0, height(moved));  // the share is that of the height
}

/// Edge of the points that are whole: the median, since many at a surface or a material limit are
/// cut. Reorders `edges`.
double whole_edge(std::vector<double>& edges) {
  const auto middle = edges.begin() + std::ssize(edges) / 2;
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

/// Surface of the undeformed section above the points that count: the highest upper side of any.
double surface_above(const ParticleSet& p, const FinalState& end, double whole) {
  double level = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    // What a level surface cut is as wide as the others, and only as high as its volume tells.
    const double high = std::min(p.volume[i] / whole, std::sqrt(p.volume[i]));
    level = std::max(level, end.undeformed[i][1] + 0.5 * high);
  }
  return level;
}

CrestFacts crest_facts(const ParticleSet& p, const FinalState& end, const ReportConfig& config) {
  CrestFacts c;
  double top = -std::numeric_limits<double>::infinity(), spacing = 0.0;
  std::vector<double> edges;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    top = std::max(top, end.undeformed[i][1]);
    edges.push_back(std::sqrt(p.volume[i]));
    spacing = std::max(spacing, edges.back());
  }
  if (edges.empty()) return c;
  const auto highest = [&](std::size_t i) {
    return end.counts[i] && end.undeformed[i][1] > top - spacing;
  };
  for (std::size_t i = 0; i < p.size(); ++i)
    if (highest(i) && !(c.x >= end.undeformed[i][0])) c.x = end.undeformed[i][0];
  double mass = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!highest(i) || end.undeformed[i][0] < c.x - kCrestPoints * spacing) continue;
    const Moves m = moves_of(p, end, i);
    mass += p.mass[i];
    c.outward.shaking += p.mass[i] * m.shaking[0];
    c.outward.flow += p.mass[i] * m.flow[0];
    c.settlement.shaking -= p.mass[i] * m.shaking[1];
    c.settlement.flow -= p.mass[i] * m.flow[1];
  }
  for (Apart* a : {&c.outward, &c.settlement}) {
    a->shaking /= mass;
    a->flow /= mass;
    a->both = a->shaking + a->flow;
  }
  c.level = surface_above(p, end, whole_edge(edges));
  if (config.pond) c.freeboard = c.level - c.settlement.both - *config.pond;
  return c;
}

}  // namespace

std::string_view word(Outcome outcome) {
  constexpr std::array<std::string_view, 4> words{"stood", "deformed", "slid", "flowed"};
  return words[static_cast<std::size_t>(outcome)];
}

OutcomeFacts outcome_facts(const ParticleSet& p, const FinalState& end,
                           const ReportConfig& config) {
  OutcomeFacts f;
  std::vector<Place> shaking, flow, both;
  double mass = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    const Moves m = moves_of(p, end, i);
    const double s = size(m.shaking), u = size(m.flow), w = p.mass[i];
    shaking.push_back({s, w});
    flow.push_back({u, w});
    both.push_back({end.displacement[i], w});
    f.mean.shaking += w * s;
    f.mean.flow += w * u;
    f.mean.both += w * end.displacement[i];
    mass += w;
    low = std::min(low, end.undeformed[i][1]);
    high = std::max(high, end.undeformed[i][1]);
  }
  if (!(mass > 0.0)) return f;
  for (double* mean : {&f.mean.shaking, &f.mean.flow, &f.mean.both}) *mean /= mass;
  f.height = high - low;
  f.largest = {exceeded(shaking), exceeded(flow), exceeded(both)};
  f.crest = crest_facts(p, end, config);
  f.outcome = f.largest.both < config.stood                   ? Outcome::stood
              : f.largest.both < config.moved                 ? Outcome::deformed
              : f.largest.flow < config.flow_reach * f.height ? Outcome::slid
                                                              : Outcome::flowed;
  return f;
}

std::vector<std::pair<double, double>> zone_shares(const QuadMesh& mesh,
                                                   const LiquefactionZone& zone) {
  std::array<double, kRuClasses.size()> areas{};
  double total = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (!zone.liquefied[e] || !is_set(zone.r_u_element[e])) continue;
    const double a = area(corners(mesh, mesh.nodes, e));
    std::size_t k = 0;
    while (zone.r_u_element[e] >= kRuClasses[k]) ++k;
    areas[k] += a;
    total += a;
  }
  std::vector<std::pair<double, double>> shares;
  if (total > 0.0)
    for (std::size_t k = 0; k < areas.size(); ++k)
      shares.emplace_back(kRuClasses[k], areas[k] / total);
  return shares;
}

}  // namespace flowslide
