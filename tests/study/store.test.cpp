#include "core/files.hpp"
#include "study/run/clean.hpp"
#include "study/run/locks.hpp"
#include "study/run/session_record.hpp"
#include "study/run/tidy.hpp"
#include "tests/study/study_bench.hpp"
#include "workflows/engine/sealed_json.hpp"

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

std::size_t folders_of_results(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& stage : std::filesystem::directory_iterator(folder / "stages"))
    for (const auto& entry : std::filesystem::directory_iterator(stage.path()))
      count += entry.is_directory();
  return count;
}

}  // namespace

TEST_CASE("With keep: numbers the files go and the table stays", "[study]") {
  StudyBench bench, full;
  const std::string csv = full.run(kValues);
  CHECK(bench.run(kValues + "  keep: numbers\n") == csv);
  CHECK(folders_of_results(bench.folder) == 0);
  CHECK(folders_of_results(full.folder) == 16);
  CHECK(bench.run(kValues + "  keep: numbers\n") == csv);
  CHECK(bench.made().size() == 16);
  // A new row needs files that have gone: those are made again, the same, and no others.
  const std::string more =
      "  vary:\n"
      "    one: {setting: stages.one.with.value, values: [1]}\n"
      "    factor: {setting: stages.sum.with.factor, values: [1, 10, 5]}\n";
  bench.run(more + "  keep: numbers\n");
  CHECK(bench.made_by_stage() ==
        std::map<std::string, int>{{"one", 4}, {"two", 2}, {"sum", 7}, {"count", 7}});
  CHECK(folders_of_results(bench.folder) == 0);
}

TEST_CASE("The disk is bounded: what is cheap for its size goes first", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues + "  disk: 0.001 MB\n");
  bench.run(plan);
  CHECK(folders_of_results(bench.folder) == 0);
  CHECK(bench.progress(plan).count(State::done) == plan.nodes.size());
  StudyBench roomy;
  roomy.run(kValues + "  disk: 1 GB\n");
  CHECK(folders_of_results(roomy.folder) == 16);
}

TEST_CASE("A result that was damaged is made again when it is needed", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("");
  bench.run(plan);
  const Store store(bench.folder);
  const StudyState progress = bench.progress(plan);
  const auto& one = progress.node(plan.rows[0].nodes[0]);
  REQUIRE(one.finished->record.stage == "one");
  std::ofstream(store.result("one", one.key) / "number.txt") << "7\n";
  const std::string csv = bench.run("  set: {stages.sum.with.factor: 2}\n");
  CHECK_THAT(csv, Contains("done"));
  CHECK(bench.notices.size() == 1);
  CHECK(read_text_file(store.result("one", one.key) / "number.txt") == "1\n");
  CHECK(bench.made_by_stage()["one"] == 2);
}

TEST_CASE("What is known of a stage is checked by its checksum", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("");
  const std::string csv = bench.run(plan);
  const Store store(bench.folder);
  const std::string key = bench.progress(plan).node(plan.rows[0].nodes[2]).key;
  const auto path = store.beside("sum", key, ".json");
  std::string text = read_text_file(path);
  text[text.find("\"sum\": 3") + 7] = '4';
  std::ofstream(path) << text;
  CHECK_FALSE(store.finished("sum", key));
  // The result is still there: it is read, not computed.
  CHECK(bench.run(plan) == csv);
  CHECK(bench.made().size() == 4);
}

TEST_CASE("Clean takes away what no row needs", "[study]") {
  StudyBench bench;
  bench.run(kValues);
  const Plan few = bench.plan("  vary: {one: {setting: stages.one.with.value, values: [1]}}\n");
  const Store store(bench.folder);
  const StudyState progress = bench.progress(few);
  const double before = bytes_of(bench.folder / "stages");
  const Cleaned would = clean(few, store, progress, true);
  CHECK(bytes_of(bench.folder / "stages") == before);
  const Cleaned cleaned = clean(few, store, progress, false);
  CHECK(cleaned.results == 12);
  CHECK(would.bytes == cleaned.bytes);
  CHECK(bytes_of(bench.folder / "stages") == before - cleaned.bytes);
  bench.run(few);
  CHECK(bench.made().size() == 16);
  CHECK(clean(few, store, progress, false).results == 0);
}

