#include "core/check.hpp"
#include "tests/workflows/run_bench.hpp"

#include <atomic>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

enum class Harm { flip, cut, remove };

/// Flips a bit with size and time kept, cuts a file in half, or removes it.
void damage_file(const fs::path& path, Harm harm) {
  if (harm == Harm::remove) {
    fs::remove(path);
    return;
  }
  const auto time = fs::last_write_time(path);
  std::string bytes = read_text_file(path);
  if (harm == Harm::cut) {
    fs::resize_file(path, bytes.size() / 2);
  } else {
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << bytes;
    fs::last_write_time(path, time);
  }
}

/// Files and links that a run has made and reads again. What it has given to the user is the
/// user's; the guard file carries nothing.
std::vector<fs::path> files_of_run(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (name.starts_with("style/") || name == ".flowslide.lock") continue;
    if (entry.is_regular_file() || entry.is_symlink()) files.push_back(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("damage to any file of a finished run is noticed and mended", "[workflows]") {
  sample::RunBench bench;
  bench.run();
  const auto whole = sample::contents(bench.out);
  const std::vector<fs::path> files = files_of_run(bench.out);
  REQUIRE(files.size() >= 14);
  for (const fs::path& file : files) {
    for (const Harm harm : {Harm::flip, Harm::cut, Harm::remove}) {
      if (harm != Harm::remove && fs::is_symlink(file)) continue;  // its target is a file as well
      CAPTURE(file.lexically_relative(bench.out).string(), static_cast<int>(harm));
      damage_file(file, harm);
      bench.run();
      CHECK_THAT(bench.told(), Contains(file.filename().string()));
      CHECK(sample::contents(bench.out) == whole);
      bench.run();
      CHECK(bench.told() == "");
      CHECK(bench.ran.empty());
    }
  }
}

TEST_CASE("a number that was edited is not repeated", "[workflows]") {
  sample::RunBench bench;
  bench.run();
  const fs::path facts = bench.folder(0) / "facts.json";
  std::string text = read_text_file(facts);
  text.replace(text.find("1.5"), 3, "9.5");
  bench.scratch.write(facts.lexically_relative(bench.scratch.path()).string(), text);
  bench.run();
  CHECK(bench.ran == std::vector<std::string>{"one"});
  CHECK(bench.why["one"] == "result was damaged: the content of facts.json has changed");
  CHECK(bench.result()["runout_m"] == 1.5);
}

TEST_CASE("a damaged result stays until the new one is there", "[workflows]") {
  sample::RunBench bench;
  bench.run();
  const fs::path file = bench.folder(2) / "sum.txt";
  damage_file(file, Harm::flip);
  const std::string damaged = read_text_file(file);
  bench.during("sum", [] { throw FileError("the disk is full"); });
  CHECK_THROWS_WITH(bench.run(), Contains("the disk is full"));
  CHECK(read_text_file(file) == damaged);
}

TEST_CASE("damage to the file of an interrupted run is noticed and mended", "[workflows]") {
  const Scratch scratch;
  const Workflow workflow = load_workflow(
      scratch.write("case.yaml",
                    "schema: 1\nname: demo\nstages:\n"
                    "  one: {uses: sample.number, with: {value: 1}}\n"
                    "  count: {uses: sample.count, in: {start: one.number}, with: {steps: 20}}\n"),
      {}, sample::stages());
  const auto last = [&](const fs::path& out) {
    const auto plan = plan_workflow(workflow, out);
    return read_text_file(result_folder(out, "count", plan[1].decision.key) / "last.txt");
  };
  run_workflow(workflow, {.folder = scratch / "whole"}, {});
  for (const Harm harm : {Harm::flip, Harm::cut, Harm::remove}) {
    const fs::path out = scratch / ("out" + std::to_string(static_cast<int>(harm)));
    std::atomic<bool> stop = false;
    RunEvents events;
    events.progress = [&](std::string_view, double fraction, std::string_view) {
      if (fraction > 0.5) stop = true;
    };
    CHECK_THROWS_AS(run_workflow(workflow, {.folder = out, .stop_requested = &stop}, events),
                    Error);
    const auto plan = plan_workflow(workflow, out);
    REQUIRE(plan[1].decision.action == Action::resume);
    damage_file(work_folder(out, "count", plan[1].decision.key) / "session.json", harm);
    std::string told;
    events = {};
    events.notice = [&](std::string_view text) { told += text; };
    run_workflow(workflow, {.folder = out}, events);
    CHECK_THAT(told, Contains("session.json"));
    CHECK(last(out) == last(scratch / "whole"));
  }
}
