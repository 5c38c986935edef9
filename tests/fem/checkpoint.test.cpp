#include "fem/checkpoint.hpp"

#include "fem/build_model.hpp"
#include "fem/gravity.hpp"
#include "fem/time_step.hpp"
#include "model/history.hpp"
#include "tests/support/scratch.hpp"
#include "verify/fem/scene.hpp"

#include <csignal>
#include <memory>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;
using Catch::Matchers::Contains;

namespace {

/// Sand under a crust that softens, on a compliant base, between free fields: every kind of state
/// there is. The last interval of output is shorter, so that the step changes.
struct Scene {
  SectionMesh mesh = section({.columns = 4, .rows = 8, .width = 8.0, .height = 8.0});
  GroundMotion motion{.dt = 0.01, .acceleration = {}, .origin = "test"};
  FemConfig settings = config(sand(), 6.0);

  Scene() {
    mesh.materials.push_back({"crust", 2});
    for (std::size_t e = 24; e < 32; ++e) mesh.mesh.element_material[e] = 2;
    settings.materials["crust"] = soil();
    MohrCoulomb::Params mc;
    mc.youngs_modulus = 20e6;
    mc.poisson_ratio = 0.3;
    mc.cohesion = 1e3;
    mc.friction_angle = 0.4;
    mc.residual_cohesion = 0.0;
    mc.residual_friction_angle = 0.2;
    mc.residual_strain = 0.01;
    settings.materials["crust"].laws.of<MohrCoulomb>() = mc;
    settings.materials["soil"].permeability_rise = PermeabilityRiseConfig{4.0, 2.0};
    settings.base = {BaseMotionKind::outcrop, 400.0, 2000.0, true};
    settings.sides.kind = SideKind::free_field;
    settings.damping.mass = 0.1;
    settings.damping.stiffness = 1e-4;
    settings.output_interval = 0.07;
    settings.end = 1.0;
    for (int i = 0; i < 101; ++i)
      motion.acceleration.push_back(4.0 * std::sin(4.0 * kPi * motion.dt * i));
  }

  FemFacts run(const std::filesystem::path& folder, const Progress& progress = {},
               const StopRule& rule = {}) const {
    return run_fem(mesh, motion, settings, {folder / "history.h5", folder / "checkpoint"}, 1,
                   progress, rule);
  }
  /// Stops with the first step: the state before it is what a rule is shown first.
  FemFacts run_one_step(const std::filesystem::path& folder) const {
    std::atomic<bool> stop{false};
    Progress progress;
    progress.stop_requested = &stop;
    StopRule rule;
    rule.ends = [&](const FemFrame&) {
      stop = true;
      return false;
    };
    return run(folder, progress, rule);
  }
  void interrupt(const std::filesystem::path& folder) const {
    REQUIRE_THROWS_AS(run_one_step(folder), Interrupted);
  }
  /// One step after the first recorded state from `fraction` on.
  void interrupt_after(const std::filesystem::path& folder, double fraction,
                       const StopRule& rule = {}) const {
    std::atomic<bool> stop{false};
    Progress progress;
    progress.stop_requested = &stop;
    progress.report = [&](double done, std::string_view) { stop = done > fraction; };
    REQUIRE_THROWS_AS(run(folder, progress, rule), Interrupted);
  }
};

/// All but the wall time.
bool same(const FemFacts& a, const FemFacts& b) {
  return a.end_time == b.end_time && a.largest_displacement == b.largest_displacement &&
         a.stopped == b.stopped && a.stopped_by_rule == b.stopped_by_rule && a.steps == b.steps &&
         a.smallest_step == b.smallest_step && a.largest_step == b.largest_step &&
         a.out_of_balance == b.out_of_balance && a.energy_error == b.energy_error &&
         a.base_work == b.base_work && a.damping_work == b.damping_work &&
         a.kinetic_energy == b.kinetic_energy && a.sub_steps == b.sub_steps &&
         a.floored == b.floored && a.notes == b.notes;
}

struct Whole {
  Scratch folder;
  FemFacts facts;
  std::string bytes;
};
const Whole& whole() {
  static Whole w;
  if (w.bytes.empty()) {
    w.facts = Scene().run(w.folder.path());
    w.bytes = read_text_file(w.folder / "history.h5");
  }
  return w;
}

}  // namespace

