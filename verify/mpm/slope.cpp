#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>

/// Slope of Griffiths & Lane (1999), example 1: 2:1, phi = 20 deg, c / (gamma H) = 0.05 on a rigid
/// base at the toe. With strengths divided by F it stands up to F = 1.38 (Bishop) to 1.4.
namespace flowslide::mpm {
namespace {

/// Largest displacement some time after gravity is on, with strengths divided by `factor` [m].
double displacement(double factor, double h) {
  constexpr double height = 10.0, density = 2000.0, crest = 12.0;
  const double c = 0.05 * density * kGravity * height, phi = 20.0 * kPi / 180.0;
  ParticleSet p;
  p.materials = {material("mohr_coulomb", {{"youngs_modulus", 100e6},
                                           {"poisson_ratio", 0.3},
                                           {"cohesion", c / factor},
                                           {"friction_angle", std::atan(tan(phi) / factor)},
                                           {"tension_cutoff", 0.0}})};
  fill(p, {0.0, 0.0, crest + 2.0 * height, height}, 0.5 * h, density, 0,
       [&](double x, double y) { return y < height - 0.5 * (x - crest); });
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double top = std::min(height, height - 0.5 * (p.position[q][0] - crest));
    const double vertical = -density * kGravity * (top - p.position[q][1]);
    p.stress[q] = {0.6 * vertical, vertical, 0.6 * vertical, 0.0, 0.0, 0.0};
  }
  FlowConfig config = free_space(h);
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = 1e6;
  config.left_roller = 0.0;
  config.damping = 0.3;
  Trial trial(p, config);
  trial.run_to(6.0);
  double largest = 0.0;
  const Points<2>& q = trial.sim.points;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto start = static_cast<std::size_t>(q.index[i]);
    largest = std::max(largest,
                       hypot(q.x[0][i] - p.position[start][0], q.x[1][i] - p.position[start][1]));
  }
  return largest;
}

}  // namespace

std::vector<Check> verify_slope(std::string_view name) {
  CheckList checks(name);
  constexpr double h = 0.5, moved = 0.1;  // a hundredth of the height
  checks.at_most("displacement_f1.30", displacement(1.30, h), moved, "m");
  checks.at_most("displacement_f1.35", displacement(1.35, h), moved, "m");
  checks.at_least("displacement_f1.45", displacement(1.45, h), moved, "m");
  return checks.take();
}

}  // namespace flowslide::mpm
