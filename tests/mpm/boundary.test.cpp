#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

TEST_CASE("The ground is a polyline, level beyond its ends", "[mpm]") {
  const Ground g{{0.0, 10.0, 10.0, 20.0}, {0.0, 5.0, 1.0, 1.0}, 0.5};
  CHECK(g.level(-3.0) == 0.0);
  CHECK(g.level(4.0) == Approx(2.0));
  CHECK(g.level(10.0 - 1e-9) == Approx(5.0));
  CHECK(g.level(10.0 + 1e-9) == Approx(1.0));
  CHECK(g.level(99.0) == 1.0);
}

TEST_CASE("The nearest piece of the ground gives distance and normal", "[mpm]") {
  const Ground g{{0.0, 10.0, 10.0, 20.0}, {0.0, 0.0, 5.0, 5.0}, 0.5};  // a step up
  const auto check = [&](double x, double y, double distance, double nx, double ny) {
    const Nearest n = g.nearest(x, y);
    CAPTURE(x, y);
    CHECK(n.distance == Approx(distance));
    CHECK(n.normal[0] == Approx(nx).margin(1e-12));
    CHECK(n.normal[1] == Approx(ny).margin(1e-12));
  };
  check(5.0, 2.0, 2.0, 0.0, 1.0);
  check(9.0, 3.0, 1.0, -1.0, 0.0);    // before the face of the step
  check(11.0, 2.0, -1.0, -1.0, 0.0);  // behind it
  check(15.0, 4.0, -1.0, 0.0, 1.0);
  check(-50.0, -1.0, -1.0, 0.0, 1.0);  // level beyond the ends
  check(60.0, 7.0, 2.0, 0.0, 1.0);
  const Ground slope{{0.0, 10.0}, {0.0, 10.0}, 0.5};
  const Nearest n = slope.nearest(5.0, 7.0);
  CHECK(n.distance == Approx(std::sqrt(2.0)));
  CHECK(n.normal[0] == Approx(-std::sqrt(0.5)));
}

namespace {

/// A block of elastic soil under its weight, lattice and ground turned by `degrees`.
struct Slope {
  double angle;
  ParticleSet points;
  FlowConfig config;
  Slope(double degrees, double friction) : angle(degrees * kPi / 180.0) {
    points.materials = {elastic(5e6, 0.3)};
    add_lattice(points, {0.0, 0.0, 2.0, 1.0}, 0.125, 1800.0);
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t q = 0; q < points.size(); ++q) {
      auto& x = points.position[q];
      const double weight = 1800.0 * 9.81 * c * (1.0 - x[1]);  // carried by the normal stress
      points.stress[q] = {-weight * s * s, -weight * c * c, 0.0, weight * s * c, 0.0, 0.0};
      x = {x[0] * c - x[1] * s, x[0] * s + x[1] * c, 0.0};
    }
    config = free_space(0.25);
    config.gravity = 9.81;
    config.ground.friction = friction;
    config.ground.surface = {{-30.0 * c, -30.0 * s}, {30.0 * c, 30.0 * s}};
  }
  /// How far the middle of the block goes down the slope in `time`.
  [[nodiscard]] double slid(double time) const {
    Run run(points, config);
    const auto middle = [&] {
      double sum = 0.0;
      for (std::size_t q = 0; q < run.s.points.size(); ++q)
        sum -= run.s.points.x[0][q] * std::cos(angle) + run.s.points.x[1][q] * std::sin(angle);
      return sum / double(run.s.points.size());
    };
    const double start = middle();
    run.run_to(time);
    return (middle() - start) * (time * time) / (run.s.time * run.s.time);
  }
};

}  // namespace

TEST_CASE("A block slides down a slope as Coulomb says, or sticks", "[mpm]") {
  const double degrees = GENERATE(15.0, 30.0);
  const double along = 9.81 * std::sin(degrees * kPi / 180.0);
  const double across = 9.81 * std::cos(degrees * kPi / 180.0);
  for (const double friction : {0.0, 0.1}) {
    const double exact = 0.125 * (along - friction * across);
    CAPTURE(degrees, friction);
    CHECK(Slope(degrees, friction).slid(0.5) == Approx(exact).epsilon(0.02));
  }
  CHECK(Slope(degrees, 1.5).slid(0.5) < 0.01);
}

TEST_CASE("Where the ground lies between the nodes hardly matters", "[mpm]") {
  const double offset = GENERATE(0.0, 0.3, 0.5, 0.8);
  Slope slope(30.0, 0.2);
  slope.config.grid_origin = {0.0, offset * slope.config.cell};
  const double exact = 0.125 * 9.81 * (0.5 - 0.2 * std::sqrt(0.75));
  CAPTURE(offset);
  CHECK(slope.slid(0.5) == Approx(exact).epsilon(0.02));
}

TEST_CASE("The ground lets go of what leaves it, a roller does not", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.0)};
  add_lattice(p, {0.0, 0.0, 1.0, 1.0}, 0.25, 1000.0);
  FlowConfig config = free_space(0.5);
  config.ground.surface = {{0.0, 0.0}};
  for (auto& v : p.velocity) v = {0.0, 0.5, 0.0};
  Run up(p, config);
  up.run_to(1.0);
  for (std::size_t q = 0; q < up.s.points.size(); ++q) REQUIRE(up.s.points.v[1][q] == Approx(0.5));

  config.ground.surface = {{0.0, -1e6}};
  config.left_roller = 0.0;
  for (auto& v : p.velocity) v = {0.02, 0.0, 0.0};
  Run held(p, config);
  held.run_to(5.0);
  const auto& x = held.s.points.x[0];
  CHECK(*std::min_element(x.begin(), x.end()) < 0.2);  // free, it would be at 0.225
}
