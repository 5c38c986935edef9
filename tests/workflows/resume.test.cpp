#include "core/check.hpp"
#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/runner.hpp"

#include <algorithm>
#include <cmath>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

namespace {

Workflow load(const Scratch& scratch, int pause_us) {
  const auto types = sample::stages();
  const std::string text =
      "schema: 1\nname: demo\nstages:\n"
      "  one: {uses: sample.number, with: {value: 1}}\n"
      "  count: {uses: sample.count, in: {start: one.number}, with: {steps: 300, step_us: " +
      std::to_string(pause_us) + "}}\n";
  return load_workflow(scratch.write("case.yaml", text), {}, types);
}

std::string last(const Workflow& workflow, const std::filesystem::path& out) {
  const auto plan = plan_workflow(workflow, out);
  return read_text_file(result_folder(out, "count", plan[1].decision.key) / "last.txt");
}

std::size_t sessions(const Workflow& workflow, const std::filesystem::path& out) {
  const auto plan = plan_workflow(workflow, out);
  const std::string text =
      read_text_file(result_folder(out, "count", plan[1].decision.key) / "sessions");
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Runs the workflow in a child process that is killed after a while; true if it got to its end.
bool run_and_kill(const Workflow& workflow, const std::filesystem::path& out, int after_us) {
  const pid_t child = ::fork();
  if (child == 0) {
    int code = 1;
    try {
      run_workflow(workflow, {.folder = out}, {});
      code = 0;
    } catch (...) {
    }
    ::_exit(code);
  }
  ::usleep(static_cast<useconds_t>(after_us));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("a run that is killed again and again ends with the bits of one that is not",
          "[workflows]") {
  const Scratch scratch;
  const Workflow workflow = load(scratch, 100);
  run_workflow(workflow, {.folder = scratch / "whole"}, {});
  int kills = 0;
  // Sessions of growing length, not multiples of a step: kills fall between any two writes, and
  // on a slow machine one session gets through at last.
  while (!run_and_kill(workflow, scratch / "killed",
                       static_cast<int>(2000.0 * std::pow(1.02, kills)))) {
    // The result is the last thing that a run writes: with it the run is done, killed or not.
    if (std::filesystem::exists(scratch / "killed/result.json")) break;
    REQUIRE(++kills < 400);
  }
  CHECK(kills >= 3);
  CHECK(sessions(workflow, scratch / "killed") >= 2);
  CHECK(sessions(workflow, scratch / "whole") == 1);
  CHECK(last(workflow, scratch / "killed") == last(workflow, scratch / "whole"));
}

TEST_CASE("an interrupted stage continues from its checkpoint", "[workflows]") {
  const Scratch scratch;
  const Workflow workflow = load(scratch, 0);
  std::atomic<bool> stop = false;
  RunEvents events;
  events.progress = [&](std::string_view, double fraction, std::string_view) {
    if (fraction > 0.5) stop = true;
  };
  try {
    run_workflow(workflow, {.folder = scratch / "out", .stop_requested = &stop}, events);
    FAIL("the run was not interrupted");
  } catch (const Error& e) {
    CHECK(e.exit_code() == 130);
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "out/result.json"));
  CHECK(plan_workflow(workflow, scratch / "out")[1].decision.action == Action::resume);

  stop = false;
  events.progress = [](std::string_view, double, std::string_view) {};
  double first = 0.0;
  events.done = [&](std::string_view, double seconds) { first = seconds; };
  run_workflow(workflow, {.folder = scratch / "out", .stop_requested = &stop}, events);
  CHECK(sessions(workflow, scratch / "out") == 2);
  run_workflow(workflow, {.folder = scratch / "whole"}, {});
  CHECK(last(workflow, scratch / "out") == last(workflow, scratch / "whole"));
  CHECK(first > 0.0);
}

TEST_CASE("stages without checkpoints start in a clean folder", "[workflows]") {
  const Scratch scratch;
  const Workflow workflow = load(scratch, 0);
  const auto plan = plan_workflow(workflow, scratch / "out");
  const auto work = work_folder(scratch / "out", "one", plan[0].decision.key);
  std::filesystem::create_directories(work);
  std::ofstream(work / "torn") << "half of a number";
  run_workflow(workflow, {.folder = scratch / "out"}, {});
  CHECK_FALSE(std::filesystem::exists(work));
  CHECK_FALSE(std::filesystem::exists(result_folder(scratch / "out", "one", plan[0].decision.key) /
                                      "torn"));
}
