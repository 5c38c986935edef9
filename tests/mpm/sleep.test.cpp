#include "mpm/solver/checkpoint.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

namespace {

/// A block slides over the ground towards one that rests there, in equilibrium.
struct Sliding {
  ParticleSet points;
  FlowConfig config = free_space(0.5);
  std::size_t first_resting = 0;

  Sliding() {
    points.materials = {elastic(5e6, 0.0)};
    add_lattice(points, {0.0, 0.0, 4.0, 2.0}, 0.25, 1800.0);
    first_resting = points.size();
    add_lattice(points, {14.0, 0.0, 22.0, 2.0}, 0.25, 1800.0);
    for (std::size_t q = 0; q < points.size(); ++q) {
      points.stress[q][1] = -1800.0 * 9.81 * (2.0 - points.position[q][1]);
      if (q < first_resting) points.velocity[q][0] = 8.0;
    }
    config.gravity = 9.81;
    config.ground.surface = {{0.0, 0.0}};
    config.ground.friction = 0.2;
    config.sleep = SleepSettings{0.02, 0.1};
  }
  [[nodiscard]] double middle_of_resting(const Simulation<2>& s) const {
    double sum = 0.0;
    for (std::size_t q = 0; q < s.points.size(); ++q)
      if (s.points.index[q] >= static_cast<std::int32_t>(first_resting)) sum += s.points.x[0][q];
    return sum / double(points.size() - first_resting);
  }
};

bool same_bits(const Simulation<2>& a, const Simulation<2>& b) {
  bool same = std::memcmp(&a.balance, &b.balance, sizeof a.balance) == 0;
  visit_arrays(a.points, b.points, [&](const auto& x, const auto& y) {
    same = same && x.size() == y.size() &&
           std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0;
  });
  return same;
}

}  // namespace

TEST_CASE("A resting block sleeps until another one comes near", "[mpm]") {
  Sliding scene;
  scene.config.transfer = GENERATE(Transfer::apic, Transfer::aflip, Transfer::flip);
  Run run(scene.points, scene.config);
  const auto resting = static_cast<std::int64_t>(scene.points.size() - scene.first_resting);
  run.run_to(0.5);
  CHECK(run.s.sleep.count == resting);
  CHECK(run.sample_now().active_particles == Approx(128.0 / (128.0 + double(resting))));
  for (std::size_t q = 0; q < run.s.points.size(); ++q)
    if (run.s.points.index[q] >= static_cast<std::int32_t>(scene.first_resting))
      REQUIRE(run.s.points.x[0][q] == scene.points.position[run.s.points.index[q]][0]);
  run.run_to(2.0);
  CHECK(run.s.sleep.count == 0);
  const MpmSample end = run.sample_now();
  CHECK(end.momentum_error < 1e-9);
  CHECK(std::abs(end.energy_error) < 0.02);

  // Control: the same without sleep.
  scene.config.sleep.reset();
  Run awake(scene.points, scene.config);
  awake.run_to(2.0);
  CHECK(awake.s.sleep.count == 0);
  const double before = 18.0, moved = scene.middle_of_resting(run.s) - before;
  CHECK(moved > 0.3);
  CHECK(moved == Approx(scene.middle_of_resting(awake.s) - before).epsilon(0.03));
  CHECK(std::abs(end.energy_error - awake.sample_now().energy_error) < 2e-3);
}

TEST_CASE("Sleep does not depend on threads and survives a checkpoint", "[mpm]") {
  const Sliding scene;
  Run one(scene.points, scene.config, 1), two(scene.points, scene.config, 2);
  one.run_to(1.0);
  two.run_to(1.0);
  REQUIRE(one.s.sleep.count > 0);
  CHECK(same_bits(one.s, two.s));
  const Scratch folder;
  write_checkpoint(folder / "now", one.s, state_of(one.s));
  Simulation<2> copy = make_simulation(scene.points, scene.config);
  RunState state;
  read_checkpoint(folder / "now", copy, state);
  StepScratch<2> scratch(1);
  prepare(copy, scratch, false);
  CHECK(copy.sleep.count == one.s.sleep.count);
  while (one.s.sleep.count > 0) {
    one.step();
    advance(copy, scratch);
  }
  one.step(50);
  for (int i = 0; i < 50; ++i) advance(copy, scratch);
  CHECK(same_bits(one.s, copy));
  one.step();  // control
  CHECK(!same_bits(one.s, copy));
}

TEST_CASE("Soil under a load does not sleep", "[mpm]") {
  Sliding scene;
  TractionSettings load;
  load.from = {14.0, 2.0};
  load.to = {22.0, 2.0};
  load.pressure = 1e3;
  load.begin = 5.0;
  scene.config.tractions = {load};
  Run run(scene.points, scene.config);
  run.run_to(0.5);
  CHECK(run.s.sleep.count == 0);
}

TEST_CASE("Steps go on as they were where all soil sleeps", "[mpm]") {
  Sliding scene;
  scene.config.sleep = SleepSettings{100.0, 0.1};  // whatever falls is quiet
  Run run(scene.points, scene.config);
  const double first = stable_step(run.s);
  run.run_to(5.0);
  REQUIRE(run.s.sleep.count == std::ssize(scene.points.mass));
  CHECK(run.s.time < 5.1);
  CHECK(run.s.dt > 0.1 * first);
  CHECK(run.s.dt < 10.0 * first);
  CHECK(std::isfinite(run.sample_now().energy_error));
}

TEST_CASE("Sleep needs a scheme that maps points once", "[mpm]") {
  Sliding scene;
  scene.config.update = Update::musl;
  CHECK_THAT(input_error([&] { make_simulation(scene.points, scene.config); }),
             Catch::Matchers::Contains("sleep needs update symplectic"));
}
