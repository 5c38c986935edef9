#include "mpm/run/extrude.hpp"

#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <atomic>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

/// A column of weak soil at a wall that spreads to the right.
struct Spreading {
  ParticleSet points;
  FlowConfig config = free_space(0.5);

  Spreading() {
    points.materials = {liquefied(1e6, 3e3)};
    add_lattice(points, {0.0, 0.0, 3.0, 3.0}, 0.25, 1800.0);
    points.pore_pressure.assign(points.size(), 0.0);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const double weight = -1800.0 * 9.81 * (3.0 - points.position[q][1]);
      points.stress[q] = {weight, weight, weight, 0.0, 0.0, 0.0};
    }
    config.gravity = 9.81;
    config.ground.surface = {{0.0, 0.0}};
    config.ground.friction = 0.6;
    config.left_roller = 0.0;
    config.transfer = Transfer::aflip;  // whose losses do not depend on the step
    points.toe = 3.0;
    config.end = 0.6;
    config.frame_interval = 1.0;
  }
  /// Of each point of the section its mean way along x.
  [[nodiscard]] std::vector<double> ways(FlowFacts* facts = nullptr) const {
    const Scratch folder;
    const FlowFacts f = run_flow(points, config, {folder / "mpm.h5", folder / "checkpoint"}, 1, {});
    if (facts) *facts = f;
    const MpmHistory history(folder / "mpm.h5");
    const MpmFrame end = history.frame(history.num_frames() - 1);
    const std::size_t copies = end.position.size() / points.size();
    std::vector<double> way(points.size(), 0.0);
    for (std::size_t i = 0; i < end.position.size(); ++i)
      way[i / copies] += (end.position[i][0] - history.initial().position[i][0]) / double(copies);
    return way;
  }
};

double mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double v : x) sum += v / double(x.size());
  return sum;
}

}  // namespace

TEST_CASE("An extruded section keeps mass, state and order", "[mpm]") {
  Spreading scene;
  ParticleSet& flat = scene.points;
  flat.velocity[5] = {1.0, 2.0, 0.0};
  flat.stress[5] = {-1.0, -2.0, -3.0, 4.0, 0.0, 0.0};
  flat.history["plastic_strain"].assign(flat.size(), 0.0);
  flat.history["plastic_strain"][5] = 0.25;
  const ParticleSet deep = extrude(flat, 2.1);  // 0.25 m apart: 8 slices of 0.2625 m
  REQUIRE(deep.size() == 8 * flat.size());
  check(deep);
  double before = 0.0, after = 0.0;
  for (const double m : flat.mass) before += m;
  for (const double m : deep.mass) after += m;
  CHECK(after == Approx(2.1 * before));
  for (const std::size_t slice : {0, 7}) {
    const std::size_t q = 5 * 8 + slice;
    CHECK(deep.position[q][0] == flat.position[5][0]);
    CHECK(deep.position[q][1] == Approx(0.2625 * (double(slice) + 0.5)));
    CHECK(deep.position[q][2] == flat.position[5][1]);
    CHECK(deep.velocity[q] == std::array{1.0, 0.0, 2.0});
    CHECK(deep.stress[q] == std::array{-1.0, -3.0, -2.0, 0.0, 0.0, 4.0});
    CHECK(deep.history.at("plastic_strain")[q] == 0.25);
  }
  CHECK_THAT(input_error([&] { extrude(deep, 1.0); }), Contains("3 dimensions"));
  CHECK_THAT(input_error([&] { extrude(flat, 1e7); }), Contains("extrude.width"));
}

TEST_CASE("Between smooth sides a valley runs out as its section, between rough ones less",
          "[mpm]") {
  Spreading scene;
  FlowFacts plane, smooth;
  const std::vector<double> in_plane = scene.ways(&plane);
  scene.config.extrude = ExtrudeSettings{1.5, Sides::smooth};
  const std::vector<double> in_valley = scene.ways(&smooth);
  REQUIRE(mean(in_plane) > 0.2);
  CHECK(mean(in_valley) == Approx(mean(in_plane)).epsilon(0.01));
  double off = 0.0;
  for (std::size_t q = 0; q < in_plane.size(); ++q)
    off = std::max(off, std::abs(in_valley[q] - in_plane[q]));
  CHECK(off < 0.1 * scene.config.cell);
  CHECK(smooth.last.runout >= plane.last.runout);  // by the fifth point of all slices
  CHECK(std::abs(smooth.last.energy_error) < 0.02);
  scene.config.extrude->sides = Sides::rough;
  CHECK(mean(scene.ways()) < 0.9 * mean(in_plane));
  scene.config.extrude->sides = Sides::open;  // falls apart sideways too
  CHECK(mean(scene.ways()) < 0.9 * mean(in_plane));
}

TEST_CASE("An interrupted and continued valley has the same bytes", "[mpm]") {
  Spreading scene;
  scene.config.end = 0.2;
  scene.config.frame_interval = 0.05;
  scene.config.extrude = ExtrudeSettings{1.0, Sides::rough};
  const Scratch once, often;
  const auto run = [&](const Scratch& folder, const Progress& progress) {
    run_flow(scene.points, scene.config, {folder / "mpm.h5", folder / "checkpoint"}, 1, progress);
  };
  run(once, {});
  static const std::atomic<bool> stop{true};
  Progress stopping;
  stopping.stop_requested = &stop;
  for (int i = 0; i < 3; ++i) REQUIRE_THROWS_AS(run(often, stopping), Interrupted);
  run(often, {});
  CHECK(read_text_file(often / "mpm.h5") == read_text_file(once / "mpm.h5"));
}
