#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

/// A block that a gravity sets in motion from rest, with nothing below it.
ParticleSet block(double young) {
  ParticleSet p;
  p.materials = {elastic(young, 0.3)};
  add_lattice(p, {0.0, 0.0, 12.0, 12.0}, 0.5, 2000.0);
  return p;
}

FlowConfig falling(double gravity) {
  FlowConfig c = free_space(1.0);
  c.gravity = gravity;
  return c;
}

std::string numerics_error(Run& run, int steps) {
  try {
    run.step(steps);
  } catch (const NumericsError& e) {
    return e.what();
  }
  return "(no NumericsError)";
}

}  // namespace

TEST_CASE("A step is shortened where the forces would carry points too far", "[mpm]") {
  // The elastic step is dt = 0.9 * 0.5 h sqrt(rho / (K + 4/3 G)) = 0.0555 s here; a gravity g
  // carries every point by g dt^2 in it, 1/2.5 of a cell at g = 130 m/s2.
  FlowConfig config = falling(100.0);
  config.transfer = GENERATE(Transfer::apic, Transfer::aflip, Transfer::flip, Transfer::fmpm);
  config.update = GENERATE(Update::symplectic, Update::musl);
  Run tame(block(1e5), config);
  const double whole = stable_step(tame.s);
  tame.step();
  CHECK(tame.s.dt == whole);

  config.gravity = 1e6;
  Run hard(block(1e5), config);
  hard.step();
  CHECK(hard.s.dt < 0.1 * whole);
  // One cell crossed by half at most, and no shorter than the bound asks for: the way is g dt^2.
  const double way = 1e6 * hard.s.dt * hard.s.dt;
  CHECK(way <= 0.5);
  CHECK(way >= 0.1 * 0.5);
  CHECK(std::sqrt(hard.s.last.max_speed2) == Approx(1e6 * hard.s.dt));
  // As every point falls alike, the step given up left nothing behind.
  CHECK(hard.sample_now().momentum_error < 1e-12);
}

TEST_CASE("A step that is begun again gives what a shorter one gives", "[mpm]") {
  ParticleSet p = block(1e5);
  FlowConfig config = falling(5e4);
  config.ground.surface = {{0.0, 0.0}};
  config.absorbing.right = 14.0;
  config.tractions = {{.from = {2.0, 12.0}, .to = {10.0, 12.0}, .pressure = 1e8, .ramp = 0.1}};
  Run run(p, config);
  const double whole = stable_step(run.s);
  run.step();
  REQUIRE(run.s.dt < 0.8 * whole);

  config.courant *= run.s.dt / whole;
  Run once(p, config);
  once.step();
  REQUIRE(once.s.dt == Approx(run.s.dt).epsilon(1e-14));
  for (std::size_t q = 0; q < p.size(); ++q) {
    for (int d = 0; d < 2; ++d) {
      CHECK(run.s.points.v[d][q] == Approx(once.s.points.v[d][q]).epsilon(1e-9).margin(1e-9));
      CHECK(run.s.points.x[d][q] == Approx(once.s.points.x[d][q]).epsilon(1e-12));
    }
  }
}

TEST_CASE("usf cannot begin a step again and says so", "[mpm]") {
  FlowConfig config = falling(1e6);
  config.update = Update::usf;
  Run run(block(1e5), config);
  CHECK_THAT(numerics_error(run, 1),
             Contains("points would move by more than a cell") && Contains("update symplectic"));
  config.gravity = 50.0;
  Run tame(block(1e5), config);
  CHECK(numerics_error(tame, 5) == "(no NumericsError)");
}

TEST_CASE("A point that moves by more than a cell in a step ends the run by name", "[mpm]") {
  Run run(block(1e5), falling(10.0));
  // Speeds changed behind the back of the time step.
  run.step();
  for (double& v : run.s.points.v[0]) v = 1e3;
  run.scratch.scattered = false;
  CHECK_THAT(numerics_error(run, 1), Contains("particle ") && Contains("moved by") &&
                                         Contains("1e+03 m/s") && Contains("check gravity"));
}

TEST_CASE("Points that leave their window are sorted before the next step", "[mpm]") {
  // A point at the edge of its tile that crosses 0.94 and then 0.4 cells: 1.34 in all, beyond the
  // one cell that the window reaches. Before, it gave to nodes of other tiles.
  ParticleSet p;
  p.materials = {elastic(1e-6, 0.0)};
  resize(p, 1);
  p.position[0] = {8.45, 4.0, 0.0};  // base node 7 of tile 0
  p.volume[0] = 1.0;
  p.mass[0] = 1.0;
  p.id[0] = 0;
  p.velocity[0] = {1.0, 0.0, 0.0};
  FlowConfig config = free_space(1.0);
  config.velocity_limit = 0.47;
  Run run(p, config);
  const double start = sum_points(run.s).momentum[0];
  run.step(2);
  CHECK(run.s.drift == Approx(0.94));
  run.step();
  CHECK(run.s.drift > 1e300);  // known to have left
  run.step(20);
  CHECK(sum_points(run.s).momentum[0] == Approx(start).epsilon(1e-12));
  CHECK(run.s.points.x[0][0] == Approx(8.45 + run.s.time).epsilon(1e-12));
}

TEST_CASE("A position that is not a number is no index", "[mpm]") {
  Run run(block(1e5), falling(10.0));
  run.step();
  run.s.points.v[0][7] = std::nan("");
  run.scratch.scattered = false;
  CHECK_THAT(numerics_error(run, 3), Contains("no longer finite") || Contains("particle"));
}
