#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

namespace {

double fastest(const Simulation<2>& s) { return std::sqrt(s.last.max_speed2); }

/// Mean stress of a column of height `height` in equilibrium, with the given weight [N/m3].
void set_at_rest(ParticleSet& p, double height, double weight) {
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double s = -weight * (height - p.position[q][1]);
    p.stress[q] = {s, s, s, 0.0, 0.0, 0.0};
  }
}

/// Measured period over that of a free bar, 2 L sqrt(rho / E), from zero crossings of the velocity
/// of its end.
double period_ratio(double cell) {
  const double length = 10.0, young = 1e6, density = 1000.0;
  ParticleSet p;
  p.materials = {elastic(young, 0.0)};
  add_lattice(p, {0.0, 0.0, length, 2.0 * cell}, 0.5 * cell, density);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.velocity[q][0] = 1e-3 * std::cos(kPi * p.position[q][0] / length);
  Run run(p, free_space(cell));
  const double period = 2.0 * length * std::sqrt(density / young);
  const auto end_velocity = [&] {
    const Points<2>& q = run.s.points;
    const auto end = std::min_element(q.x[0].begin(), q.x[0].end()) - q.x[0].begin();
    return q.v[0][end];
  };
  std::vector<double> crossings;
  double before = end_velocity();
  while (crossings.size() < 5) {
    run.step();
    const double now = end_velocity();
    if ((before > 0.0) != (now > 0.0))
      crossings.push_back(run.s.time - run.s.dt * now / (now - before));
    before = now;
  }
  return (crossings[4] - crossings[0]) / 2.0 / period;
}

}  // namespace

TEST_CASE("A column in equilibrium stays at rest", "[mpm]") {
  const double height = 5.0, density = 1800.0, g = 9.81, young = 20e6;
  const double nu = GENERATE(0.3, 0.49);
  ParticleSet p;
  p.materials = {elastic(young, nu)};
  add_lattice(p, {0.0, 0.0, 2.0, height}, 0.25, density);
  FlowConfig config = free_space(0.5);
  config.gravity = g;
  config.ground.surface = {{0.0, 0.0}};
  config.left_roller = 0.0;
  config.right_roller = 2.0;
  const auto largest_speed = [&](double weight) {
    set_at_rest(p, height, weight);
    Run run(p, config);
    double largest = 0.0;
    while (run.s.time < 0.5) {  // several times through the column for the slower of the two
      run.step();
      largest = std::max(largest, fastest(run.s));
    }
    return largest;
  };
  // Holding nodes at and below the ground instead gives 6e-3 (docs/theory/contact.md).
  CHECK(largest_speed(density * g) < 1e-3 * std::sqrt(g * height));
  CHECK(largest_speed(0.0) > 0.01 * std::sqrt(g * height));  // control: it falls into itself
}

TEST_CASE("A free elastic bar swings with its own period", "[mpm]") {
  const double coarse = std::abs(period_ratio(0.5) - 1.0),
               fine = std::abs(period_ratio(0.25) - 1.0);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.005);
  CHECK(fine < 0.7 * coarse);
}

TEST_CASE("Energy closes for a block that hits the ground", "[mpm]") {
  ParticleSet p;
  const bool soft = GENERATE(false, true);
  p.materials = {soft ? liquefied(2e6, 5e3) : elastic(20e6, 0.3)};
  add_lattice(p, {0.0, 0.5, 3.0, 3.5}, 0.25, 1800.0);
  FlowConfig config = free_space(0.5);
  config.gravity = 9.81;
  config.ground.surface = {{0.0, 0.0}};
  for (auto& v : p.velocity) v = {0.5, -2.0, 0.0};
  const auto run_with = [&](double courant) {
    config.courant = courant;
    Run run(p, config);
    double recoverable = 0.0;
    while (run.s.time < 1.0) {
      run.step();
      recoverable = std::max(recoverable, sum_points(run.s).recoverable);
    }
    CHECK(recoverable > 0.005 * run.start.start.kinetic);  // it did hit
    return run.sample_now();
  };
  const double mass = 9.0 * 1800.0, brought = mass * (0.5 * (0.25 + 4.0) + 9.81 * 0.5);
  // The residual against the energy that was there, as what is left of it at the end is small.
  const auto residual = [&](const MpmSample& r) {
    const double work = std::abs(r.strain_energy + r.plastic_work);
    return std::abs(r.energy_error) * std::max({std::abs(r.gravity_work), work, r.kinetic}) /
           brought;
  };
  const MpmSample end = run_with(0.8), fine = run_with(0.4);
  CAPTURE(soft);
  CHECK(residual(end) < 0.01);
  CHECK(residual(fine) < 0.01);
  CHECK(end.momentum_error < 1e-9);
  CHECK(end.mass_error < 1e-12);
  CHECK(end.friction_work > 0.0);
  CHECK(end.damping_work > 0.0);
  if (soft) CHECK(end.plastic_work > 0.0);
}

