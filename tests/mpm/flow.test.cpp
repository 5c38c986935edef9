#include "mpm/solver/checkpoint.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <atomic>
#include <csignal>
#include <cstring>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

ParticleSet column() {
  ParticleSet p;
  p.toe = 4.0;
  p.materials = {liquefied(1e6, 4e3), elastic(5e6, 0.3)};
  add_lattice(p, {0.0, 1.0, 4.0, 4.0}, 0.25, 1800.0);
  add_lattice(p, {0.0, 0.0, 4.0, 1.0}, 0.25, 1900.0, 1);
  // Ids in another order than positions: the history sorts by id.
  for (std::size_t q = 0; q < p.size(); ++q)
    p.id[q] = static_cast<std::int64_t>((q * 7) % p.size());
  return p;
}

FlowConfig flow_config() {
  FlowConfig c = free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.left_roller = 0.0;
  c.end = 1.0;
  c.frame_interval = 0.25;
  c.sample_interval = 0.05;
  return c;
}

FlowPaths paths_in(const std::filesystem::path& folder) {
  return {folder / "mpm.h5", folder / "mpm.checkpoint"};
}

std::string uninterrupted() {
  const Scratch folder;
  run_flow(column(), flow_config(), paths_in(folder.path()), 1, {});
  return read_text_file(folder / "mpm.h5");
}

/// Stops after one step.
void interrupt_once(const FlowPaths& paths) {
  static const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop_requested = &stop;
  REQUIRE_THROWS_AS(run_flow(column(), flow_config(), paths, 1, progress), Interrupted);
}

template <class Array>
bool same_bits(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}  // namespace

TEST_CASE("One and two threads, and threads that come and go, give the same bits", "[mpm]") {
  Run one(column(), flow_config(), 1), two(column(), flow_config(), 2);
  one.step(25);
  two.step(9);
  for (const int threads : {1, 3, 2, 1}) {
    use_threads(two.s, two.scratch, threads);
    two.step(4);
  }
  std::vector<std::vector<double>> a, b;
  const auto keep = [](std::vector<std::vector<double>>& list) {
    return [&](const auto& array) { list.emplace_back(array.begin(), array.end()); };
  };
  visit_arrays(one.s.points, keep(a));
  visit_arrays(two.s.points, keep(b));
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) CHECK(same_bits(a[k], b[k]));
  CHECK(std::memcmp(&one.s.balance, &two.s.balance, sizeof one.s.balance) == 0);
  two.step();  // control: another step is seen
  CHECK(!same_bits(one.s.points.x[0], two.s.points.x[0]));
}

TEST_CASE("A runout ends with its files in place", "[mpm]") {
  const Scratch folder;
  const FlowFacts facts = run_flow(column(), flow_config(), paths_in(folder.path()), 1, {});
  CHECK(facts.end_time == Approx(1.0).margin(0.01));
  CHECK(!facts.at_rest);
  CHECK(facts.last.runout > 0.1);
  CHECK(facts.steps > 100);
  CHECK(facts.point_updates == Approx(double(facts.steps) * double(column().size())));
  CHECK(!std::filesystem::exists(folder / "mpm.checkpoint"));
  const MpmHistory history(folder / "mpm.h5");
  CHECK(history.num_frames() == 5);  // 0, 0.25, ..., 1
  CHECK(history.samples().size() >= 20);
  const MpmFrame first = history.frame(0);
  CHECK(first.time == 0.0);
  const ParticleSet p = column();
  for (std::size_t q = 0; q < p.size(); ++q)
    REQUIRE(first.position[p.id[q]] == p.position[q]);          // in order of id
  CHECK(read_text_file(folder / "mpm.h5") == uninterrupted());  // and the same again
}

