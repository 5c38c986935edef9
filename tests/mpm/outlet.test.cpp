#include "mpm/solver/checkpoint.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <atomic>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

constexpr double kEdge = 3.5;

ParticleSet column() {
  ParticleSet p;
  p.toe = 2.0;
  p.materials = {liquefied(1e6, 500.0)};
  add_lattice(p, {0.0, 0.0, 2.0, 4.0}, 0.25, 1800.0);
  return p;
}

FlowConfig collapse() {
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.ground.friction = 0.1;
  c.left_roller = 0.0;
  c.end = 1.5;
  c.frame_interval = 0.5;
  c.sample_interval = 0.02;
  c.outlet.right = kEdge;
  return c;
}

FlowPaths paths_in(const Scratch& folder) { return {folder / "mpm.h5", folder / "mpm.checkpoint"}; }

std::string bytes_of(const FlowConfig& c, int threads) {
  const Scratch folder;
  run_flow(column(), c, paths_in(folder), threads, {});
  return read_text_file(folder / "mpm.h5");
}

}  // namespace

TEST_CASE("What leaves through the outlet stays in the balances", "[mpm]") {
  Run run(column(), collapse());
  run.run_to(1.5);
  const MpmSample r = run.sample_now();
  REQUIRE(r.points_left > 15.0);
  REQUIRE(run.s.points.size() > 15);
  const PointSums<2> present = sum_points(run.s);
  CHECK(r.mass_left + present.mass == Approx(8.0 * 1800.0).epsilon(1e-14));
  CHECK(r.mass_left == Approx(r.points_left * 0.0625 * 1800.0).epsilon(1e-14));
  CHECK(r.mass_error < 1e-14);
  CHECK(r.momentum_error < 1e-12);
  CHECK(std::abs(r.energy_error) < 0.01);
  CHECK(r.kinetic_left > 0.05 * r.gravity_work);
  CHECK(r.momentum_left_x > 0.0);
  CHECK(r.damping_work + r.plastic_work + r.friction_work + r.strain_energy + r.kinetic +
            r.kinetic_left ==
        Approx(r.gravity_work).epsilon(0.01));
  for (std::size_t q = 0; q < run.s.points.size(); ++q)
    CHECK(run.s.points.x[0][q] < kEdge + run.s.grid.h);
  for (std::size_t q = 0; q < run.s.gone.size(); ++q) CHECK(run.s.gone.x[0][q] > kEdge);

  // Control: the same state with those that left forgotten.
  visit_arrays(run.s.gone, [](auto& array) { array.clear(); });
  const MpmSample forgotten = run.sample_now();
  CHECK(forgotten.mass_error > 0.1);
  CHECK(forgotten.momentum_error > 1e-3);
  CHECK(std::abs(forgotten.energy_error) > 0.1);
}

TEST_CASE("Soil ends at the edge of the outlet as at a front", "[mpm]") {
  // Waves that an edge sends back would show upstream before the flow is affected: the front has
  // passed the edge at the time compared, points far from it have not felt it.
  FlowConfig open = collapse(), wide = collapse();
  wide.outlet.right.reset();
  Run with(column(), open), without(column(), wide);
  while (with.s.gone.size() == 0) {
    with.step();
    without.step();
  }
  REQUIRE(with.s.time == without.s.time);
  std::vector<double> x(column().size());
  for (std::size_t q = 0; q < without.s.points.size(); ++q)
    x[without.s.points.index[q]] = without.s.points.x[0][q];
  double largest = 0.0;
  for (std::size_t q = 0; q < with.s.points.size(); ++q)
    largest = std::max(largest, std::abs(with.s.points.x[0][q] - x[with.s.points.index[q]]));
  CHECK(largest < 1e-3);
  CHECK(with.sample_now().front == Approx(without.sample_now().front).margin(1e-3));
}

TEST_CASE("The front counts points where they left", "[mpm]") {
  const Scratch folder;
  const FlowFacts facts = run_flow(column(), collapse(), paths_in(folder), 1, {});
  REQUIRE(facts.last.points_left >= 5.0);
  const MpmHistory history(folder / "mpm.h5");
  double front = 0.0, left = 0.0;
  for (const MpmSample& s : history.samples()) {
    if (s.points_left >= 5.0) CHECK(s.front >= std::max(kEdge, front));
    CHECK(s.points_left >= left);
    CHECK(s.mass_error < 1e-14);
    front = std::max(front, s.points_left >= 5.0 ? s.front : 0.0);
    left = s.points_left;
  }
  CHECK(history.samples().back().points_left == facts.last.points_left);
  const MpmFrame last = history.frame(history.num_frames() - 1);
  std::size_t without_volume = 0;
  for (std::size_t i = 0; i < last.volume.size(); ++i) {
    if (last.volume[i] > 0.0) continue;
    ++without_volume;
    CHECK(last.position[i][0] > kEdge);
  }
  CHECK(double(without_volume) == facts.last.points_left);
  CHECK(facts.point_updates < double(facts.steps) * double(column().size()));
  CHECK(facts.point_updates > double(facts.steps) * double(column().size()) / 2.0);
}

