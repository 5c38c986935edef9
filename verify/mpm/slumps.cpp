#include "verify/mpm/slumps.hpp"

#include "core/elementary.hpp"
#include "model/front.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace flowslide::mpm {
namespace {

constexpr double kRough = 1e6;          ///< friction coefficient of a base on which nothing slides
constexpr double kSoil = 2000.0;        ///< density of the undrained columns [kg/m3]
constexpr double kLongestSlump = 40.0;  ///< that undrained columns may take to come to rest [s]

/// Points of a column of length L0 and height H0 in a stress of its weight, sigma_h = k sigma_v.
ParticleSet column(double length, double height, double cell, double density, double k) {
  ParticleSet p;
  fill(p, {0.0, 0.0, length, height}, 0.5 * cell, density);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double vertical = -density * kGravity * (height - p.position[q][1]);
    p.stress[q] = {k * vertical, vertical, k * vertical, 0.0, 0.0, 0.0};
  }
  return p;
}

FlowConfig against_wall(double cell, Transfer transfer, double friction) {
  FlowConfig config = free_space(cell);
  config.transfer = transfer;
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = friction;
  config.left_roller = 0.0;
  return config;
}

/// Height of the surface near x: that of the highest point within half a cell, plus half its size.
double surface_at(const Points<2>& p, double x, double cell) {
  double top = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q)
    if (std::abs(p.x[0][q] - x) < 0.5 * cell) top = std::max(top, p.x[1][q] + 0.25 * cell);
  return top;
}

/// The x beyond which `share` of the mass lies, plus half a point.
double front(const Points<2>& p, double cell, double share) {
  std::vector<Place> places;
  for (std::size_t q = 0; q < p.size(); ++q) places.push_back({p.x[0][q], p.mass[q]});
  double at = 0.0;
  places_beyond(places, {&share, 1}, {&at, 1});
  return at + 0.25 * cell;
}

/// Level above which 0.5 % of the mass lies, as the program reports it.
double top(const Points<2>& p) {
  std::vector<Place> places;
  for (std::size_t q = 0; q < p.size(); ++q) places.push_back({p.x[1][q], p.mass[q]});
  return height(places);
}

/// Where, seen from the front, the layer becomes `thickness` thick: volume in strips over their
/// width, with a straight line between their middles.
double end_of_layer(const Points<2>& p, double density, double thickness) {
  constexpr double width = 0.005;
  std::vector<double> layer(400, 0.0);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const auto strip = static_cast<std::size_t>(std::max(0.0, p.x[0][q]) / width);
    if (strip < layer.size()) layer[strip] += p.mass[q] / (density * width);
  }
  std::size_t last = layer.size() - 2;
  while (last > 0 && layer[last] < thickness) --last;
  const double over = layer[last] - thickness, drop = layer[last] - layer[last + 1];
  return width * (static_cast<double>(last) + 0.5 + (drop > 0.0 ? over / drop : 0.0));
}

// Of the bars: Bui et al. (2008).
constexpr double kBarsLength = 0.2, kBarsHeight = 0.1, kBarsDensity = 2650.0;
constexpr double kThinnest = 0.001, kThickest = 0.0015;
constexpr double kUntil = 0.8;  ///< 8 sqrt(height / g) [s]
using Line = std::array<double, 2>;
/// Free surface that the experiment left, digitised (x, y) [m].
constexpr std::array<Line, 11> kSurface{{{0.0, 0.0992},
                                         {0.06, 0.0890},
                                         {0.10, 0.0776},
                                         {0.14, 0.0665},
                                         {0.18, 0.0539},
                                         {0.22, 0.0425},
                                         {0.26, 0.0307},
                                         {0.30, 0.0215},
                                         {0.34, 0.0136},
                                         {0.38, 0.0079},
                                         {0.42, 0.0022}}};
/// Line between the bars that moved and those that did not, likewise.
constexpr std::array<Line, 5> kFailure{
    {{0.021, 0.0989}, {0.060, 0.0802}, {0.100, 0.0545}, {0.139, 0.0257}, {0.179, 0.0005}}};

