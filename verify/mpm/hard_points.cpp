#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <random>

/// Hard cases of the discretisation, each with a control: the same scene without the cure, which
/// must fail.
namespace flowslide::mpm {
namespace {

/// A body under uniform stress moves at constant speed over ten cells; the stress should not
/// notice. Root-mean-square change of the stress over its size. `points` per cell and direction are
/// not a whole number: a regular lattice would hide all noise.
double crossing_noise(BasisKind basis, double points) {
  constexpr double h = 0.25, stress = -1e4, density = 1000.0;
  ParticleSet p;
  p.materials = {elastic(1e6, 0.0)};
  fill(p, {0.0, 0.0, 8.0 * h, 4.0 * h}, h / points, density);
  for (std::size_t q = 0; q < p.size(); ++q) {
    p.stress[q][0] = stress;
    p.velocity[q][0] = 1.0;
  }
  FlowConfig config = free_space(h);
  config.basis = basis;
  PeriodicStrip strip(p, 8.0 * h, config);
  strip.run_to(10.0 * h);
  double sum = 0.0;
  const Points<2>& q = strip.trial.sim.points;
  strip.for_each([&](std::size_t i) { sum += pow(q.sigma[0][i] / stress - 1.0, 2); });
  return std::sqrt(sum / static_cast<double>(p.size()));
}

struct Ringing {
  double mode;       ///< kinetic energy of a point mode the grid cannot see, after over before
  double energy;     ///< of the bar, after over before
  double roughness;  ///< stress that alternates from point to point, over the stress of the wave
};

/// A bar that swings for long, and the same with velocities that alternate from point to point.
Ringing ring(Transfer transfer, int steps) {
  constexpr double h = 1.0, density = 1.0;
  ParticleSet p;
  p.materials = {elastic(100.0, 0.0)};
  fill(p, {0.0, 0.0, 8.0, 2.0}, 0.5 * h, density);
  FlowConfig config = free_space(h);
  config.left_roller = 0.0;
  config.transfer = transfer;
  config.flip_share = 1.0;
  const auto checker = [&](std::size_t i) {
    const auto column = static_cast<int>(std::floor(p.position[i][0] / (0.5 * h)));
    const auto row = static_cast<int>(std::floor(p.position[i][1] / (0.5 * h)));
    return (column + row) % 2 ? -1.0 : 1.0;
  };
  Ringing r{};
  {
    for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = {1e-3 * checker(i), 0.0, 0.0};
    Trial trial(p, config);
    const double start = sum_points(trial.sim).kinetic;
    for (int i = 0; i < 1000; ++i) trial.step();
    r.mode = sum_points(trial.sim).kinetic / start;
  }
  const double beta = kPi / 16.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = {0.01 * sin(beta * p.position[i][0]), 0.0, 0.0};
  Trial trial(p, config);
  const PointSums<2> start = sum_points(trial.sim);
  double largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    trial.step();
    if (i % 1000 == 999) {
      const PointSums<2> now = sum_points(trial.sim);
      largest = std::max(largest, now.kinetic + now.recoverable);
    }
  }
  r.energy = largest / start.kinetic;
  double alternating = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto at = static_cast<std::size_t>(trial.sim.points.index[i]);
    alternating += checker(at) * trial.sim.points.sigma[0][i] / static_cast<double>(p.size());
  }
  const double wave = 0.01 * std::sqrt(100.0 * density);
  r.roughness = std::abs(alternating) / wave;
  return r;
}

/// Sparse points at random places vibrate by so little that they stay where they are: kinetic and
/// stored energy after over before. The step is that of the quadratic basis.
double sparse_growth(BasisKind basis) {
  constexpr double h = 1.0;
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  fill(p, {0.0, 0.0, 16.0, 16.0}, h, 1000.0);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(0.0, 16.0), speed(-1e-9, 1e-9);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] = {place(random), place(random), 0.0};
    p.velocity[i] = {speed(random), speed(random), 0.0};
  }
  FlowConfig config = free_space(h);
  config.transfer = Transfer::flip;
  config.flip_share = 1.0;
  const double dt = Trial(p, config).next_dt();
  config.basis = basis;
  Trial trial(p, config);
  trial.sim.settings.courant *= dt / trial.next_dt();
  const double start = trial.reference.start.kinetic;
  for (int i = 0; i < 5000; ++i) {
    trial.step();
    const PointSums<2> now = sum_points(trial.sim);
    if (!(now.kinetic + now.recoverable < 1e6 * start)) return 1e6;
  }
  const PointSums<2> now = sum_points(trial.sim);
  return (now.kinetic + now.recoverable) / start;
}

