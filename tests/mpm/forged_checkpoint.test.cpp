#include "core/check.hpp"
#include "core/hash.hpp"
#include "mpm/solver/checkpoint.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/support/limited_files.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Two soils between an absorbing plane and an outlet, with points that sleep: every kind of array.
struct Scene {
  ParticleSet particles;
  FlowConfig config = free_space(0.5);

  Scene() {
    particles.materials = {liquefied(1e6, 500.0), elastic(5e6, 0.3)};
    add_lattice(particles, {0.0, 1.0, 2.0, 4.0}, 0.25, 1800.0);
    add_lattice(particles, {0.0, 0.0, 2.0, 1.0}, 0.25, 1900.0, 1);
    config.gravity = 9.81;
    config.ground.surface = {{0.0, 0.0}};
    config.ground.friction = 0.1;
    config.absorbing.left = 0.0;
    config.end = 1.5;
    config.frame_interval = 0.5;
    config.outlet.right = 3.0;
    config.sleep = SleepSettings{};
  }
  [[nodiscard]] Simulation<2> start() const { return make_simulation(particles, config); }
};

struct State {
  Simulation<2> s;
  RunState run;
};

State state_of(const Scene& scene) {
  Run run(scene.particles, scene.config);
  run.run_to(1.2);
  RunState r;
  r.frames = 3;
  r.samples = 2;
  r.next_frame = 1.5;
  r.next_sample = 1.3;
  r.first_dt = run.s.dt;
  return {run.s, r};
}

/// The message with which a checkpoint is refused.
std::string refusal(const Scene& scene, const std::filesystem::path& path) {
  Simulation<2> s = scene.start();
  RunState run;
  try {
    read_checkpoint(path, s, run);
    StepScratch<2> scratch(1);
    prepare(s, scratch, false);
    check_walls(path, s);
  } catch (const FileError& e) {
    return e.what();
  }
  return "(none)";
}

/// A good checkpoint that tests change.
struct Forgery {
  Scene scene;
  Scratch folder;
  State good = state_of(scene);

  /// What is said of it after `change` of the simulation and the run's memory.
  [[nodiscard]] std::string with(
      const std::function<void(Simulation<2>&, RunState&)>& change) const {
    State state = good;
    change(state.s, state.run);
    write_checkpoint(folder / "c", state.s, state.run);
    return refusal(scene, folder / "c");
  }
};

void lengthen(auto& array) { array.push_back(array.back()); }

}  // namespace

TEST_CASE("A checkpoint whose arrays have other lengths is refused", "[mpm]") {
  const Forgery forgery;
  REQUIRE(forgery.with([](auto&, auto&) {}) == "(none)");  // control
  CHECK_THAT(forgery.with([](auto& s, auto&) { lengthen(s.points.mass); }),
             Contains("number of points"));
  CHECK_THAT(forgery.with([](auto& s, auto&) { lengthen(s.points.x[1]); }), Contains("length"));
  CHECK_THAT(forgery.with([](auto& s, auto&) { s.points.sigma[3].clear(); }), Contains("length"));
  CHECK_THAT(forgery.with([](auto& s, auto&) { lengthen(s.gone.index); }), Contains("length"));
}

TEST_CASE("A checkpoint whose times and counts cannot be those of a run is refused", "[mpm]") {
  const Forgery forgery;
  REQUIRE(forgery.good.s.gone.size() > 0);
  const auto times = [&](auto change) {
    CHECK_THAT(forgery.with(change), Contains("times, steps"));
  };
  times([](auto& s, auto&) { s.dt = kNan; });
  times([](auto& s, auto&) { s.dt = 0.0; });
  times([](auto& s, auto&) { s.time = -1e300; });
  times([](auto& s, auto&) { s.step = -1; });
  times([](auto& s, auto&) { s.drift = kNan; });
  times([](auto& s, auto&) { s.last.max_speed2 = kNan; });
  times([](auto&, auto& run) { run.next_sample = -1e300; });  // the loop over it would not end
  times([](auto&, auto& run) { run.first_dt = kNan; });
  times([](auto&, auto& run) { run.frames = 0; });
}

