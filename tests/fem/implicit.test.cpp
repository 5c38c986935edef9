#include "fem/implicit.hpp"

#include "model/history.hpp"
#include "tests/support/scratch.hpp"
#include "verify/fem/scene.hpp"

#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <omp.h>

using namespace flowslide;
using namespace flowslide::fem;
using Catch::Matchers::Contains;

namespace {

double ground(double t) { return 0.05 * std::pow(std::sin(2.0 * kPi * t), 2); }

/// Distorted rectangle with water up to half of its height, on rock, between free fields: every
/// kind of unknown there is.
Solver scene(const FemMaterialConfig& soil) {
  FemConfig c = config(soil, 2.0);
  c.base = {BaseMotionKind::outcrop, 400.0, 2000.0, true};
  c.sides.kind = SideKind::free_field;
  c.damping.mass = 0.5;
  c.damping.stiffness = 1e-3;
  return at_rest(section({.columns = 4, .rows = 4, .distortion = 0.1}), c);
}

Solver shake(Solver s, double end, const ImplicitSettings& settings, ImplicitRecord& record) {
  omp_set_num_threads(1);
  ImplicitSteps steps(s, settings);
  while (s.state.time < end * (1.0 - 1e-9)) steps.advance(s, record, end - s.state.time, ground);
  return s;
}

Solver shake_explicitly(Solver s, double end, double courant) {
  s.dt = end / std::ceil(end / (courant * s.dt));
  while (s.state.time < end * (1.0 - 1e-9))
    advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
  return s;
}

double largest(const std::vector<double>& a) {
  double r = 0.0;
  for (const double x : a) r = std::max(r, std::abs(x));
  return r;
}

double difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return largest(a) / largest(b);
}

}  // namespace

TEST_CASE("Anderson acceleration solves a linear problem in as many steps as it has unknowns",
          "[fem]") {
  // x + f(x) = x - (A x - b): diverges by itself
  Eigen::Matrix3d A;
  A << 4.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.0, -1.0, 5.0;
  const Eigen::Vector3d b{1.0, 2.0, 3.0}, solution = A.lu().solve(b);
  Anderson accelerated(Eigen::Vector3d{1.0, 10.0, 0.1}, 3);
  Eigen::VectorXd x = Eigen::Vector3d::Zero(), plain = x;
  for (int i = 0; i < 4; ++i) {
    accelerated.advance(x, b - A * x);
    plain += b - A * plain;
  }
  CHECK((x - solution).norm() < 1e-12);
  CHECK((plain - solution).norm() > 10.0);  // control
}

TEST_CASE("An implicit step of elastic soil needs one correction", "[fem]") {
  ImplicitRecord record;
  const Solver s = shake(scene(elastic_soil()), 0.1, {.step = 5e-3, .tolerance = 1e-9}, record);
  CHECK(s.state.step == 20);
  CHECK(record.iterations == 40);  // the matrix is the derivative of the residuals
  CHECK(record.cut == 0);
  CHECK(s.state.energy.error() < 1e-10);
  CHECK(s.state.energy.base > 0.0);
}

TEST_CASE("Implicit steps at rest stay at rest", "[fem]") {
  ImplicitRecord record;
  Solver s = scene(sand());
  const std::vector<double> pressure = s.state.pressure;
  ImplicitSteps steps(s, {});
  for (int i = 0; i < 5; ++i) steps.advance(s, record, 1.0, [](double) { return 0.0; });
  CHECK(record.iterations == 10);  // one correction each
  CHECK(largest(s.state.displacement) < 1e-12);
  CHECK(difference(s.state.pressure, pressure) < 1e-12);
}

TEST_CASE("Implicit and explicit steps approach the same motion", "[fem]") {
  constexpr double kEnd = 0.4;
  for (const bool sandy : {false, true}) {
    INFO("sand " << sandy);
    const Solver start = scene(sandy ? sand() : elastic_soil());
    const Solver exact = shake_explicitly(start, kEnd, 0.2);
    ImplicitRecord coarse_record, fine_record;
    const Solver coarse = shake(start, kEnd, {.step = 8e-3, .tolerance = 1e-6}, coarse_record);
    const Solver fine = shake(start, kEnd, {.step = 2e-3, .tolerance = 1e-6}, fine_record);
    const double error = difference(fine.state.displacement, exact.state.displacement);
    CHECK(error < 0.01);
    CHECK(difference(coarse.state.displacement, exact.state.displacement) > 2.5 * error);
    CHECK(difference(fine.state.pressure, exact.state.pressure) < 0.01);
    CHECK(fine.state.energy.error() < 1e-4);
    CHECK(fine.state.energy.base == Approx(exact.state.energy.base).epsilon(0.02));
    CHECK((fine_record.iterations > 2 * fine.state.step) == sandy);
  }
}

