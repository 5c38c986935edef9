#include "transfer/zone/energy.hpp"

#include "core/check.hpp"
#include "tests/transfer/zone_grid.hpp"

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
