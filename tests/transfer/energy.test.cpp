#include "transfer/zone/energy.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "tests/transfer/zone_grid.hpp"
#include "transfer/zone/sliding.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

std::vector<double> of_all(const QuadMesh& mesh, double density) {
  return std::vector<double>(mesh.num_elements(), density);
}

}  // namespace

TEST_CASE("a rigid translation has the energy of its mass and none relative to its base",
          "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(5, 4, 2.0, 0.5, 7);
  const std::vector<std::int32_t> all = all_elements(mesh);
  const std::vector<double> mass = element_masses(mesh, all, of_all(mesh, 1800.0));
  const std::vector<Vec2> velocity(mesh.num_nodes(), Vec2{3.0, -4.0});
  const KineticEnergy energy = kinetic_energy(mesh, all, mass, velocity, lowest_nodes(mesh, all));
  const double expected = 0.5 * 1800.0 * 10.0 * 2.0 * 25.0;
  CHECK(energy.absolute == Approx(expected).epsilon(1e-14));
  CHECK(energy.base == Approx(expected).epsilon(1e-14));
  CHECK(energy.relative == Approx(0.0).margin(1e-14 * expected));
}

TEST_CASE("simple shear above a fixed base", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(1, 3, 1.0, 1.0, 7);
  const std::vector<std::int32_t> all = all_elements(mesh);
  std::vector<Vec2> velocity;
  for (const Vec2& x : mesh.nodes) velocity.push_back({2.0 * x[1], 0.0});
  // Element means 1, 3, 5 m/s with 1000 kg each.
  const std::vector<double> mass = element_masses(mesh, all, of_all(mesh, 1000.0));
  const KineticEnergy energy = kinetic_energy(mesh, all, mass, velocity, lowest_nodes(mesh, all));
  CHECK(energy.absolute == Approx(0.5 * 1000.0 * (1.0 + 9.0 + 25.0)));
  CHECK(energy.relative == energy.absolute);
  CHECK(energy.base == 0.0);
}

TEST_CASE("only listed elements have mass and a base", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(2, 2, 1.0, 1.0, 7);
  const std::vector<std::int32_t> upper{2, 3};
  CHECK(lowest_nodes(mesh, upper) == std::vector<std::int32_t>{3, 4, 5});
  const std::vector<double> density{1.0, 2.0, 10.0, 20.0};
  CHECK(element_masses(mesh, upper, density) == std::vector<double>{10.0, 20.0});
}

TEST_CASE("shaking leaves the energy of the mean velocity small, sliding does not", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(4, 4, 1.0, 1.0, 1);
  const std::vector<std::int32_t> elements = all_elements(mesh);
  const std::vector<double> mass(elements.size(), 100.0);
  const std::vector<std::int32_t> base = lowest_nodes(mesh, elements);
  // Amplitude 5 cm at 3 Hz (0.94 m/s) rising with height, whole periods in the mean of a second;
  // the base goes along 0.1 m/s, the top row of elements slides at 0.5 m/s from 3 s on.
  SlidingEnergy sliding(1.0);
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.1 * i;
    std::vector<Vec2> u;
    for (const Vec2& x : mesh.nodes) {
      const double shaken = 0.05 * x[1] / 4.0 * flowslide::sin(2.0 * kPi * 3.0 * t);
      const double slid = x[1] > 2.5 ? 0.5 * std::max(0.0, t - 3.0) : 0.0;
      u.push_back({0.1 * t + shaken + slid, 0.0});
    }
    const SlidingEnergy::Values e = sliding.append(t, mesh, elements, mass, u, base);
    if (t >= 1.0) CHECK(e.base == Approx(0.5 * 1600.0 * 0.01));
    if (t >= 1.0 && t <= 3.0) CHECK(e.section == Approx(0.0).margin(1e-9));
    // rows of nodes at 3 and 4 m slide: the top row of elements whole, the row below by half
    if (t >= 4.0) CHECK(e.section == Approx(0.5 * 400.0 * (0.25 + 0.0625)));
  }
}

TEST_CASE("before its first instant a record has stood still", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(1, 1, 1.0, 1.0, 1);
  const std::vector<std::int32_t> elements = all_elements(mesh);
  const std::vector<double> mass{100.0};
  const std::vector<std::int32_t> base = lowest_nodes(mesh, elements);
  SlidingEnergy sliding(1.0);
  std::vector<Vec2> u(4, Vec2{7.0, 0.0});
  CHECK(sliding.append(20.0, mesh, elements, mass, u, base).base == 0.0);
  for (Vec2& x : u) x[0] += 0.2;
  // 0.2 m in 0.1 s, after 0.9 s at rest
  CHECK(sliding.append(20.1, mesh, elements, mass, u, base).base == Approx(0.5 * 100.0 * 0.04));
}