TEST_CASE("Locks hold between processes and end with them", "[study]") {
  const Scratch scratch;
  const std::string key(64, 'a'), other = "b" + std::string(63, 'a');
  Locks mine(scratch.path());
  Locks theirs(scratch.path());  // another open file is as good as another process
  CHECK(mine.take(key));
  CHECK(theirs.is_taken(key));
  CHECK_FALSE(theirs.take(key));
  CHECK_FALSE(theirs.take_shared(key));
  CHECK(theirs.take(other));
  mine.release(key);
  CHECK(theirs.take_shared(key));
  CHECK(mine.take_shared(key));
  CHECK_FALSE(mine.take(key));
  {
    Locks short_lived(scratch.path());
    CHECK_FALSE(short_lived.take(other));
  }
  CHECK(theirs.take_shared(key));
}

TEST_CASE("A folder that holds no study is refused", "[study]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(read_plan(scratch.path()), Contains("no folder of a study"));
  scratch.write("study.json", "{}");
  CHECK_THROWS_AS(read_plan(scratch.path()), InputError);
}

TEST_CASE("A plan is read back as it was", "[study]") {
  StudyBench bench;
  const Plan plan =
      bench.plan(kValues + "  repeat: {count: 2, scale: {stages.one.with.value: 1e-6}}\n");
  std::filesystem::create_directories(bench.folder);
  write_plan(bench.folder, plan);
  CHECK(to_json(read_plan(bench.folder)) == to_json(plan));
  bench.run(plan);
  const Plan again = read_plan(bench.folder);
  const Store store(bench.folder);
  CHECK(StudyState(again, store).count(State::done) == plan.nodes.size());
}

TEST_CASE("A hostile plan is refused with a message", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues);
  std::filesystem::create_directories(bench.folder);
  const Json good = to_json(plan);
  const auto refusal = [&](const std::function<void(Json&)>& change) {
    Json json = good;
    change(json);
    write_file(bench.folder / kPlanFile, seal(json));
    try {
      (void)read_plan(bench.folder);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(refusal([](Json&) {}).empty());
  CHECK_THAT(refusal([](Json& j) { j["nodes"][2]["before"][0] = UINT64_MAX; }),
             Contains("comes before what feeds it"));
  CHECK_THAT(refusal([](Json& j) { j["nodes"][0]["before"] = {UINT64_MAX}; }),
             Contains("comes before what feeds it"));
  CHECK_THAT(refusal([](Json& j) { j["nodes"][0]["before"] = {0}; }),
             Contains("comes before what feeds it"));
  for (const char* path : {"", "s", "stages", "stages.", "elsewhere.one"})
    CHECK_THAT(refusal([&](Json& j) { j["inputs"][0]["settings"] = {path}; }),
               Contains("is no path of a setting"));
  for (const char* name : {"", "..", "../../up", "a/b"})
    CHECK_THAT(refusal([&](Json& j) { j["nodes"][0]["stage"] = name; }),
               Contains("is no name of a stage"));
  CHECK_THAT(refusal([](Json& j) { j["rows"][0]["nodes"][0] = UINT64_MAX; }),
             Contains("names a stage that is not there"));
}

TEST_CASE("What the store takes is known without walking through it for each stage", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues + "  disk: 1 GB\n");
  bench.run(plan);
  const Store store(bench.folder);
  std::ofstream(bench.folder / "stages/one/foreign") << std::string(1000, 'x');
  Locks locks(bench.folder);
  const auto on_disk = [&] { return bytes_of(bench.folder / "stages"); };
  Tidier tidier(plan, store, locks);
  CHECK(tidier.tidy(bench.progress(plan)) == on_disk());
  // A smaller disk: what goes is subtracted, what comes again is added.
  Plan small = plan;
  small.disk_bytes = 0.6 * on_disk();
  Tidier tight(small, store, locks);
  const double left = tight.tidy(bench.progress(plan));
  CHECK(left <= small.disk_bytes);
  CHECK(left == on_disk());
  bench.run(bench.plan("  set: {stages.sum.with.factor: 3}\n  disk: 1 GB\n"));
  CHECK(Tidier(plan, store, locks).tidy(bench.progress(plan)) == on_disk());
}

TEST_CASE("What a study cost is read back in order, without what is damaged", "[study]") {
  const Scratch scratch;
  CHECK(read_sessions(scratch.path()).empty());
  SessionLog log(scratch.path(),
                 {.began = {}, .program = "a", .processor = "b", .processors = 4, .threads = 2});
  log.stage_made();
  log.stage_made();
  scratch.write("sessions/2000.json", seal({{"schema", 1}, {"began", "2000"}}));
  scratch.write("sessions/2001.json", "{");
  const std::vector<SessionRecord> sessions = read_sessions(scratch.path());
  REQUIRE(sessions.size() == 1);
  CHECK(sessions[0].stages == 2);
  CHECK(sessions[0].processor == "b");
  CHECK(sessions[0].threads == 2);
  CHECK(sessions[0].wall_seconds >= 0.0);
}
