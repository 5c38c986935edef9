#include "mpm/run/flow.hpp"
#include "tests/mpm/solid.hpp"

#include <catch2/catch.hpp>

/// Steps that reach every parallel loop of mpm/: each basis with each way to update and to
/// transfer, walls, absorbing planes, sleep, outlet and loads, and binning in between. There is
/// nothing to check but that the detector keeps still.
using namespace flowslide;
using namespace flowslide::mpm;

namespace {

constexpr int kThreads = 4;

ParticleSet falling(double spacing) {
  ParticleSet p;
  p.materials = {liquefied(1e6, 4e3), elastic(5e6, 0.3)};
  add_lattice(p, {0.0, 1.0, 6.0, 4.0}, spacing, 1800.0);
  add_lattice(p, {0.0, 0.0, 6.0, 1.0}, spacing, 1900.0, 1);
  for (auto& v : p.velocity) v = {2.0, -1.0, 0.0};
  return p;
}

FlowConfig settings() {
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, -0.05}, {6.0, 0.0}};
  c.left_roller = 0.0;
  return c;
}

}  // namespace

TEST_CASE("Steps of every scheme") {
  FlowConfig c = settings();
  c.basis = GENERATE(BasisKind::linear, BasisKind::gimp, BasisKind::quadratic, BasisKind::cubic);
  c.update = GENERATE(Update::symplectic, Update::usf, Update::musl);
  c.transfer = GENERATE(Transfer::apic, Transfer::flip, Transfer::fmpm);
  if (c.update != Update::symplectic && c.transfer == Transfer::apic) return;
  Run run(falling(0.25), c, kThreads);
  run.step(6);
  run.s.drift = 10.0;  // bins the points
  run.step(6);
  CHECK(run.s.step == 12);
}

TEST_CASE("Steps with all that an edge can be") {
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.absorbing.left = 0.0;
  c.absorbing.bottom = 0.0;
  c.outlet.right = 5.9;
  c.sleep.emplace();
  c.sleep->after = 1e-3;
  TractionSettings load;
  load.from = {1.0, 4.0};
  load.to = {2.0, 4.0};
  load.pressure = 1e3;
  c.tractions = {load};
  Run run(falling(0.25), c, kThreads);
  for (int i = 0; i < 5; ++i) {
    run.s.drift = 10.0;
    run.step(8);
  }
  CHECK(run.s.gone.size() > 0);
}

TEST_CASE("Soil that sleeps and wakes") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {4.0, 0.0, 8.0, 2.0}, 0.25, 1800.0);
  for (auto& v : p.velocity) v = {30.0, 0.0, 0.0};
  add_lattice(p, {16.0, 0.0, 32.0, 2.0}, 0.25, 1800.0);
  FlowConfig c = free_space(0.5);
  c.sleep = SleepSettings{0.02, 0.02};
  Run run(p, c, kThreads);
  std::int64_t slept = 0;
  while (run.s.time < 0.5) {
    run.step();
    slept = std::max<std::int64_t>(slept, run.s.sleep.count);
  }
  CHECK(slept > 0);
  CHECK(run.s.sleep.count < slept);
}

TEST_CASE("Steps in three dimensions") {
  FlowConfig c = settings();
  c.left_roller.reset();
  ParticleSet p;
  p.materials = {liquefied(2e6, 3e3)};
  add_block(p, {{0.0, 0.0, 0.5}, {2.0, 2.0, 2.0}}, 0.25, 1800.0);
  p.pore_pressure.assign(p.size(), 0.0);
  for (auto& v : p.velocity) v = {0.5, 0.2, -3.0};
  Run3 run(p, c, kThreads);
  run.step(4);
  run.s.drift = 10.0;
  run.step(4);
  CHECK(run.s.step == 8);
}
