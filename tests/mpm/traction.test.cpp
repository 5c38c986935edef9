#include "mpm/solver/checkpoint.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

constexpr double kLength = 10.0, kYoung = 1e6, kDensity = 1000.0, kPressure = 1e3;

/// A bar 2 m high from a roller at x = 0, pressed at x = kLength; free at the top and below.
ParticleSet bar(double stress) {
  ParticleSet p;
  p.materials = {elastic(kYoung, 0.0)};
  add_lattice(p, {0.0, 0.0, kLength, 2.0}, 0.25, kDensity);
  for (auto& s : p.stress) s[0] = stress;
  return p;
}

FlowConfig pressed(double pressure = kPressure) {
  FlowConfig c = free_space(0.5);
  c.left_roller = 0.0;
  // Down the right end: the soil is on the right of the way.
  c.tractions = {{{kLength, 2.0}, {kLength, 0.0}, pressure}};
  return c;
}

double fastest(const Simulation<2>& s) {
  double v = 0.0;
  for (std::size_t q = 0; q < s.points.size(); ++q)
    v = std::max(v, std::hypot(s.points.v[0][q], s.points.v[1][q]));
  return v;
}

/// Fastest point in a tenth of a second, over what the traction would give to free soil.
double unrest(Run& run) {
  const double wave = std::sqrt(kYoung / kDensity);
  double most = 0.0;
  while (run.s.time < 0.1) {
    run.step();
    most = std::max(most, fastest(run.s));
  }
  return most / (kPressure / (kDensity * wave));
}

}  // namespace

TEST_CASE("A bar that a traction presses evenly stays at rest", "[mpm]") {
  // The traction is summed up like the stress: hardly a step at the end, wherever it lies in its
  // cell. What is left comes from the layer in which it falls to zero.
  const double offset = GENERATE(0.0, 0.11, 0.25, 0.4);
  const auto basis = GENERATE(BasisKind::quadratic, BasisKind::cubic);
  FlowConfig c = pressed();
  c.basis = basis;
  // The end moves through its cell while the roller stays on a line, where it is exact.
  ParticleSet p = bar(-kPressure);
  for (auto& x : p.position) x[0] += offset;
  for (TractionSettings& t : c.tractions) t.from[0] += offset, t.to[0] += offset;
  c.left_roller.reset();
  c.tractions.push_back({{offset, 0.0}, {offset, 2.0}, kPressure});
  CAPTURE(offset, int(basis));
  Run run(p, c);
  CHECK(unrest(run) < 0.035);

  // Controls: the same force on the points without the part that carries it to the surface, and no
  // traction.
  Run deep(p, c);
  for (auto& load : deep.s.loads) load.above = 0.0;
  CHECK(unrest(deep) > 0.1);
  c.tractions.clear();
  Run free(p, c);
  CHECK(unrest(free) > 0.5);
}

TEST_CASE("A traction sends the wave of one-dimensional theory into a bar", "[mpm]") {
  const double ramp = 0.15;
  FlowConfig c = pressed();
  c.tractions[0].ramp = ramp;
  Run run(bar(0.0), c);
  const double wave = std::sqrt(kYoung / kDensity);  // nu = 0
  run.run_to(0.28);
  double v = 0.0, s = 0.0, n = 0.0, ahead = 0.0;
  for (std::size_t q = 0; q < run.s.points.size(); ++q) {
    const double x = run.s.points.x[0][q];
    if (x > 0.65 * kLength && x < 0.95 * kLength)
      v += run.s.points.v[0][q], s += run.s.points.sigma[0][q], n += 1.0;
    if (x < 0.05 * kLength) ahead = std::max(ahead, std::abs(run.s.points.sigma[0][q]));
  }
  CHECK(v / n == Approx(-kPressure / (kDensity * wave)).epsilon(0.01));
  CHECK(s / n == Approx(-kPressure).epsilon(0.01));
  CHECK(ahead < 0.05 * kPressure);
  const MpmSample r = run.sample_now();
  // Integral of p^2 A / (rho c): half of it moves, half of it is stored.
  const double work =
      kPressure * kPressure * (run.s.time - 2.0 / 3.0 * ramp) * 2.0 / (kDensity * wave);
  CHECK(r.load_work == Approx(work).epsilon(0.02));
  CHECK(r.kinetic == Approx(0.5 * work).epsilon(0.03));
  CHECK(r.strain_energy == Approx(0.5 * work).epsilon(0.03));
  CHECK(std::abs(r.energy_error) < 1e-3);
}

