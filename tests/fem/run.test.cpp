#include "model/history.hpp"
#include "tests/support/scratch.hpp"
#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

namespace {

GroundMotion sine(double amplitude, double duration) {
  GroundMotion m{.dt = 0.01, .acceleration = {}, .origin = "test"};
  const auto samples = std::lround(duration / m.dt) + 1;
  for (long i = 0; i < samples; ++i)
    m.acceleration.push_back(amplitude * std::sin(4.0 * kPi * m.dt * static_cast<double>(i)));
  return m;
}

FemPaths in(const Scratch& folder, const std::string& name) {
  return {folder / (name + ".h5"), folder / (name + ".checkpoint")};
}

}  // namespace

TEST_CASE("A run writes a history that starts at rest and follows the ground", "[fem]") {
  const SectionMesh s = section({.columns = 2, .rows = 4});
  FemConfig c = config(sand(), 4.0);
  c.output_interval = 0.1;
  const Scratch folder;
  const FemFacts f = run_fem(s, sine(1.0, 0.5), c, in(folder, "history"), 1, {});
  CHECK(f.end_time == Approx(0.5));
  CHECK(f.energy_error < 1e-4);  // changes of the step cost some
  CHECK(f.out_of_balance < 1e-12);
  const FemHistory h(folder / "history.h5");
  REQUIRE(h.times().size() == 5);
  CHECK(h.times()[1] == Approx(0.2));
  CHECK(h.mesh().num_elements() == s.mesh.num_elements());
  CHECK(h.gravity().displacement[7] == Vec2{0.0, 0.0});
  CHECK(h.gravity().pore_pressure[0] == Approx(4.0 * 9810.0));
  // the rigid base: integral of the motion, v = (1 - cos(w t)) a/w
  const double w = 4.0 * kPi, t = 0.4;
  CHECK(h.frame(3).displacement[1][0] == Approx((t - std::sin(w * t) / w) / w).epsilon(0.01));
  CHECK(h.frame(3).displacement[1][1] == 0.0);
}

TEST_CASE("The damping of Newmark's method comes on top of the soil's", "[fem]") {
  const SectionMesh s = section({.columns = 2, .rows = 4});
  FemConfig c = config(sand(), 4.0);
  const Scratch folder;
  const auto last = [&](const std::string& name) {
    run_fem(s, sine(1.0, 0.5), c, in(folder, name), 1, {});
    return FemHistory(folder / (name + ".h5")).frame(1).displacement;
  };
  c.damping.stiffness = 1e-3;
  const auto soil = last("soil");
  c.damping.like_newmark = LikeNewmarkConfig{.gamma = 0.75, .step = 4e-3};
  const auto both = last("both");
  c.damping = {
      .mass = 0.0, .stiffness = 1e-3 + 0.25 * 4e-3, .like_newmark = {}, .largest_ratio = {}};
  CHECK(both == last("factor"));
  CHECK(both != soil);
}

TEST_CASE("Free-field columns are not in the history", "[fem]") {
  const SectionMesh s = section({.columns = 2, .rows = 4});
  FemConfig c = config(sand(), 4.0);
  c.sides.kind = SideKind::free_field;
  c.end = 0.05;
  const Scratch folder;
  run_fem(s, sine(1.0, 0.5), c, in(folder, "history"), 1, {});
  const FemHistory h(folder / "history.h5");
  CHECK(h.mesh().num_nodes() == s.mesh.num_nodes());
  CHECK(h.times().back() == Approx(0.05));
}

TEST_CASE("A run ends where the section has moved too far, if asked", "[fem]") {
  // A column of sand on a base that jerks: the top lags behind the ground.
  const SectionMesh s = section({.columns = 2, .rows = 4});
  FemConfig c = config(sand(), 4.0);
  c.output_interval = 0.05;
  const Scratch folder;
  const FemFacts whole = run_fem(s, sine(3.0, 0.5), c, in(folder, "whole"), 1, {});
  CHECK_FALSE(whole.stopped);
  CHECK(whole.end_time == Approx(0.5));
  const double limit = 0.5 * whole.largest_displacement;
  REQUIRE(limit > 0.0);
  c.stop_displacement = limit;
  const FemFacts part = run_fem(s, sine(3.0, 0.5), c, in(folder, "part"), 1, {});
  CHECK(part.stopped);
  CHECK(part.end_time < 0.5);
  CHECK(part.largest_displacement >= limit);
  // It is the same run up to there.
  const FemHistory a(folder / "whole.h5"), b(folder / "part.h5");
  REQUIRE(b.times().size() < a.times().size());
  const auto last = static_cast<int>(b.times().size()) - 1;
  CHECK(b.times().back() == Approx(part.end_time));
  CHECK(a.frame(last).displacement == b.frame(last).displacement);
}

TEST_CASE("A run tells where layers drain each other at rest", "[fem]") {
  SectionMesh s = section({.columns = 2, .rows = 8, .width = 2.0, .height = 8.0});
  s.materials.push_back({"gravel", 2});
  for (std::size_t e = 0; e < 4; ++e) s.mesh.element_material[e] = 2;
  s.sets.push_back({"well", {{0, 1}}});
  FemConfig c = config(elastic_soil(), 8.0);
  c.materials["soil"].permeability = {1e-8, 1e-8};
  c.materials["gravel"] = elastic_soil();
  c.materials["gravel"].permeability = {1e-2, 1e-2};
  c.water->drains = {"well"};
  c.end = 0.01;
  const Scratch folder;
  const FemFacts drained = run_fem(s, sine(1.0, 0.5), c, in(folder, "a"), 1, {});
  REQUIRE(drained.notes.size() == 1);
  CHECK_THAT(drained.notes[0], Catch::Contains("gravity.permeability"));
  CHECK(FemHistory(folder / "a.h5").origin().notes == drained.notes);
  c.water->drains.clear();
  CHECK(run_fem(s, sine(1.0, 0.5), c, in(folder, "b"), 1, {}).notes.empty());
}

TEST_CASE("A stop request ends the run without a history", "[fem]") {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop_requested = &stop;
  const Scratch folder;
  CHECK_THROWS_AS(
      run_fem(section({}), sine(1.0, 0.5), config(sand(), 4.0), in(folder, "history"), 1, progress),
      Interrupted);
  CHECK_FALSE(std::filesystem::exists(folder / "history.h5"));
}
