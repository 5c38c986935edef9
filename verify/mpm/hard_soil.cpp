#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>

/// Hard cases of soil in motion, most with a control that must fail.
namespace flowslide::mpm {
namespace {

FlowConfig on_ground(double cell, double friction) {
  FlowConfig config = free_space(cell);
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = friction;
  return config;
}

MaterialSpec weak_soil(double strength, double young) {
  return material("residual_strength", {{"youngs_modulus", young},
                                        {"poisson_ratio", 0.49},
                                        {"strength", strength},
                                        {"soft_strength", strength},
                                        {"residual_strain", 0.0}});
}

double volume_of(const Trial& trial) {
  double sum = 0.0;
  for (const double v : trial.sim.points.volume) sum += v;
  return sum;
}

/// A bar of soil without tensile strength is torn apart five times by a velocity that grows with x
/// and closed again by the opposite one: mean pressure at the end over the bulk modulus. It is
/// nothing but what bulking makes of it. Without memory of the gap the soil jams.
double jammed_pressure(bool remember) {
  constexpr double h = 0.25, length = 4.0, rate = 0.5;
  ParticleSet p;
  p.materials = {weak_soil(1e3, 1e6)};
  fill(p, {0.0, 0.0, length, 4.0 * h}, 0.5 * h, 2000.0);
  Trial trial(p, free_space(h));
  Points<2>& q = trial.sim.points;
  const double bulk = trial.sim.materials.front().elastic.bulk;
  for (int cycle = 0; cycle < 10; ++cycle) {
    const double sign = cycle % 2 ? -1.0 : 1.0, start = trial.sim.time;
    while (trial.sim.time < start + 0.2) {
      for (std::size_t i = 0; i < q.size(); ++i) {
        // The field that takes every point back to where it was.
        const double x0 = p.position[static_cast<std::size_t>(q.index[i])][0];
        q.v[0][i] = sign * rate * x0;
        q.v[1][i] = 0.0;
        const double stretch = q.x[0][i] > 0.0 ? q.x[0][i] / x0 : 1.0;
        q.c[0][i] = sign * rate / stretch;
        for (const int k : {1, 2, 3}) q.c[k][i] = 0.0;
        if (!remember) q.state[1][i] = 0.0;
      }
      trial.step();
    }
  }
  double mean = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i)
    mean -= (q.sigma[0][i] + q.sigma[1][i] + q.sigma[2][i]) / 3.0;
  return mean / static_cast<double>(q.size()) / bulk;
}

struct Collapse {
  double volume;        ///< change of the total volume over the volume
  double front_speed;   ///< over the limit 2 sqrt(g H) of a dam break
  double energy_error;  ///< residual of the balance
  double scatter;       ///< change of a point's volume, rms
};

/// A column with hardly any strength.
Collapse collapse(double strength, VolumeAverage average) {
  constexpr double h = 0.1, height = 1.0;
  ParticleSet p;
  p.materials = {weak_soil(strength, 2e5)};
  fill(p, {0.0, 0.0, 1.0, height}, 0.5 * h, 2000.0);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double s = -2000.0 * kGravity * (height - p.position[q][1]);
    p.stress[q] = {s, s, s, 0.0, 0.0, 0.0};
  }
  FlowConfig config = on_ground(h, 0.0);
  config.left_roller = 0.0;
  config.volume_average = average;
  Trial trial(p, config);
  const double start = volume_of(trial);
  trial.run_to(1.0);
  const Points<2>& q = trial.sim.points;
  double front = 0.0, scatter = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    front = std::max(front, q.x[0][i]);
    const auto at = static_cast<std::size_t>(q.index[i]);
    scatter += pow(q.volume[i] / p.volume[at] - 1.0, 2) / static_cast<double>(q.size());
  }
  return {volume_of(trial) / start - 1.0,
          (front - 1.0) / trial.sim.time / (2.0 * std::sqrt(kGravity * height)),
          trial.balances().energy_error, std::sqrt(scatter)};
}

/// Layers a thousand times stiffer than those between them, under weight: largest speed at the end
/// over sqrt(g H); infinite when it fails. `courant` 1 is the bound of the stiff layers.
double layered_speed(double courant) {
  constexpr double h = 0.25, height = 4.0;
  ParticleSet p;
  p.materials = {elastic(1e9, 0.3), elastic(1e6, 0.3)};
  p.materials[1].name = "soft";
  for (int layer = 0; layer < 4; ++layer)
    fill(p, {0.0, 1.0 * layer, 1.0, 1.0 + layer}, 0.5 * h, 2000.0, layer % 2);
  FlowConfig config = on_ground(h, 0.5);
  config.left_roller = 0.0;
  config.right_roller = 1.0;
  Trial trial(p, config);
  trial.sim.settings.courant = courant;
  try {
    for (int i = 0; i < 40000 && trial.sim.time < 2.0; ++i) {
      trial.step();
      trial.damp(10.0);
    }
  } catch (const NumericsError&) {
    return 1e30;
  }
  return std::sqrt(trial.sim.last.max_speed2) / std::sqrt(kGravity * height);
}