TEST_CASE("A traction gives its whole force, rising in time", "[mpm]") {
  FlowConfig c = pressed();
  c.left_roller.reset();
  c.tractions[0].shear = 300.0;
  c.tractions[0].begin = 0.02;
  c.tractions[0].ramp = 0.04;
  Run run(bar(0.0), c);
  run.run_to(0.02);
  CHECK(fastest(run.s) < 1e-3 * kPressure / (kDensity * 30.0));
  run.run_to(0.1);
  const double full = run.s.time - 0.02 - 0.5 * 0.04;
  const PointSums<2> sums = sum_points(run.s);
  CHECK(sums.momentum[0] == Approx(-kPressure * 2.0 * full).epsilon(2e-3));
  CHECK(sums.momentum[1] == Approx(-300.0 * 2.0 * full).epsilon(2e-3));
  const MpmSample r = run.sample_now();
  CHECK(r.momentum_error < 1e-12);
  CHECK(std::abs(r.energy_error) < 0.01);
  CHECK(r.load_work > 0.0);
}

TEST_CASE("Soil under a load at rest carries it to the ground", "[mpm]") {
  // What a load on top adds to the stress of a block under its weight, in every point of it. The
  // block is stocky: a wall of this soil 1 m thick buckles under its weight at a height of 4.05 m,
  // (7.84 E I/(rho g t))^(1/3), this one at 6.4 m, so that no rounding leans it over.
  constexpr double kHeight = 2.0;
  ParticleSet p;
  p.materials = {elastic(kYoung, 0.0)};
  add_lattice(p, {0.0, 0.0, 2.0, kHeight}, 0.25, kDensity);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.stress[q][1] = -kDensity * 9.81 * (kHeight - p.position[q][1]);
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.damping = 0.5;
  Run bare(p, c);
  bare.run_to(4.0);
  // At rest to rounding, 2e-13 m/s; damping that mistakes the sign of such a velocity at the ground
  // pushes the block up again, by 1e-3 m/s at any time after 3 s.
  CHECK(fastest(bare.s) < 1e-9);
  std::vector<double> before(p.size());
  for (std::size_t q = 0; q < p.size(); ++q)
    before[std::size_t(bare.s.points.index[q])] = bare.s.points.sigma[1][q];
  c.tractions = {{{0.0, kHeight}, {2.0, kHeight}, 2e3, 0.0, 0.0, 1.0}};
  Run run(p, c);
  run.run_to(4.0);
  double mean = 0.0, most = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double added = run.s.points.sigma[1][q] - before[std::size_t(run.s.points.index[q])];
    mean += added / double(p.size());
    most = std::max(most, std::abs(added / -2e3 - 1.0));
  }
  CAPTURE(mean, most);
  CHECK(mean == Approx(-2e3).epsilon(0.01));
  CHECK(most < 0.1);
  const MpmSample r = run.sample_now();
  CHECK(std::abs(r.energy_error) < 0.01);
  CHECK(r.load_work > 0.0);
}

TEST_CASE("Loads keep to their points", "[mpm]") {
  FlowConfig c = pressed(2e5);
  c.left_roller.reset();
  c.end = 0.5;
  c.sample_interval = 0.1;
  c.outlet.left = -4.0;
  const auto state = [&](int threads) {
    Run run(bar(0.0), c, threads);
    run.run_to(1.0);
    return run;
  };
  const Run one = state(1), two = state(2);
  CHECK(one.s.points.x == two.s.points.x);
  CHECK(one.s.points.sigma == two.s.points.sigma);
  REQUIRE(one.s.gone.size() > 0);
  for (const Load<2>& load : one.s.loads)
    if (load.point >= 0) CHECK(one.s.points.index[load.point] == load.index);

  const Scratch folder;
  Run run(bar(0.0), c);
  run.run_to(0.3);
  RunState kept = state_of(run.s);
  write_checkpoint(folder / "c", run.s, kept);
  Simulation<2> again = make_simulation(bar(0.0), c);
  read_checkpoint(folder / "c", again, kept);
  StepScratch<2> scratch(1);
  prepare(again, scratch, false);
  for (int i = 0; i < 100; ++i) {
    run.step();
    advance(again, scratch);
  }
  CHECK(again.points.x == run.s.points.x);
  CHECK(again.balance.grid.load == run.s.balance.grid.load);
}

TEST_CASE("Tractions that nothing can carry are refused", "[mpm]") {
  const auto message = [](const TractionSettings& t) {
    FlowConfig c = pressed();
    c.tractions.push_back(t);
    return input_error([&] { make_simulation(bar(0.0), c); });
  };
  CHECK(message({{0.0, 2.0}, {5.0, 2.0}, 1e3}) == "(no InputError)");
  CHECK_THAT(message({{5.0, 2.0}, {0.0, 2.0}, 1e3}), Contains("stretch 2"));  // soil on the left
  CHECK_THAT(message({{0.0, 9.0}, {5.0, 9.0}, 1e3}), Contains("stretch 2"));
  CHECK_THAT(message({{5.0, 2.0}, {5.0, 2.0}, 1e3}), Contains("no length"));
}