TEST_CASE("A checkpoint whose points or tiles cannot be those of a run is refused", "[mpm]") {
  const Forgery forgery;
  REQUIRE(forgery.good.s.tiling.tiles.size() > 2);
  const auto point = [&](auto change) {
    CHECK_THAT(forgery.with([&](auto& s, auto&) { change(s.points); }), Contains("point"));
  };
  point([](auto& p) { p.index[0] = p.index[1]; });
  point([](auto& p) { p.index[0] = -1; });
  point([](auto& p) { p.index[0] = 1 << 30; });
  point([](auto& p) { p.material[0] = 7; });
  point([](auto& p) { p.mass[0] = 0.0; });
  point([](auto& p) { p.volume[0] = kNan; });
  point([](auto& p) { p.v[1][0] = kNan; });
  point([](auto& p) { p.x[0][0] = 1e300; });
  point([](auto& p) { p.x[0][0] += 100.0; });

  const auto tile = [&](auto change) {
    CHECK_THAT(forgery.with([&](auto& s, auto&) { change(s.tiling); }), Contains("tile"));
  };
  tile([](auto& t) { t.tiles[0].last += 1; });
  tile([](auto& t) { t.tiles[1].first = -4; });
  tile([](auto& t) { t.tiles.back().last = 1 << 30; });
  tile([](auto& t) { t.tiles[0].block[0] = std::numeric_limits<std::int32_t>::min(); });
  tile([](auto& t) { t.tiles[0].block[0] += 2; });
  tile([](auto& t) { t.tiles.pop_back(); });
  tile([](auto& t) { t.run_first[1] = 1 << 30; });
  tile([](auto& t) { t.run_first.pop_back(); });
  tile([](auto& t) { t.runs[0].last = 0; });
  tile([](auto& t) { t.runs[0].material = 9; });
}

TEST_CASE("A checkpoint with another sleep, or other planes and walls, is refused", "[mpm]") {
  const Forgery forgery;
  REQUIRE(!forgery.good.s.contact.absorbing.dashpots.empty());
  REQUIRE(!forgery.good.s.sleep.asleep.empty());
  CHECK_THAT(forgery.with([](auto& s, auto&) { s.sleep.asleep.pop_back(); }), Contains("sleeping"));
  CHECK_THAT(forgery.with([](auto& s, auto&) { s.sleep.place[1].clear(); }), Contains("sleeping"));
  const auto plane = [&](auto change) {
    CHECK_THAT(forgery.with([&](auto& s, auto&) { change(s.contact.absorbing.dashpots[0]); }),
               Contains("absorbing"));
  };
  plane([](auto& d) { d.plane = -1; });
  plane([](auto& d) { d.plane = 3; });
  plane([](auto& d) { d.line[1] = 1 << 30; });
  plane([](auto& d) { d.area = kNan; });
  CHECK_THAT(forgery.with([](auto& s, auto&) { s.contact.impulse.pop_back(); }), Contains("walls"));
}

TEST_CASE("Checkpoints with random changes under a right checksum are read or refused", "[mpm]") {
  const Scene scene;
  const Scratch folder;
  const State good = state_of(scene);
  write_checkpoint(folder / "c", good.s, good.run);
  const std::string bytes = read_text_file(folder / "c");
  const std::string body = bytes.substr(0, bytes.size() - 64);
  std::mt19937 random(1);
  const int ended = test::with_limited_files(1 << 24, [&] {
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
      std::string forged = body;
      // Words, in the half of the tries those at the start, where sizes and counts stand.
      const std::size_t range = i % 2 ? body.size() / 8 : 60;
      for (int k = 0; k < 3; ++k)
        for (int b = 0; b < 8; ++b) forged[8 * (1 + random() % (range - 1)) + b] = char(random());
      folder.write("forged", forged + sha256(forged));
      refused += refusal(scene, folder / "forged") != "(none)";
    }
    if (refused < 100) throw InputError("most of them are refused");
  });
  CHECK(ended == 0);
}
