#include "transfer/zone/zone_r_u.hpp"

#include "core/check.hpp"
#include "tests/transfer/zone_grid.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Two elements side by side, areas 1 and 3, with sigma'_v0 of 100 and 20 kPa.
struct Pair {
  QuadMesh mesh = rectangle_mesh(2, 1, 1.0, 1.0, 1);
  FemFrame gravity;
  std::vector<std::uint8_t> liquefiable{1, 1};
  Pair() {
    mesh.nodes[2][0] = mesh.nodes[5][0] = 4.0;
    gravity.pore_pressure.assign(6, 5e3);
    gravity.stress = {{{0.0, -100e3, 0.0, 0.0}}, {{0.0, -20e3, 0.0, 0.0}}};
  }
  [[nodiscard]] std::vector<double> r_u(const RuConfig& config) const {
    const RuReference r = r_u_reference(mesh, gravity, liquefiable, config);
    return r_u_at_nodes(mesh, r, std::vector<double>(6, 25e3), 1.0);
  }
};

}  // namespace

TEST_CASE("r_u uses the area-weighted stress of the adjacent elements", "[transfer]") {
  const std::vector<double> r_u = Pair().r_u({});
  CHECK(r_u[0] == Approx(0.2));
  CHECK(r_u[1] == Approx(20.0 / (0.25 * 100.0 + 0.75 * 20.0)));
  CHECK(r_u[2] == Approx(1.0));
}

TEST_CASE("r_u element by element averages the ratios", "[transfer]") {
  const std::vector<double> r_u = Pair().r_u({.sigma_v0 = SigmaSource::element});
  CHECK(r_u[0] == Approx(0.2));
  CHECK(r_u[1] == Approx(0.25 * 0.2 + 0.75 * 1.0));
  CHECK(r_u[2] == Approx(1.0));
}

TEST_CASE("nodes below the floor or outside the soil have no r_u", "[transfer]") {
  Pair pair;
  const RuReference r = r_u_reference(pair.mesh, pair.gravity, pair.liquefiable, {.floor = 30e3});
  CHECK_FALSE(is_set(r.per_stress[2]));
  CHECK(is_set(r.per_stress[1]));
  REQUIRE(r.notes.size() == 1);
  CHECK_THAT(r.notes[0], Catch::StartsWith("2 nodes") && Catch::Contains("below 30 kPa"));
  CHECK(r.sigma_v0 == std::vector<double>{100e3, 20e3});

  pair.liquefiable = {1, 0};
  const std::vector<double> r_u = pair.r_u({});
  CHECK(r_u[1] == Approx(0.2));
  CHECK_FALSE(is_set(r_u[2]));

  pair.gravity.stress[0][1] = 10.0;  // tension: no stress to divide by, even without a floor
  CHECK_FALSE(is_set(pair.r_u({.floor = 0.0})[0]));
  CHECK_FALSE(is_set(pair.r_u({.sigma_v0 = SigmaSource::element, .floor = 0.0})[0]));
}

TEST_CASE("numbers that r_u needs must be finite", "[transfer]") {
  Pair pair;
  const RuReference r = r_u_reference(pair.mesh, pair.gravity, pair.liquefiable, {});
  std::vector<double> u(6, 25e3);
  u[4] = kUnset;
  CHECK_THROWS_WITH(r_u_at_nodes(pair.mesh, r, u, 2.5),
                    Catch::Contains("node 5") && Catch::Contains("2.5 s"));
  pair.gravity.stress[1][1] = kUnset;
  CHECK_THROWS_WITH(pair.r_u({}), Catch::StartsWith("element 2"));
}

TEST_CASE("element means leave unset nodes out", "[transfer]") {
  const QuadMesh mesh = rectangle_mesh(2, 1, 1.0, 1.0, 1);
  const std::vector<double> mean =
      element_means(mesh, std::vector<double>{0.2, kUnset, kUnset, 0.4, kUnset, kUnset});
  CHECK(mean[0] == Approx(0.3));
  CHECK_FALSE(is_set(mean[1]));
}
