#include "fem/time_step.hpp"
#include "verify/fem/scene.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <omp.h>

using namespace flowslide;
using namespace flowslide::fem;

namespace {

const Rectangle kColumn{.columns = 2, .rows = 8, .width = 4.0, .height = 8.0, .distortion = 0.1};

void shake(Solver& s, double duration) {
  const auto ground = [](double t) { return 0.15 * std::sin(2.0 * kPi * 1.5 * t); };
  while (s.state.time < duration) advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
}

}  // namespace

TEST_CASE("A section at rest stays at rest", "[fem]") {
  omp_set_num_threads(1);
  Solver s = at_rest(section(kColumn), config(sand(), 8.0));
  CHECK(out_of_balance(s) < 1e-12);
  const std::vector<double> before = s.state.pressure;
  while (s.state.time < 10.0) advance(s, {});
  double drift = 0.0, excess = 0.0;
  for (const double u : s.state.displacement) drift = std::max(drift, std::abs(u));
  for (std::size_t i = 0; i < before.size(); ++i)
    excess = std::max(excess, std::abs(s.state.pressure[i] - before[i]));
  CHECK(drift < 1e-4 * kColumn.height);
  CHECK(excess < 0.01 * 900.0 * 9.81);  // r_u of the first metre
}

TEST_CASE("Energy is balanced to rounding, of PM4Sand that liquefies too", "[fem]") {
  omp_set_num_threads(1);
  FemConfig c = config(sand(), 8.0);
  c.damping.mass = 0.1;
  c.damping.stiffness = 1e-3;
  Solver s = at_rest(section(kColumn), c);
  shake(s, 3.0);
  CHECK(s.state.energy.base > 1e3);
  CHECK(s.state.energy.viscous > 0.0);
  CHECK(s.state.energy.error() < 1e-10);
  double r_u = 0.0;
  for (std::size_t i = 0; i < s.state.pressure.size(); ++i) {
    const double depth = 8.0 - s.model.mesh.nodes[i][1];
    if (depth > 1.5 && depth < 6.0)
      r_u = std::max(r_u, (s.state.pressure[i] - 9810.0 * depth) / (900.0 * 9.81 * depth));
  }
  CHECK(r_u > 0.7);
}

TEST_CASE("One and two threads give the same bits", "[fem]") {
  std::array<State, 2> end;
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    Solver s = at_rest(section({.columns = 12, .rows = 8, .distortion = 0.1}), config(sand(), 4.0));
    shake(s, 45.0 * s.dt);
    end[threads - 1] = s.state;
  }
  omp_set_num_threads(1);
  CHECK(end[0].displacement == end[1].displacement);
  CHECK(end[0].pressure == end[1].pressure);
  CHECK(end[0].stress == end[1].stress);
  CHECK(end[0].energy.deformation == end[1].energy.deformation);
}

TEST_CASE("Motion that runs away ends with the element and the time", "[fem]") {
  Solver s = at_rest(section(kColumn), config(elastic_soil(), 8.0), 1.5);
  try {
    shake(s, 10.0);
    FAIL("an unstable step must be noticed");
  } catch (const NumericsError& e) {
    CHECK_THAT(e.what(), Catch::Matchers::Contains("element ") && Catch::Matchers::Contains(" s"));
  }
}

TEST_CASE("The bound of the step is close to the stability limit", "[fem]") {
  const auto grows = [](double courant) {
    FemConfig c = config(elastic_soil(), 8.0);
    c.damping.stiffness = 2e-4;
    Solver s = at_rest(section(kColumn), c, courant);
    try {
      shake(s, 1.0);
    } catch (const NumericsError&) {
      return true;
    }
    for (const double v : s.state.velocity)
      if (!(std::abs(v) < 100.0)) return true;
    return false;
  };
  CHECK_FALSE(grows(1.0));
  CHECK(grows(1.5));
}

TEST_CASE("The bound of the step never lies below the largest root", "[fem]") {
  // Three equal roots are those of a square element without Poisson's ratio.
  const std::vector<Eigen::Vector3d> roots{
      {1.0, 1.0, 1.0},          {1.0, 1.0, 0.3},  {1.0, 1.0 - 1e-7, 1.0 - 2e-7},
      {1.0, 1.0 - 1e-9, 0.999}, {1.0, 1e-3, 0.0}, {1.0, 0.7, 0.4}};
  for (const Eigen::Vector3d& r : roots) {
    for (int turn = 0; turn < 50; ++turn) {
      const Eigen::Quaterniond way(1.0, 0.3 * turn, 0.7, 1.0 - 0.1 * turn);
      const Eigen::Matrix3d axes = way.normalized().toRotationMatrix();
      const double scale = 4e7 * (1.0 + 0.37 * turn);
      const double found =
          largest_eigenvalue(scale * (axes * r.asDiagonal() * axes.transpose())) / scale;
      CAPTURE(r, turn);
      CHECK(found >= 1.0 - 1e-14);  // rounding of the matrix
      CHECK(found <= 1.0 + 3e-6);
    }
  }
  CHECK(largest_eigenvalue(Eigen::Matrix3d::Zero()) == 0.0);
}
