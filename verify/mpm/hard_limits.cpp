#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// Hard cases at the limits: soil without volume change, points that leave.
namespace flowslide::mpm {
namespace {

/// A free beam swings in its first bending mode: its frequency over that of theory, with nu =
/// 0.4999 and four cells over its depth. In plane strain E' = E / (1 - nu^2) and nu' = nu / (1 -
/// nu); shear and rotatory inertia by the correction of Pickett (1945) as in ASTM E1876.
double bending_frequency(BasisKind basis, VolumeAverage average) {
  constexpr double length = 8.0, depth = 1.0, h = 0.25, density = 1000.0, young = 1e6, nu = 0.4999;
  constexpr double k = 4.7300407, sigma = 0.9825022;  // first root of cos(k) cosh(k) = 1
  const double beta = k / length;
  const auto shape = [&](double x) {
    return std::cosh(beta * x) + cos(beta * x) - sigma * (std::sinh(beta * x) + sin(beta * x));
  };
  const auto slope = [&](double x) {
    return beta *
           (std::sinh(beta * x) - sin(beta * x) - sigma * (std::cosh(beta * x) + cos(beta * x)));
  };
  ParticleSet p;
  p.materials = {elastic(young, nu)};
  fill(p, {0.0, 0.0, length, depth}, 0.5 * h, density);
  std::vector<double> mode;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = p.position[i][0], y = p.position[i][1] - 0.5 * depth;
    mode.push_back(shape(x));
    p.velocity[i] = {-1e-4 * y * slope(x), 1e-4 * mode.back(), 0.0};
  }
  FlowConfig config = free_space(h);
  config.basis = basis;
  config.volume_average = average;
  Trial trial(p, config);
  const Points<2>& q = trial.sim.points;
  const auto amplitude = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i)
      sum += q.mass[i] * q.v[1][i] * mode[static_cast<std::size_t>(q.index[i])];
    return sum;
  };
  const double ratio = depth / length, r2 = ratio * ratio, r4 = r2 * r2, n = nu / (1.0 - nu);
  const double correction = 1.0 + 6.585 * (1.0 + 0.0752 * n + 0.8109 * n * n) * r2 - 0.868 * r4 -
                            8.340 * (1.0 + 0.2023 * n + 2.173 * n * n) * r4 /
                                (1.0 + 6.338 * (1.0 + 0.1408 * n + 1.536 * n * n) * r2);
  const double exact = k * k / (2.0 * kPi * length * length) *
                       std::sqrt(young / (1.0 - nu * nu) * depth * depth / (12.0 * density)) /
                       std::sqrt(correction);
  // From the first to the third passage through no velocity: a period.
  double before = amplitude(), first = 0.0;
  for (int seen = 0; trial.sim.time < 3.0 / exact;) {
    trial.step();
    const double now = amplitude();
    if ((before > 0.0) != (now > 0.0)) {
      const double at = trial.sim.time - trial.sim.dt * now / (now - before);
      if (seen == 0) first = at;
      if (++seen == 3) return 1.0 / (at - first) / exact;
    }
    before = now;
  }
  return 0.0;
}

/// Sand without cohesion flies apart, until every point is alone: largest volume at `end` [s] over
/// that of free flight, which is a power of time. The cure needs the density at which a point
/// counts as debris.
double burst(bool cured, double end) {
  constexpr double h = 0.5, along = 300.0, across = 50.0;  // rates [1/s]
  ParticleSet p;
  p.materials = {material("mohr_coulomb", {{"youngs_modulus", 1e6},
                                           {"poisson_ratio", 0.3},
                                           {"cohesion", 0.0},
                                           {"friction_angle", 0.5}})};
  fill(p, {-0.5, -0.5, 0.5, 0.5}, 0.5 * h, 2000.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = {along * p.position[i][0], across * p.position[i][1], 0.0};
  Trial trial(p, free_space(h));
  if (!cured) trial.sim.largest_density.assign(1, 0.0);
  trial.run_to(end);
  double largest = 0.0;
  const double free_flight = (1.0 + along * end) * (1.0 + across * end) * 0.25 * h * h;
  for (const double v : trial.sim.points.volume) largest = std::max(largest, v / free_flight);
  return largest;
}

struct Drain {
  MpmSample kept, forgotten;  ///< balances with and without what left
};

/// A column of soft soil collapses; what passes an edge beside it leaves.
Drain drain() {
  constexpr double h = 0.5;
  ParticleSet p;
  p.materials = {material("residual_strength", {{"youngs_modulus", 1e6},
                                                {"poisson_ratio", 0.49},
                                                {"strength", 500.0},
                                                {"soft_strength", 250.0}})};
  fill(p, {0.0, 0.0, 2.0, 4.0}, 0.5 * h, 1800.0);
  FlowConfig config = free_space(h);
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.left_roller = 0.0;
  config.outlet.right = 3.5;
  Trial trial(p, config);
  trial.run_to(1.5);
  Drain d{trial.balances(), {}};
  visit_arrays(trial.sim.gone, [](auto& array) { array.clear(); });
  d.forgotten = trial.balances();
  return d;
}

/// The message about a point that leaves for where the grid cannot number its blocks.
std::string message_of_escape() {
  constexpr double h = 0.5;
  ParticleSet p;
  p.materials = {elastic(1.0, 0.3)};
  fill(p, {0.0, 0.0, 2.0, 2.0}, 0.5 * h, 2000.0);
  Trial trial(p, free_space(h));
  trial.sim.points.x[0].front() = 1e12;
  try {
    trial.rebin();
  } catch (const NumericsError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

std::vector<Check> verify_locking(std::string_view name) {
  CheckList checks(name);
  const auto off = VolumeAverage::off, on = VolumeAverage::automatic;
  checks.near("frequency_linear", bending_frequency(BasisKind::linear, on), 1.0, 0.05);
  checks.near("frequency_quadratic", bending_frequency(BasisKind::quadratic, on), 1.0, 0.05);
  checks.at_least("control_linear_without_average", bending_frequency(BasisKind::linear, off), 1.2);
  return checks.take();
}

std::vector<Check> verify_leaving(std::string_view name) {
  CheckList checks(name);
  const Drain d = drain();
  checks.at_least("points_left_by_outlet", d.kept.points_left, 10.0);
  checks.error("mass_with_outlet", d.kept.mass_error, 1e-13);
  checks.error("momentum_with_outlet", d.kept.momentum_error, 1e-9);
  checks.error("energy_with_outlet", d.kept.energy_error, 0.01);
  checks.at_least("control_mass_forgotten", d.forgotten.mass_error, 0.05);
  checks.at_most("burst_volume_over_free_flight", burst(true, 0.3), 4.0);
  checks.at_least("control_burst_volume", burst(false, 0.15), 100.0);
  checks.holds("escape_names_the_point", message_of_escape().find("particle") != std::string::npos);
  return checks.take();
}

}  // namespace flowslide::mpm