/// A bar is pulled between two heavy grips: the stretch at which the smallest axial stress of its
/// middle half first falls below a tenth of the largest. `points` per cell and direction.
double stretch_to_fracture(BasisKind basis, int points) {
  constexpr double h = 0.25, length = 2.0, density = 1000.0, heavy = 1e6, speed = 0.5;
  const double spacing = h / points;
  ParticleSet p;
  // The grips are a material of their own, as debris is told by the density of its material.
  p.materials.assign(2, material("neo_hookean", {{"youngs_modulus", 1e6}, {"poisson_ratio", 0.3}}));
  p.materials[1].name = "grip";
  fill(p, {-3.0 * h, -h, 0.0, 3.0 * h}, spacing, heavy * density, 1);
  const std::size_t left = p.size();
  fill(p, {length, -h, length + 3.0 * h, 3.0 * h}, spacing, heavy * density, 1);
  const std::size_t right = p.size();
  fill(p, {0.0, 0.0, length, 2.0 * h}, spacing, density);
  FlowConfig config = free_space(h);
  config.basis = basis;
  Trial trial(p, config);
  Points<2>& q = trial.sim.points;
  double stretch = 1.0;
  while (stretch < 4.5) {
    trial.step();
    stretch = 1.0 + speed * trial.sim.time / length;
    double low = 1e300, high = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const auto start = static_cast<std::size_t>(q.index[i]);
      if (start < right) {
        const bool moves = start >= left;
        q.x[0][i] = p.position[start][0] + (moves ? speed * trial.sim.time : 0.0);
        q.x[1][i] = p.position[start][1];
        q.v[0][i] = moves ? speed : 0.0;
        q.v[1][i] = 0.0;
        for (auto& c : q.c) c[i] = 0.0;
        for (auto& s : q.sigma) s[i] = 0.0;
      } else if (std::abs(p.position[start][0] - 0.5 * length) < 0.25 * length) {
        low = std::min(low, q.sigma[0][i]);
        high = std::max(high, q.sigma[0][i]);
      }
    }
    if (stretch > 1.2 && low < 0.1 * high) return stretch;
  }
  return stretch;
}

}  // namespace

std::vector<Check> verify_crossing(std::string_view name) {
  CheckList checks(name);
  // The noise of the quadrature falls with the square of the points for the quadratic basis.
  checks.error("noise_cubic_2.5_points", crossing_noise(BasisKind::cubic, 2.5), 0.01);
  checks.error("noise_quadratic_8.5_points", crossing_noise(BasisKind::quadratic, 8.5), 0.01);
  checks.at_least("control_linear_2.5_points", crossing_noise(BasisKind::linear, 2.5), 0.2);
  checks.at_least("control_linear_8.5_points", crossing_noise(BasisKind::linear, 8.5), 0.2);
  return checks.take();
}

std::vector<Check> verify_ringing(std::string_view name) {
  CheckList checks(name);
  const Ringing apic = ring(Transfer::apic, 1000000);
  checks.error("mode_left_apic", apic.mode, 1e-3);
  checks.at_most("energy_apic", apic.energy, 1.0 + 1e-3);
  checks.error("roughness_apic", apic.roughness, 0.01);
  const Ringing flip = ring(Transfer::flip, 20000);
  checks.at_least("control_mode_left_flip", flip.mode, 0.5);
  return checks.take();
}

std::vector<Check> verify_sparse(std::string_view name) {
  CheckList checks(name);
  checks.at_most("growth_quadratic", sparse_growth(BasisKind::quadratic), 1.1);
  checks.at_least("control_linear", sparse_growth(BasisKind::linear), 10.0);
  return checks.take();
}

std::vector<Check> verify_stretch(std::string_view name) {
  CheckList checks(name);
  checks.at_least("whole_8_points", stretch_to_fracture(BasisKind::quadratic, 8), 4.0);
  checks.at_least("whole_cubic_6_points", stretch_to_fracture(BasisKind::cubic, 6), 4.0);
  checks.at_most("control_2_points", stretch_to_fracture(BasisKind::quadratic, 2), 3.0);
  checks.at_most("control_linear", stretch_to_fracture(BasisKind::linear, 2), 3.0);
  return checks.take();
}

}  // namespace flowslide::mpm
