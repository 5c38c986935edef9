#include "tests/mpm/scene.hpp"
#include "tests/support/count_allocations.hpp"

#include <memory>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using test::allocations;

#if FLOWSLIDE_COUNTS_ALLOCATIONS

namespace {

/// A column of two soils that slumps on the ground.
ParticleSet column() {
  ParticleSet p;
  p.materials = {liquefied(2e6, 5e3), elastic(5e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 6.0, 1.0}, 0.25, 1800.0, 1);
  add_lattice(p, {0.0, 1.0, 6.0, 3.0}, 0.25, 1800.0, 0);
  return p;
}

FlowConfig on_ground() {
  FlowConfig config = free_space(0.5);
  config.gravity = 9.81;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = 0.3;
  return config;
}

/// Allocations in `steps` steps, none of which bins the points.
long allocations_in(Run& run, int steps) {
  run.step(3);
  prepare(run.s, run.scratch, true);
  run.step();
  const long before = allocations;
  run.step(steps);
  const long count = allocations - before;
  REQUIRE(run.s.drift < 0.9 * run.s.grid.h);  // it would have been binned anew
  return count;
}

}  // namespace

TEST_CASE("The counter of allocations sees new, malloc and Eigen's kind", "[mpm]") {
  const long now = allocations;
  const auto one = std::make_unique<double>(1.0);
  CHECK(allocations - now == 1);
  std::unique_ptr<void, void (*)(void*)> two(std::aligned_alloc(64, 128), std::free);
  CHECK(allocations - now == 2);
}

TEST_CASE("A step of any scheme allocates nothing unless points are binned", "[mpm]") {
  FlowConfig config = on_ground();
  config.basis =
      GENERATE(BasisKind::linear, BasisKind::gimp, BasisKind::quadratic, BasisKind::cubic);
  config.update = GENERATE(Update::symplectic, Update::usf, Update::musl);
  config.transfer = GENERATE(Transfer::apic, Transfer::tpic, Transfer::aflip, Transfer::flip,
                             Transfer::pic, Transfer::fmpm);
  CAPTURE(int(config.basis), int(config.update), int(config.transfer));
  Run run(column(), config);
  CHECK(allocations_in(run, 10) == 0);
}

TEST_CASE("Steps with sleepers, an absorbing plane and a load allocate nothing", "[mpm]") {
  FlowConfig config = on_ground();
  config.absorbing.left = 0.0;
  config.tractions = {{.from = {2.0, 3.0}, .to = {4.0, 3.0}, .pressure = 1e3}};
  config.sleep = SleepSettings{.speed = 0.5, .after = 0.05};
  Run run(column(), config);
  CHECK(allocations_in(run, 10) == 0);
}

TEST_CASE("Many steps between two binnings allocate nothing", "[mpm]") {
  Run run(column(), on_ground());
  run.step(3);
  const long before = allocations;
  int counted = 0;
  while (run.s.drift <= 0.8 * run.s.grid.h) {
    run.step();
    ++counted;
  }
  CHECK(allocations - before == 0);
  CHECK(counted > 50);
}

#endif
