#include "tests/mpm/scene.hpp"
#include "tests/support/count_allocations.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

TEST_CASE("A step allocates nothing unless points are binned", "[mpm]") {
  ParticleSet p;
  p.materials = {liquefied(2e6, 5e3)};
  add_lattice(p, {0.0, 0.0, 6.0, 3.0}, 0.25, 1800.0);
  FlowConfig config = free_space(0.5);
  config.gravity = 9.81;
  config.ground.surface = {{0.0, 0.0}};
  Run run(p, config);
  run.step(3);
  const long before = allocations;
  int counted = 0;
  while (run.s.drift <= 0.8 * config.cell) {
    run.step();
    ++counted;
  }
  CHECK(allocations - before == 0);
  CHECK(counted > 50);

  const long now = allocations;  // control: the counter sees a vector
  std::vector<double> v(10);
  CHECK(allocations - now == 1);
}