TEST_CASE("A block on a slope sticks or slides as Coulomb says", "[mpm]") {
  const double angle = 35.0 / 180.0 * kPi, g = 9.81, density = 2000.0, height = 1.0;
  const double mu = GENERATE(0.3, 0.5, 0.9);
  ParticleSet p;
  p.materials = {elastic(50e6, 0.2)};
  add_lattice(p, {0.0, 0.0, 5.0, height}, 0.25, density);
  set_at_rest(p, height, density * g * std::cos(angle));
  for (auto& s : p.stress) s[0] = s[2] = 0.2 * s[1];
  FlowConfig config = free_space(0.5);
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = mu;
  Run run(p, config);
  run.s.gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
  run.run_to(0.5);
  const PointSums<2> sums = sum_points(run.s);
  const double speed = sums.momentum[0] / sums.mass;
  const double expected = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle))) * run.s.time;
  CAPTURE(mu, speed, expected);
  CHECK(std::abs(speed - expected) < 0.01 * g * run.s.time);
}

TEST_CASE("Artificial damping takes energy out", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 4.0, 1.0}, 0.25, 1000.0);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.velocity[q][0] = 0.1 * std::cos(kPi * p.position[q][0] / 4.0);
  FlowConfig config = free_space(0.5);
  const auto kinetic_and_stored = [&](double damping) {
    config.damping = damping;
    Run run(p, config);
    run.run_to(0.5);
    const PointSums<2> sums = sum_points(run.s);
    return sums.kinetic + sums.recoverable;
  };
  CHECK(kinetic_and_stored(0.3) < 0.3 * kinetic_and_stored(0.0));
}

TEST_CASE("Damping does not push back what a wall stops", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 4.0, 2.0}, 0.25, 1000.0);
  FlowConfig config = free_space(0.5);
  config.ground.surface = {{-5.0, -0.5}, {9.0, 0.2}};
  config.ground.friction = 0.3;
  using L = NodeLayout<2>;
  const double dt = 1e-3;
  const auto hold = [&](double damping, GridWork<2>& work) {
    Run run(p, config);
    for (Node& node : run.s.grid.nodes) {
      node.q = {};
      node.q[L::mass] = 250.0;
      node.q[L::momentum] = 3.0;
      node.q[L::momentum + 1] = -2.0;
    }
    work = hold_at_walls(run.s.grid, run.s.contact, {dt, {0.0, 0.0, 0.0}, damping}, 250.0);
    std::vector<double> after;
    for (const std::int32_t n : run.s.contact.nodes)
      for (int d = 0; d < 2; ++d) after.push_back(run.s.grid.nodes[n].q[L::momentum + d]);
    return after;
  };
  GridWork<2> free_work, work;
  const std::vector<double> held = hold(0.0, free_work), damped = hold(0.7, work);
  double kinetic = 0.0;
  int stopped = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double before = i % 2 == 0 ? 3.0 : -2.0;
    CAPTURE(i, before, held[i], damped[i]);
    CHECK(damped[i] * held[i] >= 0.0);
    CHECK(std::abs(damped[i]) <= std::abs(held[i]));
    stopped += std::abs(held[i]) < 0.3 * std::abs(before);
    kinetic += 0.5 * 250.0 * (damped[i] * damped[i] - before * before);
  }
  CHECK(stopped > 5);
  CHECK(work.damping < 0.0);
  CHECK(work.damping + work.boundary == Approx(kinetic));
  CHECK(free_work.damping == 0.0);
}