struct Hit {
  bool finished;
  double energy_error, smallest_volume;
};

/// A soft block hits the ground at a quarter of its speed of sound.
Hit impact(double courant) {
  constexpr double h = 0.1;
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  fill(p, {0.0, 0.1, 1.0, 1.1}, 0.5 * h, 2000.0);
  for (auto& v : p.velocity) v = {1.0, -7.0, 0.0};
  Trial trial(p, on_ground(h, 0.3));
  trial.sim.settings.courant = courant;
  if (courant > 1.0) trial.sim.settings.velocity_limit = trial.sim.settings.strain_limit = 100.0;
  double smallest = 1e30;
  try {
    while (trial.sim.time < 0.5) {
      trial.step();
      for (const double v : trial.sim.points.volume)
        smallest = std::min(smallest, v / (0.25 * h * h));
      if (!(smallest > 1e-6)) return {false, 0.0, smallest};
    }
  } catch (const NumericsError&) {
    return {false, 0.0, smallest};
  }
  return {true, trial.balances().energy_error, smallest};
}

struct Corner {
  double below;  ///< deepest point below the ground [cells]
  double speed;  ///< fastest point at the end over that of the fall
};

/// A soft block falls into a notch whose two walls stand at 45 degrees and rub.
Corner notch() {
  constexpr double h = 0.1;
  ParticleSet p;
  p.materials = {material("mohr_coulomb", {{"youngs_modulus", 2e6},
                                           {"poisson_ratio", 0.3},
                                           {"cohesion", 1e3},
                                           {"friction_angle", 0.5}})};
  fill(p, {-0.5, 1.2, 0.5, 2.2}, 0.5 * h, 2000.0);
  FlowConfig config = on_ground(h, 0.5);
  config.ground.surface = {{-5.0, 5.0}, {0.0, 0.0}, {5.0, 5.0}};
  Trial trial(p, config);
  trial.run_to(4.0);
  const Points<2>& q = trial.sim.points;
  Corner c{0.0, std::sqrt(trial.sim.last.max_speed2) / std::sqrt(2.0 * kGravity)};
  for (std::size_t i = 0; i < q.size(); ++i)
    c.below = std::max(c.below, (std::abs(q.x[0][i]) - q.x[1][i]) / h / std::sqrt(2.0));
  return c;
}

}  // namespace

std::vector<Check> verify_rejoin(std::string_view name) {
  CheckList checks(name);
  checks.error("pressure_after_cycles", jammed_pressure(true), 1e-3);
  // Jammed soil throws points about, and the step may refuse to follow: that is a failure too.
  const auto without_gap = [] {
    try {
      return jammed_pressure(false);
    } catch (const NumericsError&) {
      return 1e30;
    }
  };
  checks.at_least("control_without_gap", without_gap(), 1e-2);
  return checks.take();
}

std::vector<Check> verify_weak(std::string_view name) {
  CheckList checks(name);
  for (const double strength : {100.0, 1.0}) {
    const Collapse c = collapse(strength, VolumeAverage::automatic);
    checks.error(fmt::format("volume_{:g}_pa", strength), c.volume, 0.05);
    checks.at_most(fmt::format("front_speed_{:g}_pa", strength), c.front_speed, 1.05);
    checks.error(fmt::format("energy_balance_{:g}_pa", strength), c.energy_error, 0.01);
  }
  return checks.take();
}

std::vector<Check> verify_contrast(std::string_view name) {
  CheckList checks(name);
  checks.at_most("speed_after_settling", layered_speed(0.9), 1e-3);
  // The bound on acceleration keeps it from flying apart, but it does not come to rest.
  checks.at_least("control_soft_step", layered_speed(25.0), 1e-2);
  return checks.take();
}

std::vector<Check> verify_hit(std::string_view name) {
  CheckList checks(name);
  const Hit hit = impact(0.9);
  checks.holds("finished", hit.finished);
  checks.error("energy_balance", hit.energy_error, 0.01);
  checks.at_least("smallest_volume", hit.smallest_volume, 0.01);
  checks.holds("control_three_times_the_step_fails", !impact(3.0).finished);
  return checks.take();
}

std::vector<Check> verify_corner(std::string_view name) {
  CheckList checks(name);
  const Corner c = notch();
  checks.at_most("deepest_below_ground", c.below, 0.5, "cells");
  checks.error("speed_at_end", c.speed, 0.01);
  return checks.take();
}

}  // namespace flowslide::mpm