TEST_CASE("An interrupted and continued shaking has the same bytes and facts", "[fem]") {
  const Scene scene;
  REQUIRE(whole().facts.largest_step > whole().facts.smallest_step);
  const Scratch folder;
  // Steps 1 to 20: within a look at the moduli and across it; then at arbitrary places.
  for (int i = 0; i < 20; ++i) scene.interrupt(folder.path());
  for (const double fraction : {0.15, 0.4, 0.75}) {
    scene.interrupt_after(folder.path(), fraction);
    for (int i = 0; i < 3; ++i) scene.interrupt(folder.path());
  }
  CHECK_FALSE(std::filesystem::exists(folder / "history.h5"));
  const FemFacts facts = scene.run(folder.path());
  CHECK(read_text_file(folder / "history.h5") == whole().bytes);
  CHECK(same(facts, whole().facts));
  CHECK_FALSE(std::filesystem::exists(folder / "checkpoint"));
  CHECK_FALSE(std::filesystem::exists(folder / "history.h5.partial"));
}

TEST_CASE("Child of the next test: shakes on and is killed", "[.fem-child]") {
  const char* folder = std::getenv("FLOWSLIDE_TEST_FOLDER");
  REQUIRE(folder);
  Progress progress;
  progress.report = [](double done, std::string_view) {
    if (done > 0.65) ::kill(::getpid(), SIGKILL);
  };
  Scene().run(folder, progress);
}

