#include "study/numbers/random.hpp"
#include "study/run/work_costs.hpp"
#include "tests/study/study_bench.hpp"

#include <chrono>
#include <thread>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// Long enough to be killed in the midst of it.
const std::string kSlow =
    kValues + "  set: {stages.count.with.steps: 30, stages.count.with.step_us: 2000}\n";

int end_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("What rows share runs once", "[study]") {
  StudyBench bench;
  const std::string csv = bench.run(kValues);
  // 3 numbers and the other one, 6 sums, 6 counts
  CHECK(bench.made_by_stage() ==
        std::map<std::string, int>{{"one", 3}, {"two", 1}, {"sum", 6}, {"count", 6}});
  CHECK_THAT(csv, Contains("row,id,variant,one,factor,repeat,state,cause,"));
  CHECK_THAT(csv, Contains("base,3,10,0,done,,"));
  CHECK(bench.run(kValues) == csv);
  CHECK(bench.made().size() == 16);
}

TEST_CASE("A study learns what its stages take, for itself and for the next one", "[study]") {
  StudyBench bench;
  bench.costs = bench.scratch / "cache/costs.json";
  const Plan plan = bench.plan(kValues);
  const auto costs = [&](const std::filesystem::path& file) {
    return WorkCosts(plan, bench.progress(plan), file, 1);
  };
  CHECK_FALSE(is_set(costs({}).seconds(0)));
  CHECK(costs({}).memory(0) == 300e6);
  bench.run(plan);
  const WorkCosts here = costs({});
  std::filesystem::remove_all(bench.folder / "stages");
  const WorkCosts next = costs(bench.costs);
  CHECK_FALSE(is_set(costs({}).seconds(0)));  // the control: from the file alone
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    CHECK(here.seconds(n) > 0.0);
    CHECK(next.seconds(n) == Approx(here.seconds(n)).epsilon(1e-6));
  }
}

TEST_CASE("A row that is added runs its own stages only, one taken away none", "[study]") {
  StudyBench bench;
  bench.run(kValues);
  const std::string more =
      "  vary:\n"
      "    one: {setting: stages.one.with.value, values: [1, 2, 3]}\n"
      "    factor: {setting: stages.sum.with.factor, values: [1, 10, 100]}\n";
  bench.run(more);
  CHECK(bench.made_by_stage() ==
        std::map<std::string, int>{{"one", 3}, {"two", 1}, {"sum", 9}, {"count", 9}});
  bench.run("  vary: {one: {setting: stages.one.with.value, values: [3, 1]}}\n");
  CHECK(bench.made().size() == 22);
}

TEST_CASE("Killed three times at random and resumed, a study has the same table", "[study]") {
  StudyBench undisturbed;
  const std::string expected = undisturbed.run(kSlow);
  StudyBench bench;
  const Plan plan = bench.plan(kSlow);
  Random random(42);
  for (int kill = 0; kill < 3; ++kill) {
    const pid_t child = bench.start(plan);
    std::this_thread::sleep_for(std::chrono::milliseconds(60 + random.below(120)));
    ::kill(child, SIGKILL);
    end_of(child);
  }
  CHECK(bench.run(plan) == expected);
  CHECK_FALSE(bench.made_twice());
}

TEST_CASE("Stages end with the study that started them", "[study]") {
  StudyBench bench;
  bench.before = [&](const Job& job) {
    if (job.stage != "count") return;
    bench.scratch.write("pid-" + job.key, std::to_string(::getpid()));
    std::this_thread::sleep_for(std::chrono::seconds(20));
  };
  const pid_t child = bench.start(bench.plan(""));
  std::string pid;
  for (int i = 0; i < 500 && pid.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    for (const auto& entry : std::filesystem::directory_iterator(bench.scratch.path()))
      if (entry.path().filename().string().starts_with("pid-")) pid = read_text_file(entry.path());
  }
  REQUIRE_FALSE(pid.empty());
  ::kill(child, SIGKILL);
  end_of(child);
  bool gone = false;
  for (int i = 0; i < 200 && !gone; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    // What has ended but has no parent yet to ask for it is a zombie.
    const std::string stat = read_text_file("/proc/" + pid + "/stat");
    gone = stat.empty() || stat.find(") Z") != std::string::npos;
  }
  CHECK(gone);
}

TEST_CASE("Two processes at once share the work", "[study]") {
  StudyBench undisturbed;
  const std::string expected = undisturbed.run(kSlow);
  StudyBench bench;
  const Plan plan = bench.plan(kSlow);
  const pid_t a = bench.start(plan), b = bench.start(plan);
  CHECK(end_of(a) == 0);
  CHECK(end_of(b) == 0);
  CHECK_FALSE(bench.made_twice());
  CHECK(bench.made().size() == 16);
  CHECK(bench.run(plan) == expected);
}