MaterialSpec bars_of(const Bars& b) {
  constexpr double nu = 0.3, bulk = 0.7e6;
  const double angle = 19.8 * kPi / 180.0;
  std::map<std::string, double> values{{"youngs_modulus", 3.0 * bulk * (1.0 - 2.0 * nu)},
                                       {"poisson_ratio", nu}};
  if (b.law == Friction::rate) {
    values.merge(std::map<std::string, double>{{"mu_static", tan(angle)},
                                               {"mu_limit", tan(angle) + b.rise},
                                               {"inertial_number", b.inertial},
                                               {"grain_size", 0.5 * (kThinnest + kThickest)},
                                               {"grain_density", kBarsDensity}});
    return material("mu_i", values);
  }
  const double phi = b.law == Friction::coulomb_plane ? asin(tan(angle)) : angle;
  values.merge(std::map<std::string, double>{{"cohesion", 0.0}, {"friction_angle", phi}});
  return material("mohr_coulomb", values);
}

/// Rms distance of the failure line, over the height: at each measured height, the x of the
/// rearmost point within half a cell that moved sideways by more than a bar's thickness.
double failure_error(const Points<2>& p, const ParticleSet& start, double cell) {
  double sum = 0.0;
  for (const auto& [x, y] : kFailure) {
    double rear = kBarsLength;
    for (std::size_t q = 0; q < p.size(); ++q) {
      const auto& from = start.position[static_cast<std::size_t>(p.index[q])];
      const bool moved = p.x[0][q] - from[0] > kThickest;
      if (moved && std::abs(from[1] - y) < 0.5 * cell) rear = std::min(rear, from[0]);
    }
    sum += pow(rear - x, 2);
  }
  return std::sqrt(sum / kFailure.size()) / kBarsHeight;
}

MaterialSpec clay_of(double strength, double stiffness_ratio, double nu) {
  return material("residual_strength", {{"youngs_modulus", stiffness_ratio * strength},
                                        {"poisson_ratio", nu},
                                        {"strength", strength},
                                        {"soft_strength", strength},
                                        {"residual_strain", 0.0}});
}

}  // namespace

BarDeposit collapse(const Bars& bars) {
  constexpr double nu = 0.3;
  const double h = bars.cell;
  ParticleSet p = column(kBarsLength, kBarsHeight, h, kBarsDensity, nu / (1.0 - nu));
  p.materials = {bars_of(bars)};
  Trial trial(p, against_wall(h, bars.transfer, bars.ground));
  trial.run_to(kUntil);
  const Points<2>& end = trial.sim.points;
  double sum = 0.0;
  for (const auto& [x, y] : kSurface) sum += pow(surface_at(end, std::max(x, 0.5 * h), h) - y, 2);
  return {end_of_layer(end, kBarsDensity, kThickest),
          front(end, h, 0.005),
          surface_at(end, 0.5 * h, h),
          std::sqrt(sum / kSurface.size()) / kBarsHeight,
          failure_error(end, p, h),
          trial.balances().energy_error};
}

ClayDeposit collapse(const Clay& clay) {
  const double height = 1.0, length = height / clay.aspect, h = height / clay.cells;
  ParticleSet p = column(length, height, h, kSoil, 1.0);
  p.materials = {clay_of(clay.b * kSoil * kGravity * height, 100.0, 0.45)};
  FlowConfig config = against_wall(h, clay.transfer, kRough);
  config.damping = clay.damping;
  Trial trial(p, config);
  ClayDeposit d;
  for (double time = 1.0; time <= kLongestSlump; time += 1.0) {
    trial.run_to(time);
    const double now = front(trial.sim.points, h, 0.002) / length;
    const double advance = now - d.foremost;
    d.foremost = now;
    if (advance < 0.002) break;
  }
  d.front = front(trial.sim.points, h, 0.005) / length;
  d.height = top(trial.sim.points) / height;
  return d;
}

bool cut_stands(double b, int cells_in_height) {
  const double height = 1.0, h = height / cells_in_height;
  ParticleSet p = column(2.0 * height, height, h, kSoil, 1.0);
  p.materials = {clay_of(b * kSoil * kGravity * height, 1000.0, 0.45)};
  FlowConfig config = against_wall(h, Transfer::apic, kRough);
  config.damping = 0.5;
  Trial trial(p, config);
  const double start = 2.0 * height, enough = 0.05 * height;
  trial.run_to(1.5);
  const double halfway = front(trial.sim.points, h, 0.0) - start;
  if (halfway > enough) return false;
  trial.run_to(3.0);
  const double end = front(trial.sim.points, h, 0.0) - start;
  return end < enough && end - halfway < 0.2 * halfway;
}

}  // namespace flowslide::mpm