TEST_CASE("A killed and continued shaking has the same bytes", "[fem]") {
  const Scene scene;
  const Scratch folder;
  scene.interrupt_after(folder.path(), 0.25);
  REQUIRE(::setenv("FLOWSLIDE_TEST_FOLDER", folder.path().c_str(), 1) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::execl("/proc/self/exe", "test_fem", "[.fem-child]", static_cast<char*>(nullptr));
    ::_exit(1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
  REQUIRE(std::filesystem::exists(folder / "checkpoint"));
  REQUIRE_FALSE(std::filesystem::exists(folder / "history.h5"));
  const FemFacts facts = scene.run(folder.path());
  CHECK(read_text_file(folder / "history.h5") == whole().bytes);
  CHECK(same(facts, whole().facts));
}

TEST_CASE("A kill after the history was finished is no harm", "[fem]") {
  const Scene scene;
  const Scratch folder;
  scene.interrupt_after(folder.path(), 0.6);
  // What such a kill leaves: the parts, the checkpoint and the finished history.
  std::filesystem::copy_file(whole().folder / "history.h5", folder / "history.h5");
  scene.run(folder.path());
  CHECK(read_text_file(folder / "history.h5") == whole().bytes);
}

namespace {

/// Ends a run where the displacements of a node, summed over the states, exceed a limit: a rule
/// with a memory. `told` counts the states it was shown.
StopRule path_limit(double limit, int& told, const std::string& name = "path") {
  const auto sum = std::make_shared<double>(0.0);
  told = 0;
  return {name, [sum, limit, &told](const FemFrame& frame) {
            ++told;
            *sum += std::abs(frame.displacement.back()[0]);
            return *sum > limit;
          }};
}

}  // namespace

TEST_CASE("A rule that ends a run sees every state once, also after an interruption", "[fem]") {
  const Scene scene;
  const Scratch once, parts;
  int told = 0;
  const FemHistory whole_history(whole().folder / "history.h5");
  double limit = 0.0;
  for (std::size_t i = 0; i < 7; ++i)
    limit += std::abs(whole_history.frame(i).displacement.back()[0]);
  limit *= 1.0 - 1e-9;
  const FemFacts stopped = scene.run(once.path(), {}, path_limit(limit, told));
  CHECK(stopped.stopped_by_rule);
  CHECK_FALSE(stopped.stopped);
  CHECK(told == 8);  // at rest, and seven states
  CHECK(stopped.end_time == Approx(7 * 0.07));
  CHECK(stopped.steps < whole().facts.steps);
  CHECK(FemHistory(once / "history.h5").times().size() == 7);

  scene.interrupt_after(parts.path(), 0.3, path_limit(limit, told));
  const auto with_other_rule = [&] {
    scene.run(parts.path(), {}, path_limit(limit, told, "other"));
  };
  CHECK_THROWS_WITH(with_other_rule(), Contains("belongs to a run with another section"));
  const FemFacts continued = scene.run(parts.path(), {}, path_limit(limit, told));
  CHECK(told == 8);
  CHECK(same(continued, stopped));
  CHECK(read_text_file(parts / "history.h5") == read_text_file(once / "history.h5"));
  // control: a rule that never fires
  const Scratch other;
  CHECK(same(scene.run(other.path(), {}, path_limit(1e9, told)), whole().facts));
  CHECK(read_text_file(other / "history.h5") == whole().bytes);
}

TEST_CASE("A damaged checkpoint of shaking is named", "[fem]") {
  const Scene scene;
  const Scratch folder;
  scene.interrupt(folder.path());
  std::string bytes = read_text_file(folder / "checkpoint");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  folder.write("checkpoint", bytes);
  try {
    scene.run(folder.path());
    FAIL("continued");
  } catch (const FileError& e) {
    CHECK_THAT(e.what(), Contains((folder / "checkpoint").string()) && Contains("checksum") &&
                             Contains("delete it"));
  }
  std::filesystem::remove(folder / "checkpoint");
  scene.run(folder.path());
  CHECK(read_text_file(folder / "history.h5") == whole().bytes);
}

TEST_CASE("A checkpoint of another run is refused", "[fem]") {
  const Scratch folder;
  Scene().interrupt(folder.path());
  const auto other_run = [&](auto change) {
    Scene other;
    change(other);
    CHECK_THROWS_WITH(other.run(folder.path()), Contains("belongs to a run with another section"));
  };
  other_run([](Scene& s) { s.settings.courant = 0.45; });
  other_run([](Scene& s) { s.settings.materials["crust"].density = 1950.0; });
  other_run([](Scene& s) { s.motion.acceleration[3] += 1e-9; });
  other_run([](Scene& s) { s.mesh.mesh.nodes[7][0] += 1e-9; });
  other_run([](Scene& s) { std::swap(s.mesh.materials[0].name, s.mesh.materials[1].name); });
  CHECK_NOTHROW(Scene().run(folder.path()));  // control
}

TEST_CASE("A checkpoint whose numbers cannot be those of the shaking is refused", "[fem]") {
  const Scene scene;
  const Scratch folder;
  scene.interrupt_after(folder.path(), 0.3);
  const std::string good = read_text_file(folder / "checkpoint");
  const std::string origin = fingerprint(scene.mesh, scene.motion, scene.settings, "");
  const auto forged = [&](auto change) {
    folder.write("checkpoint", good);
    Solver s = make_solver(build_model(scene.mesh, scene.settings), {});
    solve_gravity(s, {kUnset, scene.settings.gravity.compacts});
    refresh_moduli(s);
    start_motion(s);
    RunState run;
    read_checkpoint(folder / "checkpoint", origin, s, run);
    change(s, run);
    write_checkpoint(folder / "checkpoint", origin, s, run);
    try {
      scene.run_one_step(folder.path());
    } catch (const Interrupted&) {
      return std::string("(none)");
    } catch (const FileError& e) {
      return std::string(e.what());
    }
    return std::string("(finished)");
  };
  REQUIRE(forged([](auto&, auto&) {}) == "(none)");  // control
  const auto fits_not = [&](auto change) {
    CHECK_THAT(forged([&](auto& s, auto&) { change(s); }), Contains("arrays do not fit"));
  };
  fits_not([](auto& s) { s.state.displacement.pop_back(); });
  fits_not([](auto& s) { s.state.pressure.clear(); });
  fits_not([](auto& s) { s.state.stress.emplace_back(); });
  fits_not([](auto& s) { std::get<fem::LawStates<PM4Sand>>(s.state.laws).of.pop_back(); });
  fits_not([](auto& s) { s.entry_force.resize(s.entry_force.size() + 8); });
  const auto order = [&](auto change) { CHECK_THAT(forged(change), Contains("times, steps")); };
  order([](auto& s, auto&) { s.state.time = kUnset; });
  order([](auto& s, auto&) { s.state.time = -1e300; });
  order([](auto& s, auto&) { s.state.step = -5; });
  order([](auto& s, auto&) { s.dt = kUnset; });
  order([](auto&, auto& run) { run.output = -3; });
  order([](auto&, auto& run) { run.output += 1; });
  order([](auto&, auto& run) { run.since = 1 << 30; });
  order([](auto&, auto& run) { run.implicit.halvings = 1 << 30; });
}