TEST_CASE("States are stored earlier where the flow is fast, and nothing else changes", "[mpm]") {
  const Scratch folder, other;
  FlowConfig c = flow_config();
  c.frame_travel = 0.2;
  const FlowPaths paths = paths_in(folder.path());
  std::atomic<bool> stop{true};
  Progress once;
  once.stop_requested = &stop;
  for (int i = 0; i < 3; ++i) REQUIRE_THROWS_AS(run_flow(column(), c, paths, 1, once), Interrupted);
  run_flow(column(), c, paths, 1, {});
  run_flow(column(), c, paths_in(other.path()), 1, {});
  CHECK(read_text_file(paths.history) == read_text_file(other / "mpm.h5"));
  run_flow(column(), flow_config(), paths_in(other.path()), 1, {});
  const MpmHistory with(paths.history), without(other / "mpm.h5");
  REQUIRE(with.samples().size() == without.samples().size());
  for (std::size_t i = 0; i < with.samples().size(); ++i)
    REQUIRE(with.samples()[i].front == without.samples()[i].front);
  const std::vector<double>& times = with.times();
  CHECK(times.size() > without.times().size() + 3);
  CHECK(times.back() == without.times().back());
  // Between two states nothing has come much farther than 0.2 m: as far as in a row of the series
  // more, for the speed is looked at there.
  for (std::size_t k = 1; k < times.size(); ++k) {
    const MpmFrame a = with.frame(k - 1), b = with.frame(k);
    double far = 0.0, fastest = 0.0;
    for (std::size_t q = 0; q < a.position.size(); ++q) {
      far = std::max(far, std::hypot(b.position[q][0] - a.position[q][0],
                                     b.position[q][1] - a.position[q][1]));
      fastest = std::max(fastest, std::hypot(b.velocity[q][0], b.velocity[q][1]));
    }
    CHECK(far < 0.2 + 1.1 * fastest * c.sample_interval);
  }
}

TEST_CASE("A runout stops when it is at rest", "[mpm]") {
  const Scratch folder;
  FlowConfig c = flow_config();
  c.end = 60.0;
  c.damping = 0.7;
  c.rest.window = 0.5;
  ParticleSet p = column();
  p.materials[0].parameters["strength"] = p.materials[0].parameters["soft_strength"] = 50e3;
  const FlowFacts facts = run_flow(p, c, paths_in(folder.path()), 1, {});
  CHECK(facts.at_rest);
  CHECK(facts.end_time < 20.0);
  CHECK(facts.last.max_speed < 0.05);
}

TEST_CASE("An interrupted and continued runout has the same bytes", "[mpm]") {
  const Scratch folder;
  const FlowPaths paths = paths_in(folder.path());
  for (int i = 0; i < 4; ++i) {
    interrupt_once(paths);
    REQUIRE(std::filesystem::exists(paths.checkpoint));
    REQUIRE(!std::filesystem::exists(paths.history));
  }
  run_flow(column(), flow_config(), paths, 1, {});
  CHECK(read_text_file(paths.history) == uninterrupted());
  CHECK(!std::filesystem::exists(paths.checkpoint));
}

TEST_CASE("Child of the next test: continues and is killed on the way", "[.flow-child]") {
  const char* folder = std::getenv("FLOWSLIDE_TEST_FOLDER");
  REQUIRE(folder);
  Progress progress;
  progress.report = [](double, std::string_view) { ::kill(::getpid(), SIGKILL); };
  run_flow(column(), flow_config(), paths_in(folder), 1, progress);
}

TEST_CASE("A killed and continued runout has the same bytes", "[mpm]") {
  const Scratch folder;
  const FlowPaths paths = paths_in(folder.path());
  interrupt_once(paths);
  REQUIRE(::setenv("FLOWSLIDE_TEST_FOLDER", folder.path().c_str(), 1) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::execl("/proc/self/exe", "test_mpm", "[.flow-child]", static_cast<char*>(nullptr));
    ::_exit(1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
  REQUIRE(std::filesystem::exists(paths.checkpoint));
  REQUIRE(!std::filesystem::exists(paths.history));
  run_flow(column(), flow_config(), paths, 1, {});
  CHECK(read_text_file(paths.history) == uninterrupted());
}

TEST_CASE("A kill after the history was finished is no harm", "[mpm]") {
  const Scratch folder;
  const FlowPaths paths = paths_in(folder.path());
  interrupt_once(paths);
  // What such a kill leaves: the parts, the checkpoint and the finished history.
  folder.write("mpm.h5", uninterrupted());
  run_flow(column(), flow_config(), paths, 1, {});
  CHECK(read_text_file(paths.history) == uninterrupted());
  CHECK(!std::filesystem::exists(folder / "mpm.h5.partial"));
}

TEST_CASE("A damaged checkpoint is refused", "[mpm]") {
  const Scratch folder;
  const FlowPaths paths = paths_in(folder.path());
  interrupt_once(paths);
  const std::string good = read_text_file(paths.checkpoint);
  const auto refused = [&](const std::string& bytes) {
    folder.write("mpm.checkpoint", bytes);
    Simulation<2> s = make_simulation(column(), flow_config());
    RunState run;
    CHECK_THROWS_AS(read_checkpoint(paths.checkpoint, s, run), FileError);
  };
  for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 97)
    refused(good.substr(0, length));
  refused(good + "x");
  for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 97) {
    std::string flipped = good;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    refused(flipped);
  }
  folder.write("mpm.checkpoint", good);
  Simulation<2> fits = make_simulation(column(), flow_config());
  RunState run;
  CHECK_NOTHROW(read_checkpoint(paths.checkpoint, fits, run));  // control
  ParticleSet fewer = column();
  resize(fewer, fewer.size() - 1);
  Simulation<2> other_run = make_simulation(fewer, flow_config());
  CHECK_THROWS_AS(read_checkpoint(paths.checkpoint, other_run, run), FileError);
}

