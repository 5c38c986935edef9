#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>

/// V7: a cantilever of 4 m x 1 m bends under gravity that is switched on at once. The deflection of
/// its lower corner is known from large-deformation finite elements: -3.28 m at 1.06 s, back at
/// 2.60 s.
namespace flowslide::mpm {
namespace {

struct Bending {
  double lowest, time_lowest;  ///< of the tip's displacement [m], [s]
  double time_back;            ///< when it turns again near the start [s]
  double highest_back;         ///< displacement there [m]
};

/// The clamp is a block whose points are a million times as heavy and are put back after each step,
/// so that the nodes they reach stand still. `points` per cell and direction: the upper fibre at
/// the clamp is stretched to more than twice its length, where two would part.
Bending bend(double h, int points) {
  constexpr double length = 4.0, depth = 1.0, density = 1050.0, heavy = 1e6;
  ParticleSet p;
  // The clamp is a material of its own, as debris is told by the density of its material.
  p.materials.assign(2, material("neo_hookean", {{"youngs_modulus", 1e6}, {"poisson_ratio", 0.3}}));
  p.materials[1].name = "clamp";
  const double spacing = h / points;
  fill(p, {-2.0 * h, 0.0, 0.0, depth}, spacing, heavy * density, 1);
  const std::size_t clamped = p.size();
  fill(p, {0.0, 0.0, length, depth}, spacing, density);
  FlowConfig config = free_space(h);
  config.gravity = 10.0;
  Trial trial(p, config);
  Points<2>& q = trial.sim.points;
  Bending r{0.0, 0.0, 0.0, -1e30};
  while (trial.sim.time < 3.2) {
    trial.step();
    double tip = 0.0, count = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const auto start = static_cast<std::size_t>(q.index[i]);
      if (start < clamped) {
        for (int d = 0; d < 2; ++d) {
          q.x[d][i] = p.position[start][d];
          q.v[d][i] = 0.0;
        }
        for (auto& c : q.c) c[i] = 0.0;
        for (auto& s : q.sigma) s[i] = 0.0;
      } else if (p.position[start][0] > length - spacing && p.position[start][1] < spacing) {
        tip += q.x[1][i] - p.position[start][1];
        count += 1.0;
      }
    }
    tip /= count;
    if (tip < r.lowest) {
      r.lowest = tip;
      r.time_lowest = trial.sim.time;
    }
    if (trial.sim.time > 1.8 && tip > r.highest_back) {
      r.highest_back = tip;
      r.time_back = trial.sim.time;
    }
  }
  return r;
}

}  // namespace

std::vector<Check> verify_cantilever(std::string_view name) {
  CheckList checks(name);
  const Bending r = bend(0.125, 4);
  checks.near("tip_lowest", r.lowest, -3.28, 0.03 * 3.28, "m");
  checks.near("time_lowest", r.time_lowest, 1.06, 0.02 * 2.6, "s");
  checks.near("time_back", r.time_back, 2.60, 0.01 * 2.60, "s");
  checks.near("tip_back", r.highest_back, 0.01, 0.03 * 3.28, "m");
  checks.at_most("control_2_points_part", bend(0.125, 2).highest_back, -0.5, "m");
  return checks.take();
}

}  // namespace flowslide::mpm
