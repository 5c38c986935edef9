#include "mpm/solver/energy_watch.hpp"

#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

/// An elastic block that falls 2 m onto ground without friction.
std::string drop(BasisKind basis) {
  ParticleSet p;
  p.toe = 0.0;
  p.materials = {elastic(5e6, 0.2)};
  add_lattice(p, {-1.0, 2.0, 1.0, 4.0}, 0.25, 2000.0);
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.ground.friction = 0.0;
  c.basis = basis;
  c.end = 2.0;
  c.sample_interval = 0.02;
  c.rest.window = 100.0;
  const Scratch folder;
  try {
    run_flow(p, c, {folder / "mpm.h5", folder / "mpm.checkpoint"}, 1, {});
  } catch (const NumericsError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A scheme that makes energy ends the run", "[mpm]") {
  // Hat functions and points that leave nodes behind; the same with splines is the control.
  CHECK_THAT(drop(BasisKind::linear), Contains("the scheme is unstable"));
  CHECK(drop(BasisKind::quadratic) == "");
}

TEST_CASE("Energy from nowhere is told from what was brought in", "[mpm]") {
  EnergyWatch watch;
  watch.begin(8.0, 0.0, 2.0);
  MpmSample now;
  now.gravity_work = 90.0;
  now.damping_work = 50.0;
  CHECK_NOTHROW(watch.look(now, false));
  now.damping_work = 31.0;  // 19 of 100 J
  CHECK_NOTHROW(watch.look(now, false));
  now.damping_work = 29.0;
  CHECK_THROWS_WITH(watch.look(now, false),
                    Contains("21 J of energy have come from nowhere") && Contains("brought 100 J"));
  now.friction_work = 25.0;  // a fall that other dissipation makes up for
  CHECK_NOTHROW(watch.look(now, false));
  now.plastic_work = 51.0;
  CHECK_NOTHROW(watch.look(now, false));
  CHECK_THROWS_WITH(watch.look(now, true), Contains("plastic work"));
  now.damping_work = std::nan("");
  CHECK_THROWS_AS(watch.look(now, false), NumericsError);
}