TEST_CASE("Particles the solver cannot start from are named", "[mpm]") {
  const auto message = [](auto change) {
    return input_error([&] {
      ParticleSet p = column();
      FlowConfig c = flow_config();
      change(p, c);
      make_simulation(p, c);
    });
  };
  CHECK(message([](auto&, auto&) {}) == "(no InputError)");
  CHECK_THAT(message([](auto& p, auto&) { p.position[5][0] = kUnset; }), Contains("particle"));
  CHECK_THAT(message([](auto& p, auto&) { p.stress[5][1] = kUnset; }), Contains("particle"));
  CHECK_THAT(message([](auto& p, auto&) { p.mass[5] = 0.0; }), Contains("mass"));
  CHECK_THAT(message([](auto& p, auto&) { p.position[3][1] = -1.0; }),
             Contains("inside the ground") && Contains("particle 21"));
  CHECK_THAT(message([](auto& p, auto&) { p.materials[0].parameters.erase("strength"); }),
             Contains("'strength'") && Contains("liquefied"));
  CHECK_THAT(message([](auto& p, auto&) { p.materials[0].law = "jelly"; }), Contains("jelly"));
  CHECK_THAT(message([](auto& p, auto&) { resize(p, 0); }), Contains("no particles"));
  CHECK_THAT(message([](auto& p, auto&) { p.dim = 3; }), Contains("3 dimensions"));
  CHECK_THAT(message([](auto&, auto& c) { c.ground.surface.clear(); }), Contains("ground.surface"));
  CHECK_THAT(message([](auto&, auto& c) {
               c.ground.surface = {{1.0, 0.0}, {0.0, 0.0}};
             }),
             Contains("point 2 lies left of point 1"));
  CHECK_THAT(message([](auto&, auto& c) { c.right_roller = -1.0; }), Contains("left_roller"));
}

TEST_CASE("Points without a strength of their own have that of their material", "[mpm]") {
  ParticleSet p;
  p.materials = {liquefied(5e6, 6e3)};
  add_lattice(p, {0.0, 0.0, 2.0, 1.0}, 0.5, 1900.0);
  // as transfer.map writes them: 0 where soil has not liquefied
  p.history["strength"].assign(p.size(), 0.0);
  p.history["soft_strength"].assign(p.size(), 0.0);
  p.history["strength"][3] = 2e3;
  p.history["soft_strength"][3] = 1e3;
  p.history["plastic_strain"].assign(p.size(), 0.25);
  const Simulation<2> s = make_simulation(p, free_space(0.5));
  for (std::size_t q = 0; q < p.size(); ++q) {
    const bool own = s.points.index[q] == 3;
    CHECK(s.points.state[0][q] == 0.25);
    CHECK(s.points.state[2][q] == (own ? 2e3 : 6e3));
    CHECK(s.points.state[3][q] == (own ? 1e3 : 3e3));
  }
  p.materials[0].parameters.erase("strength");
  CHECK_THAT(input_error([&] { make_simulation(p, free_space(0.5)); }),
             Contains("'strength'") && Contains("liquefied"));
}

TEST_CASE("A state that runs away ends with a message", "[mpm]") {
  const Scratch folder;
  ParticleSet p = column();
  p.velocity[7][0] = 1e200;
  try {
    run_flow(p, flow_config(), paths_in(folder.path()), 1, {});
    FAIL("finished");
  } catch (const NumericsError& e) {
    CHECK_THAT(e.what(), Contains("step 1,"));
  }
}
