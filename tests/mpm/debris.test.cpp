#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

namespace {

constexpr double kCell = 0.5, kRateX = 300.0, kRateY = 50.0;

/// Soil without cohesion that flies apart with a uniform velocity gradient.
ParticleSet burst() {
  ParticleSet p;
  p.materials = {{"sand",
                  "mohr_coulomb",
                  {{"youngs_modulus", 1e6},
                   {"poisson_ratio", 0.3},
                   {"cohesion", 0.0},
                   {"friction_angle", 0.5}},
                  true}};
  add_lattice(p, {-0.5, -0.5, 0.5, 0.5}, 0.5 * kCell, 2000.0);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.velocity[q] = {kRateX * p.position[q][0], kRateY * p.position[q][1], 0.0};
  return p;
}

struct Flight {
  double largest_open = 0.0;  ///< volume over that at the start
  double momentum = 0.0;      ///< largest component [N s]
  double angular = 0.0;       ///< angular momentum with the affine part [N m s]
  double energy_error = 0.0;
};

double angular_momentum(const Simulation<2>& s) {
  const Points<2>& p = s.points;
  double sum = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q)
    sum += p.mass[q] * (p.x[0][q] * p.v[1][q] - p.x[1][q] * p.v[0][q] +
                        0.25 * s.grid.h * s.grid.h * (p.c[2][q] - p.c[1][q]));
  return sum;
}

Flight fly(Transfer transfer, bool cured, double end, double spin = 0.0) {
  ParticleSet p = burst();
  for (std::size_t q = 0; q < p.size(); ++q) {
    p.velocity[q][0] -= spin * p.position[q][1];
    p.velocity[q][1] += spin * p.position[q][0];
  }
  FlowConfig c = free_space(kCell);
  c.transfer = transfer;
  Run run(p, c);
  if (!cured) run.s.largest_density.assign(1, 0.0);
  const double angular = angular_momentum(run.s);
  Flight f;
  run.run_to(end);
  for (const double v : run.s.points.volume)
    f.largest_open = std::max(f.largest_open, v / (0.25 * kCell * kCell));
  const PointSums<2> sums = sum_points(run.s);
  f.momentum = std::max(std::abs(sums.momentum[0]), std::abs(sums.momentum[1]));
  f.angular = angular_momentum(run.s) - angular;
  f.energy_error = run.sample_now().energy_error;
  return f;
}

}  // namespace

/// Volume of points without stress over that at the start: they fly straight, F = I + G t for a
/// velocity gradient G at the start.
double free_flight(double t) { return (1.0 + t * kRateX) * (1.0 + t * kRateY); }

TEST_CASE("Points that part for ever do not grow for ever", "[mpm]") {
  const auto transfer = GENERATE(Transfer::apic, Transfer::tpic, Transfer::aflip);
  const double end = 0.3, early = 0.15;
  const Flight f = fly(transfer, true, end);
  CAPTURE(int(transfer), f.largest_open, free_flight(end));
  CHECK(f.largest_open > 0.25 * free_flight(end));
  CHECK(f.largest_open < 4.0 * free_flight(end));
  CHECK(std::abs(f.energy_error) < 0.01);
  // Control: exponential growth once points are alone, which the time step follows with its root.
  const Flight uncured = fly(transfer, false, early);
  CAPTURE(uncured.largest_open, free_flight(early));
  CHECK(uncured.largest_open > 100.0 * free_flight(early));
}

TEST_CASE("Debris keeps its momentum and its spin", "[mpm]") {
  const double spin = 100.0;
  const Flight f = fly(Transfer::apic, true, 0.3, spin);
  const double mass = 2000.0, speed = 0.5 * kRateX;
  CHECK(f.momentum < 1e-12 * mass * speed);
  CHECK(std::abs(f.angular) < 1e-9 * mass * spin);
}

TEST_CASE("A lone elastic point is not debris", "[mpm]") {
  // Its stress holds it together: it swings, and is never opened far enough to be taken for debris.
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 0.25, 0.25}, 0.25, 2000.0);
  Run run(p, free_space(kCell)), uncured(p, free_space(kCell));
  uncured.s.largest_density.assign(1, 0.0);
  for (Run* r : {&run, &uncured}) {
    r->s.points.c[0][0] = 2.0;
    r->s.points.v[0][0] = 5.0;  // crosses cells, so that points are sorted
    r->run_to(1.0);
  }
  CHECK(run.s.points.c[0] == uncured.s.points.c[0]);
  CHECK(run.s.points.volume[0] < 1.1 * 0.0625);
}