TEST_CASE("Runs with an outlet have the same bytes for any threads and interruptions", "[mpm]") {
  const FlowConfig c = collapse();
  const std::string once = bytes_of(c, 1);
  CHECK(bytes_of(c, 2) == once);
  FlowConfig closed = c;
  closed.outlet.right.reset();
  CHECK(bytes_of(closed, 1) != once);  // control

  const Scratch folder;
  const FlowPaths paths = paths_in(folder);
  int calls = 0, interruptions = 0;
  for (bool done = false; !done; ++calls) {
    std::atomic<bool> stop{false};
    Progress progress;
    progress.stop_requested = &stop;
    stop = calls < 40;  // stops after one step; later a run to the end
    try {
      run_flow(column(), c, paths, 1, progress);
      done = true;
    } catch (const Interrupted&) {
      ++interruptions;
    }
  }
  CHECK(interruptions == 40);
  CHECK(read_text_file(paths.history) == once);
}

TEST_CASE("Checkpoints keep what has left", "[mpm]") {
  const Scratch folder;
  Run run(column(), collapse());
  run.run_to(1.2);
  REQUIRE(run.s.gone.size() > 0);
  RunState state;
  state.frames = 1;
  state.next_frame = 1.5;
  state.next_sample = 1.3;
  state.first_dt = run.s.dt;
  write_checkpoint(folder / "c", run.s, state);
  Simulation<2> again = make_simulation(column(), collapse());
  read_checkpoint(folder / "c", again, state);
  StepScratch<2> scratch(1);
  prepare(again, scratch, false);
  for (int i = 0; i < 50; ++i) {
    run.step();
    advance(again, scratch);
  }
  CHECK(again.points.x == run.s.points.x);
  CHECK(again.points.sigma == run.s.points.sigma);
  CHECK(again.gone.x == run.s.gone.x);
  CHECK(again.gone.index == run.s.gone.index);
}

TEST_CASE("A run that nothing is left of ends", "[mpm]") {
  const Scratch folder;
  ParticleSet p;
  p.toe = 2.0;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 2.0, 1.0, 3.0}, 0.25, 1000.0);
  FlowConfig c = collapse();
  c.outlet = {-1.0, 5.0, 0.5, 10.0};
  c.ground.surface = {{0.0, -100.0}};
  c.left_roller.reset();
  c.end = 100.0;
  const FlowFacts facts = run_flow(p, c, paths_in(folder), 1, {});
  CHECK(facts.last.points_left == double(p.size()));
  CHECK(facts.end_time < 2.0);
  CHECK(facts.last.mass_error < 1e-14);
  CHECK(facts.last.kinetic == 0.0);
  CHECK(facts.last.kinetic_left == Approx(1000.0 * 9.81 * 1.5).epsilon(0.5));
}

TEST_CASE("Outlets that make no sense are refused", "[mpm]") {
  const auto message = [](const OutletSettings& outlet) {
    FlowConfig c = collapse();
    c.outlet = outlet;
    return input_error([&] { make_simulation(column(), c); });
  };
  CHECK(message({-1.0, 9.0, -1.0, 9.0}) == "(no InputError)");
  CHECK_THAT(message({9.0, -1.0, {}, {}}), Contains("outlet.left"));
  CHECK_THAT(message({{}, {}, 9.0, -1.0}), Contains("outlet.bottom"));
  CHECK_THAT(message({{}, 1.0, {}, {}}), Contains("particle 5 ") && Contains("beyond the outlet"));
}

TEST_CASE("Three dimensions have outlets too", "[mpm]") {
  ParticleSet p;
  p.toe = 2.0;
  p.dim = 3;
  p.materials = {elastic(1e6, 0.3)};
  resize(p, 2);
  for (std::size_t q = 0; q < 2; ++q) {
    p.position[q] = {0.5, 0.5, 0.5 + 3.0 * double(q)};
    p.velocity[q] = {4.0, 0.0, 0.0};
    p.mass[q] = 1000.0, p.volume[q] = 1.0, p.id[q] = std::int64_t(q);
  }
  FlowConfig c = free_space(1.0);
  c.outlet.right = 2.0;
  c.outlet.top = 9.0;
  Simulation<3> s = make_simulation<3>(p, c);
  StepScratch<3> scratch(1);
  prepare(s, scratch, true);
  while (s.time < 1.0) advance(s, scratch);
  CHECK(s.points.size() == 0);
  CHECK(s.gone.size() == 2);
}
