#include "core/check.hpp"
#include "tests/workflows/run_bench.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/names.hpp"

#include <atomic>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// A finished run and, outside of it, files that must stay as they are.
struct Attack : sample::RunBench {
  fs::path victim = scratch.write("victim/data.pvd", "file=\"stages/mine\"");
  Attack() { run(); }
  void check_victim() const {
    CHECK(read_text_file(victim) == "file=\"stages/mine\"");
    std::size_t entries = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(victim.parent_path()))
      ++entries;
    CHECK(entries == 1);
  }
};

}  // namespace

TEST_CASE("only names that stay inside are names", "[workflows]") {
  for (const char* good : {"a", "a.b", "report/flow.pvd", "a/..b", "a b", "stages"})
    CHECK(stays_inside(good));
  for (const char* bad : {"", "/", "/a", "..", ".", "a/", "a//b", "../a", "a/../b", "a/..", "./a",
                          "a\nb", "\033[2J", "a/./b"})
    CHECK_FALSE(stays_inside(bad));
  CHECK_FALSE(stays_inside(std::string(5000, 'a')));
  CHECK_FALSE(stays_inside(std::string("a\0b", 3)));
  CHECK(is_name("map-2"));
  CHECK_FALSE(is_name("../map"));
}

TEST_CASE("a run.lock cannot name what lies outside", "[workflows]") {
  Attack a;
  RunLock lock = *read_lock(a.out).lock;
  SECTION("published") { lock.published.push_back({"../victim/data.pvd", "stages/x"}); }
  SECTION("published, absolute") { lock.published.push_back({a.victim.string(), "stages/x"}); }
  SECTION("target") { lock.published.push_back({"data.pvd", "../victim/data.pvd"}); }
  SECTION("given") { lock.given["../victim/data.pvd"] = std::string(64, '0'); }
  SECTION("stage") { lock.stages["../../victim"] = lock.stages["one"]; }
  SECTION("stage of another name") { lock.stages["three"] = lock.stages["one"]; }
  SECTION("publish of a stage") { lock.stages["one"].publish = {"../../../../victim/data.pvd"}; }
  SECTION("key") { lock.stages["one"].key = "../../../victim"; }
  write_lock(a.out, lock);
  CHECK_FALSE(read_lock(a.out).lock);
  a.run({"stages.sum.with.factor=2"});
  CHECK_THAT(a.told(), Contains("run.lock is not used"));
  CHECK(a.result()["sum"] == 6.0);
  a.check_victim();
}

TEST_CASE("a record cannot name what lies outside", "[workflows]") {
  Attack a;
  const fs::path folder = a.folder(2);
  StageRecord record = *read_stage_record(folder).record;
  std::erase_if(record.files, [](const FileRecord& f) { return f.name == kFactsFile; });
  SECTION("publish") { record.publish = {"../../../../victim/data.pvd"}; }
  SECTION("give") { record.give = {"../victim/data.pvd"}; }
  SECTION("file") { record.files.push_back({"../../../../victim/data.pvd", 0, record.key}); }
  SECTION("output") { record.outputs[0].file = "../sum.txt"; }
  SECTION("an output that is not there") { record.outputs.clear(); }
  SECTION("another checksum of an output") { record.outputs[0].sha256 = std::string(64, 'a'); }
  SECTION("stage") { record.stage = "../../victim"; }
  SECTION("another stage") { record.stage = "one"; }
  write_record(folder, record);
  a.run();
  CHECK_THAT(a.told(), Contains("stage.json"));
  CHECK(a.ran == std::vector<std::string>{"sum"});
  CHECK(a.result()["sum"] == 3.0);
  a.check_victim();
}

TEST_CASE("links at the top of a run folder are not written through", "[workflows]") {
  Attack a;
  SECTION("result.json and old temporary names") {
    fs::remove(a.out / "result.json");
    for (const char* name : {"result.json", "result.json.partial", "run.lock.partial"})
      fs::create_symlink(a.victim, a.out / name);
    a.run({"stages.sum.with.factor=2"});
    CHECK(a.result()["sum"] == 6.0);
    CHECK_FALSE(fs::is_symlink(a.out / "result.json"));
  }
  SECTION("the guard file") {
    fs::remove(a.out / ".flowslide.lock");
    fs::create_symlink(a.victim, a.out / ".flowslide.lock");
    CHECK_THROWS_WITH(a.run(), Contains(".flowslide.lock' is a link"));
  }
  SECTION("the guard file as a second name") {
    fs::remove(a.out / ".flowslide.lock");
    fs::create_hard_link(a.victim, a.out / ".flowslide.lock");
    CHECK_THROWS_AS(a.run(), FileError);
  }
  SECTION("a published name") {
    fs::remove(a.out / "sum.pvd");
    fs::create_symlink(a.victim, a.out / "sum.pvd");
    CHECK_THROWS_WITH(a.run(), Contains("was not made by this program"));
  }
  SECTION("the folder of what is given") {
    fs::remove_all(a.out / "style");
    fs::create_symlink(a.victim.parent_path(), a.out / "style");
    a.run();
    CHECK_THAT(a.told(), Contains("style/pen.txt was changed and is kept"));
  }
  a.check_victim();
}

TEST_CASE("links among the results are not written through", "[workflows]") {
  Attack a;
  const std::vector<std::string> set{"stages.sum.with.factor=2"};
  const auto plan = plan_workflow(a.load(set), a.out);
  const fs::path work = work_folder(a.out, "sum", plan[2].decision.key);
  fs::path link = a.out / "stages";
  bool refused = true;
  SECTION("all stages") {}
  SECTION("a stage") { link /= "sum"; }
  SECTION("a work folder") {
    link = work;
    refused = false;
  }
  fs::remove_all(link);
  fs::create_symlink(a.victim.parent_path(), link);
  if (refused) {
    CHECK_THROWS_WITH(a.run(set), Contains("is a link"));
  } else {
    a.run(set);
    CHECK(a.result()["sum"] == 6.0);
  }
  a.check_victim();
}

TEST_CASE("a continued stage does not write through links in its folder", "[workflows]") {
  Attack a;
  const Workflow workflow = load_workflow(
      a.scratch.write("count.yaml",
                      "schema: 1\nname: demo\nstages:\n"
                      "  one: {uses: sample.number, with: {value: 1}}\n"
                      "  count: {uses: sample.count, in: {start: one.number}, with: {steps: 9}}\n"),
      {}, a.types);
  std::atomic<bool> stop = true;
  RunEvents events;
  const fs::path out = a.scratch / "count";
  stop = false;
  events.progress = [&](std::string_view, double, std::string_view) { stop = true; };
  CHECK_THROWS(run_workflow(workflow, {.folder = out, .stop_requested = &stop}, events));
  const std::string key = plan_workflow(workflow, out)[1].decision.key;
  const fs::path sessions = work_folder(out, "count", key) / "sessions";
  fs::remove(sessions);
  SECTION("a link") { fs::create_symlink(a.victim, sessions); }
  SECTION("a second name") { fs::create_hard_link(a.victim, sessions); }
  std::string told;
  events = {};
  events.notice = [&](std::string_view text) { told += text; };
  run_workflow(workflow, {.folder = out}, events);
  CHECK_THAT(told, Contains("sessions is a link or no file"));
  a.check_victim();
}

TEST_CASE("what the user has put at the top stays", "[workflows]") {
  sample::RunBench bench;
  bench.scratch.write("out/view/notes.txt", "mine");
  CHECK_THROWS_WITH(bench.run(), Contains("view' was not made by this program"));
  CHECK(read_text_file(bench.out / "view/notes.txt") == "mine");
}