TEST_CASE("A stage that fails is listed with its cause, and the rest goes on", "[study]") {
  StudyBench bench;
  const std::string study =
      "  vary:\n"
      "    one: {setting: stages.one.with.value, values: [1, 2]}\n"
      "    fail: {setting: stages.sum.with.fail, values: [false, true]}\n";
  const Plan plan = bench.plan(study);
  const std::string csv = bench.run(plan);
  const StudyState progress = bench.progress(plan);
  CHECK(progress.row_state(plan.rows[0]) == State::done);
  CHECK(progress.row_state(plan.rows[1]) == State::failed);
  CHECK(progress.row_state(plan.rows[2]) == State::done);
  CHECK(progress.cause(plan.rows[1]) == "sum: the sum did not converge");
  CHECK_THAT(csv, Contains("failed,sum: the sum did not converge"));
  // It would fail again, and is not tried until it is asked for.
  int tries = 0;
  bench.before = [&](const Job& job) { bench.scratch.write("tried-" + job.key, ""); };
  const auto count = [&] {
    tries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(bench.scratch.path()))
      tries += entry.path().filename().string().starts_with("tried-");
    return tries;
  };
  bench.run(plan);
  CHECK(count() == 0);
  bench.retry = true;
  bench.run(plan);
  CHECK(count() == 2);
}

TEST_CASE("A row whose settings are wrong does not stop the others", "[study]") {
  StudyBench bench;
  const Plan plan =
      bench.plan("  vary: {one: {setting: stages.one.with.value, values: [1, 13, -2]}}\n");
  const std::string csv = bench.run(plan);
  CHECK(plan.rows[0].problem.empty());
  CHECK_THAT(plan.rows[1].problem, Contains("value 13 is refused"));
  CHECK_THAT(plan.rows[2].problem, Contains("study.yaml:5:") && Contains("-2"));
  CHECK_THAT(csv, Contains("base,1,0,done") && Contains("base,13,0,failed"));
}

TEST_CASE("A stage that is killed has failed for this time", "[study]") {
  StudyBench bench;
  bench.before = [](const Job& job) {
    if (job.stage == "sum") ::raise(SIGKILL);
  };
  const Plan plan = bench.plan("");
  bench.run(plan);
  CHECK_THAT(bench.progress(plan).cause(plan.rows[0]), Contains("ended by signal 9"));
  bench.before = [](const Job&) {};
  bench.run(plan);
  CHECK(bench.progress(plan).row_state(plan.rows[0]) == State::done);
}

TEST_CASE("A stage that takes too long is stopped and can go on later", "[study]") {
  StudyBench bench;
  static std::atomic<bool> stop;
  stop = false;
  bench.stop = nullptr;
  bench.before = [&](const Job&) {
    ::signal(SIGTERM, [](int) { stop = true; });
    bench.stop = &stop;
  };
  const std::string slow =
      "  set: {stages.count.with.steps: 60, stages.count.with.step_us: 10000}\n";
  const Plan plan = bench.plan(slow + "  limits: {stage_time: 0.3 s}\n");
  bench.run(plan);
  CHECK_THAT(bench.progress(plan).cause(plan.rows[0]), Contains("longer than 0.3 s"));
  bench.run(bench.plan(slow));
  const StudyState progress = bench.progress(plan);
  REQUIRE(progress.row_state(plan.rows[0]) == State::done);
  const Store store(bench.folder);
  const NodeState& count = progress.node(plan.rows[0].nodes.back());
  std::istringstream sessions(read_text_file(store.result("count", count.key) / "sessions"));
  int first = -1, second = -1;
  sessions >> first >> second;
  CHECK(first == 0);
  CHECK(second > 0);
}

TEST_CASE("A study that is told to stop keeps what it has", "[study]") {
  StudyBench bench;
  const std::atomic<bool> stop = true;
  bench.stop = &stop;
  CHECK_THROWS_AS(bench.run(kValues), Interrupted);
  bench.stop = nullptr;
  CHECK_THAT(bench.run(kValues), Contains("done"));
}

TEST_CASE("A workflow that is edited meanwhile is no failure: it is planned again", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues);
  const auto edit = [&](const std::string& from, const std::string& to) {
    std::string text = std::string(kWorkflow);
    bench.scratch.write("base.yaml", text.replace(text.find(from), from.size(), to));
  };
  const auto failures = [&] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(bench.folder))
      count += entry.path().string().ends_with(".failed.json");
    return count;
  };
  // Other settings; another name; what cannot be read.
  edit("value: 2", "value: 5");
  (void)bench.run(plan);
  CHECK(bench.end == PoolEnd::outdated);
  edit("sum: {uses", "total: {uses");
  (void)bench.run(plan);
  CHECK(bench.end == PoolEnd::outdated);
  edit("schema: 1", "schema: 1\nschema: 1");
  (void)bench.run(plan);
  CHECK(bench.end == PoolEnd::outdated);
  CHECK(failures() == 0);
  const std::size_t made = bench.made().size();
  // Back, or planned again, it goes on, with what was made before.
  edit("value: 2", "value: 2");
  const std::string csv = bench.run(plan);
  CHECK(bench.end == PoolEnd::done);
  CHECK_THAT(csv, !Contains("failed") && !Contains("open"));
  CHECK(bench.made().size() == 16);
  CHECK(made <= 16);
}
