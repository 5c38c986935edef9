#include "mpm/kernels/rotation.hpp"

#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// V14: rigid rotation by a full turn, anywhere on the grid.
namespace flowslide::mpm {
namespace {

/// Angular momentum about the origin, the affine field included.
double angular_momentum(const Simulation<2>& s) {
  const Points<2>& p = s.points;
  const double affine = 0.25 * s.grid.h * s.grid.h;
  double sum = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q)
    sum += p.mass[q] *
           (p.x[0][q] * p.v[1][q] - p.x[1][q] * p.v[0][q] + affine * (p.c[2][q] - p.c[1][q]));
  return sum;
}

ParticleSet disc(double radius, double spacing, double density, double rate) {
  ParticleSet p;
  fill(p, {-radius, -radius, radius, radius}, spacing, density, 0,
       [&](double x, double y) { return hypot(x, y) < radius; });
  for (std::size_t q = 0; q < p.size(); ++q)
    p.velocity[q] = {-rate * p.position[q][1], rate * p.position[q][0], 0.0};
  return p;
}

/// An elastic disc spins freely: largest change of angular momentum over its amount.
double spin_free(const std::array<double, 2>& offset) {
  const double h = 0.1, rate = 2.0 * kPi;
  ParticleSet p = disc(1.0, 0.5 * h, 1000.0, rate);
  p.materials = {elastic(1e6, 0.3)};
  FlowConfig config = free_space(h);
  config.grid_origin = offset;
  Trial trial(p, config);
  for (double& c : trial.sim.points.c[1]) c = -rate;
  for (double& c : trial.sim.points.c[2]) c = rate;
  const double start = angular_momentum(trial.sim);
  double change = 0.0;
  while (trial.sim.time < 1.0) {
    trial.step();
    change = std::max(change, std::abs(angular_momentum(trial.sim) - start));
  }
  return change / std::abs(start);
}

/// Points without stiffness are held on their circles by a central body force and carry a stress
/// too small to matter: its largest error after one turn, over its size.
double carried_stress_error() {
  const double h = 0.1, rate = 2.0 * kPi;
  ParticleSet p = disc(1.0, 0.5 * h, 1000.0, rate);
  p.materials = {elastic(1e-14, 0.0)};
  const std::array<double, 6> stress{1e-9, -2e-9, 5e-10, 7e-10, 0.0, 0.0};
  for (auto& s : p.stress) s = stress;
  FlowConfig config = free_space(h);
  config.velocity_limit = 0.1;
  config.strain_limit = 0.2;
  Trial trial(p, config);
  Points<2>& q = trial.sim.points;
  for (double& c : q.c[1]) c = -rate;
  for (double& c : q.c[2]) c = rate;
  double turned = 0.0;
  while (turned < 2.0 * kPi) {
    trial.accelerate([&](std::size_t i) {
      return std::array{-rate * rate * q.x[0][i], -rate * rate * q.x[1][i]};
    });
    trial.step();
    turned += rate * trial.sim.dt;
  }
  // The turn that the last step went beyond a full one.
  const Stress<2> exact = rotate(Stress<2>{{stress[0], stress[1], stress[2], stress[3]}},
                                 2.0 * tan(0.5 * (turned - 2.0 * kPi)));
  double error = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i)
    for (int k = 0; k < 4; ++k) error = std::max(error, std::abs(q.sigma[k][i] - exact[k]));
  return error / 2e-9;
}

/// The rotation of the stress update by itself, a full turn in equal steps.
double turned_stress_error(int steps) {
  const Stress<2> start{{1.0, -2.0, 0.5, 0.7}};
  Stress<2> s = start;
  for (int i = 0; i < steps; ++i) s = rotate(s, 2.0 * kPi / steps);
  double error = 0.0;
  for (int k = 0; k < 4; ++k) error = std::max(error, std::abs(s[k] - start[k]));
  return error;
}

}  // namespace

std::vector<Check> verify_rotation(std::string_view name) {
  CheckList checks(name);
  checks.error("angular_momentum", spin_free({0.0, 0.0}), 1e-12);
  checks.error("angular_momentum_offset", spin_free({0.0371, 0.0129}), 1e-12);
  checks.error("stress_after_turn", carried_stress_error(), 0.01);
  checks.at_least("rotation_order_in_dt",
                  std::log2(turned_stress_error(50) / turned_stress_error(100)), 1.9);
  return checks.take();
}

}  // namespace flowslide::mpm
