#include "core/check.hpp"
#include "tests/support/scratch.hpp"
#include "tests/transfer/fixture_dam.hpp"
#include "transfer/zone/zone.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

std::size_t sample_near(const ZoneHistory& h, double t) {
  return static_cast<std::size_t>(
      std::ranges::min_element(h.time, {}, [t](double s) { return std::abs(s - t); }) -
      h.time.begin());
}

}  // namespace

TEST_CASE("the dam of the fixture liquefies as its README says", "[transfer]") {
  const Scratch scratch;
  const auto path = scratch / "history.h5";
  import_opensees(test::shaken_fixture_dam(), path);
  ZoneConfig c;
  c.windows = {{"crest", {-40.0, -20.0}}, {"pond", {-70.0, -50.0}}};
  c.liquefiable = {"tailings"};
  c.pond_surface = 30.0;
  c.box.left = -340.0;
  c.box.right = 87.5;
  c.strength.table = {{25e3, 3.0e3}, {50e3, 4.3e3}, {100e3, 6.5e3}, {250e3, 11.1e3}, {325e3, 12e3}};
  const FemHistory history(path);
  const LiquefactionZone zone = find_zone(history, c);
  const ZoneHistory& h = zone.history;
  REQUIRE(h.window_names == std::vector<std::string>{"crest", "pond"});
  REQUIRE(h.time.size() == 31);

  // One element size, the resolution of a depth read at nodes.
  const double tolerance = 2.0;
  for (std::size_t i = 0; h.time[i] < 5.4; ++i) {
    CHECK(h.depth[0][i] == 0.0);
    CHECK(h.depth[1][i] == 0.0);
  }
  CHECK(h.depth[0][sample_near(h, 5.5)] == Approx(6.0).margin(tolerance));
  CHECK(h.depth[1][sample_near(h, 5.5)] == Approx(7.0).margin(tolerance));
  CHECK(h.depth[0][sample_near(h, 6.0)] == Approx(27.0).margin(tolerance));
  CHECK(h.depth[1][sample_near(h, 6.0)] == Approx(25.0).margin(tolerance));

  // Strained without change of volume, and the record stops before the mesh is distorted.
  CHECK(h.distortion_centre.back() == Approx(1.0).margin(1e-3));
  CHECK(h.distortion_gauss.back() > 0.99);
  CHECK(h.distortion_gauss.back() < 1.0);
  CHECK(zone.transfer_frame == 30);
  // The slide stands out from the shaking by ten; its record ends before it has lasted for long.
  CHECK(h.sliding_energy[sample_near(h, 5.75)] == Approx(33e3).epsilon(0.02));
  CHECK(h.sliding_energy[sample_near(h, 7.0)] == Approx(360e3).epsilon(0.02));
  CHECK_THAT(zone.transfer_reason, Catch::Contains("exceeds 2 times its pre-failure envelope from "
                                                   "6.26 s to the end of the record"));
  // OpenSees' pore pressures have a saw-tooth; single nodes cross the threshold first.
  CHECK(std::ranges::any_of(
      zone.notes, [](const std::string& n) { return n.starts_with("r_u reaches 4 at node 302"); }));
  CHECK(h.depth_any[0][sample_near(h, 5.75)] > h.depth[0][sample_near(h, 5.75)]);

  // The tailings carry about 8.5 kPa per metre below the pond.
  const QuadMesh& mesh = history.mesh();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Vec2 x = centroid(corners(mesh, mesh.nodes, e));
    if (mesh.element_material[e] != 168 || x[0] < -330.0 || x[0] > -100.0 || x[1] > 25.0) continue;
    CHECK(zone.sigma_v0[e] == Approx(8.5e3 * (30.0 - x[1])).epsilon(0.03));
  }
}
