#include "core/check.hpp"
#include "tests/workflows/run_bench.hpp"
#include "workflows/engine/session.hpp"

#include <atomic>
#include <chrono>
#include <sys/stat.h>
#include <thread>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

void wait_a_tick() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

int exit_code(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.exit_code();
  }
  return 0;
}

}  // namespace

TEST_CASE("a result of an input that changed meanwhile is not kept", "[workflows]") {
  enum class How { changed, restored, restored_with_time };
  enum class When { before, during, before_failure };
  const How how = GENERATE(How::changed, How::restored, How::restored_with_time);
  const When when = GENERATE(When::before, When::during, When::before_failure);
  sample::RunBench bench;
  const fs::path note = bench.scratch / "note.txt";
  const auto change = [&] {
    const auto time = fs::last_write_time(note);
    wait_a_tick();
    bench.scratch.write("note.txt", "other note");
    if (how != How::changed) bench.scratch.write("note.txt", "first note");
    if (how == How::restored_with_time) fs::last_write_time(note, time);
  };
  bench.before_stage = [&](std::string_view stage) {
    if (stage == "one" && when == When::before) change();
  };
  bench.during("one", [&] {
    if (when != When::before) change();
    if (when == When::before_failure) throw InputError("the note cannot be read");
  });
  try {
    bench.run();
    FAIL("the change was not noticed");
  } catch (const Error& e) {
    CHECK(e.exit_code() == 4);
    CHECK_THAT(e.what(), Contains("one: ") && Contains("note.txt") && Contains("Run again"));
  }
  CHECK_FALSE(fs::exists(bench.out / "result.json"));
  bench.before_stage = [](std::string_view) {};
  bench.during("", [] {});
  bench.run();
  CHECK(bench.ran == std::vector<std::string>{"one", "two", "sum"});
}

TEST_CASE("an input from another stage is looked at again as well", "[workflows]") {
  sample::RunBench bench;
  bench.during("sum", [&] {
    wait_a_tick();
    for (const auto& entry : fs::recursive_directory_iterator(bench.out / "stages/one"))
      if (entry.path().filename() == "number.txt") std::ofstream(entry.path()) << "7\n";
  });
  CHECK_THROWS_WITH(bench.run(), Contains("sum: ") && Contains("number.txt"));
  bench.during("", [] {});
  bench.run();
  CHECK(bench.result()["sum"] == 3.0);
}

TEST_CASE("an input without an end is refused at once", "[workflows]") {
  sample::RunBench bench;
  REQUIRE(::mkfifo((bench.scratch / "pipe").c_str(), 0600) == 0);
  for (const std::string file : {"pipe", "/dev/zero"}) {
    CHECK(exit_code([&] { bench.load({"stages.one.with.note=" + file}); }) == 4);
  }
}

TEST_CASE("a killed session whose input was touched is not continued", "[workflows]") {
  const Scratch scratch;
  scratch.write("note.txt", "a note");
  auto types = sample::stages();
  const auto load = [&] {
    Workflow workflow = load_workflow(
        scratch.write("case.yaml",
                      "schema: 1\nname: demo\nstages:\n"
                      "  one: {uses: sample.number, with: {value: 1}}\n"
                      "  count: {uses: sample.count, in: {start: one.number}, with: {steps: 9}}\n"),
        {}, types);
    workflow.stages[1].prepared.files = {hash_file(scratch / "note.txt")};
    return workflow;
  };
  const fs::path out = scratch / "out";
  const Workflow workflow = load();
  const auto decision = [&](const Workflow& w) { return plan_workflow(w, out)[1].decision; };

  SECTION("killed") {
    // What a kill leaves: a session that did not look at its inputs again.
    run_workflow(
        load_workflow(scratch / "case.yaml", std::vector<std::string>{"stages.count=null"}, types),
        {.folder = out}, {});
    const fs::path work = work_folder(out, "count", decision(workflow).key);
    fs::create_directories(work);
    write_session(work, 1.0, workflow.stages[1].prepared.files, false);
    CHECK(decision(workflow).action == Action::resume);
    wait_a_tick();
    scratch.write("note.txt", "a note");
    CHECK(decision(load()).action == Action::run);
    CHECK_THAT(decision(load()).why, Contains("an input file was written since"));
  }
  SECTION("interrupted") {
    std::atomic<bool> stop = false;
    RunEvents events;
    events.progress = [&](std::string_view, double, std::string_view) { stop = true; };
    CHECK(exit_code([&] {
            run_workflow(workflow, {.folder = out, .stop_requested = &stop}, events);
          }) == 130);
    wait_a_tick();
    scratch.write("note.txt", "a note");
    CHECK(decision(load()).action == Action::resume);
  }
  SECTION("interrupted, and changed before that") {
    std::atomic<bool> stop = false;
    RunEvents events;
    events.progress = [&](std::string_view, double, std::string_view) {
      wait_a_tick();
      scratch.write("note.txt", "b note");
      scratch.write("note.txt", "a note");
      stop = true;
    };
    CHECK(exit_code([&] {
            run_workflow(workflow, {.folder = out, .stop_requested = &stop}, events);
          }) == 4);
    CHECK(decision(load()).action == Action::run);
  }
}