TEST_CASE("Euler's rule damps, and says how much", "[fem]") {
  // no damping, and a base that has stopped: the trapezoidal rule keeps the energy
  const Solver start = at_rest(section({.columns = 1, .rows = 4}), config(elastic_soil(), 2.0));
  const auto free_vibration = [&](double theta) {
    Solver s = start;
    ImplicitRecord record;
    ImplicitSteps steps(s, {.tolerance = 1e-9, .theta = theta});
    for (int i = 0; i < 100; ++i)
      steps.advance(s, record, 1.0, [](double t) { return t < 0.05 ? 0.1 : 0.0; });
    return s.state.energy;
  };
  const Energy trapezoidal = free_vibration(0.5), euler = free_vibration(1.0);
  CHECK(trapezoidal.damping == 0.0);
  CHECK(euler.damping > 0.1 * euler.base);
  CHECK(euler.error() < 1e-8);
  CHECK(trapezoidal.error() < 1e-8);
}

TEST_CASE("A step that does not converge is halved, and named if it may not be", "[fem]") {
  const Solver start = scene(sand());
  ImplicitRecord record;
  const Solver s = shake(start, 0.2, {.step = 0.02, .max_iterations = 4}, record);
  CHECK(record.cut > 0);
  CHECK(s.state.step > 10);
  CHECK(s.state.time == Approx(0.2));

  Solver stuck = start;
  record = {};
  ImplicitSteps steps(stuck, {.step = 0.02, .smallest_step = 0.02, .max_iterations = 2});
  try {
    for (int i = 0; i < 10; ++i) steps.advance(stuck, record, 1.0, ground);
    FAIL("converged");
  } catch (const NumericsError& e) {
    CHECK_THAT(e.what(), Contains("failed to converge") && Contains("implicit step") &&
                             Contains("is at element") && Contains("integration.tolerance"));
  }
  CHECK(stuck.state.time == Approx(0.02 * static_cast<double>(stuck.state.step)));
  CHECK(std::isfinite(largest(stuck.state.velocity)));
}

TEST_CASE("An implicit run can be interrupted, and says what it cost", "[fem]") {
  const SectionMesh mesh = section({.columns = 2, .rows = 4});
  GroundMotion motion{.dt = 0.01, .acceleration = {}, .origin = "test"};
  for (int i = 0; i <= 40; ++i)
    motion.acceleration.push_back(2.0 * std::sin(4.0 * kPi * motion.dt * i));
  FemConfig c = config(sand(), 4.0);
  c.output_interval = 0.07;
  c.integration.scheme = IntegrationScheme::implicit;
  const Scratch folder;
  const FemPaths once{folder / "once.h5", folder / "once"},
      parts{folder / "parts.h5", folder / "p"};
  const FemFacts facts = run_fem(mesh, motion, c, once, 1, {});
  CHECK(facts.largest_step <= 5e-3 * (1.0 + 1e-9));
  CHECK(facts.iterations > facts.steps);
  CHECK(facts.most_iterations <= c.integration.max_iterations);
  CHECK(facts.energy_error < 1e-4);
  for (int i = 0; i < 3; ++i) {
    std::atomic<bool> stop{false};
    Progress progress;
    progress.stop_requested = &stop;
    progress.report = [&](double done, std::string_view) { stop = done > 0.2 * (i + 1); };
    CHECK_THROWS_AS(run_fem(mesh, motion, c, parts, 1, progress), Interrupted);
  }
  const FemFacts continued = run_fem(mesh, motion, c, parts, 2, {});
  CHECK(continued.iterations == facts.iterations);
  CHECK(continued.cut_steps == facts.cut_steps);
  CHECK(read_text_file(folder / "parts.h5") == read_text_file(folder / "once.h5"));
}
