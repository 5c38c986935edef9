#include "tests/support/paths.hpp"
#include "tests/workflows/run_bench.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/stages/stage_list.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using sample::RunBench;

namespace {

Task task(std::vector<std::uint32_t> settings) {
  return {.uses = "mpm.run",
          .work = {.seconds = 10.0, .parallel = 0.8, .memory = 1e8},
          .settings = std::move(settings)};
}

const Task kTask = task({1, 2, 3, 4, 5});

}  // namespace

TEST_CASE("cost of a stage: a first run takes what it takes on the usual machine") {
  const CostTable nothing;
  CHECK(nothing.expect(kTask, 1).seconds == Approx(10.0));
  CHECK(nothing.expect(kTask, 2).seconds == Approx(2.0 + 8.0 / 2));
  CHECK(nothing.expect(kTask, 2).memory == Approx(1e8));
  CHECK_FALSE(is_set(nothing.expect({.uses = "x", .work = {}, .settings = {}}, 1).seconds));
}

TEST_CASE("cost of a stage: the same again takes what it took, on any number of threads") {
  CostTable table;
  table.add(record_of(kTask, 2, 18.0, 2.5e8));
  // The usual machine weighs a thousandth of it.
  CHECK(table.expect(kTask, 2).seconds == Approx(18.0).epsilon(2e-3));
  CHECK(table.expect(kTask, 1).seconds == Approx(30.0).epsilon(2e-3));
  CHECK(table.expect(kTask, 1).memory == Approx(2.5e8).epsilon(2e-3));
  SECTION("a stage that says nothing of its work is compared with itself") {
    const Task silent{.uses = "sample", .work = {}, .settings = {1}};
    table.add(record_of(silent, 1, 7.0, 0.0));
    CHECK(table.expect(silent, 1).seconds == Approx(7.0));
    CHECK_FALSE(is_set(table.expect(silent, 1).memory));
  }
}

TEST_CASE("cost of a stage: what differs in fewer settings tells more") {
  CostTable table;
  table.add(record_of(task({1, 2, 3, 4, 6}), 1, 20.0, 0.0));     // ratio 2, one differs
  table.add(record_of(task({1, 2, 13, 14, 16}), 1, 80.0, 0.0));  // ratio 8, three differ
  const double near = 1.0 / 4, far = 1.0 / 16, usual = 1.0 / (31 * 31);
  const double ratio =
      std::exp((near * std::log(2.0) + far * std::log(8.0)) / (near + far + usual));
  CHECK(table.expect(kTask, 1).seconds == Approx(10.0 * ratio));
  CHECK(table.expect(kTask, 1).memory == Approx(1e8));
}

TEST_CASE("cost of a stage: the table keeps few records and none that cannot be") {
  CostTable table;
  for (int i = 0; i < 10; ++i) table.add(record_of(kTask, 1, 10.0 * (i + 1), 0.0));
  REQUIRE(table.records().at("mpm.run").size() == 3);
  CHECK(table.records().at("mpm.run").front().seconds == Approx(8.0));
  for (std::uint32_t i = 0; i < 100; ++i) table.add(record_of(task({i}), 1, 10.0, 0.0));
  CHECK(table.records().at("mpm.run").size() == 40);
  for (const double seconds : {0.0, -1.0, 1e12, kUnset})
    table.add(record_of(kTask, 1, seconds, 0.0));
  for (const CostRecord& r : table.records().at("mpm.run")) CHECK(r.settings.size() == 1);
}

TEST_CASE("cost book: two that share a file lose nothing") {
  const Scratch scratch;
  const auto file = scratch / "cache/costs.json";
  CostBook a(file), b(file);
  a.learn(kTask, 1, 20.0, 0.0);
  b.learn(task({7}), 1, 40.0, 0.0);
  const CostBook c(file);
  CHECK(c.expect(kTask, 1).seconds == Approx(20.0).epsilon(0.05));
  CHECK(c.expect(task({7}), 1).seconds == Approx(40.0).epsilon(0.25));  // the other differs in five
  SECTION("a short stage waits for the end") {
    a.learn(task({8}), 1, 0.1, 0.0);
    CHECK(CostBook(file).expect(task({8}), 1).seconds > 10.0);
    a.keep();
    CHECK(CostBook(file).expect(task({8}), 1).seconds < 1.0);
  }
  SECTION("what is recalled is for this process") {
    a.recall(task({9}), 1, 1000.0, 0.0);
    CHECK(a.expect(task({9}), 1).seconds > 300.0);
    a.learn(task({10}), 1, 20.0, 0.0);
    CHECK(CostBook(file).expect(task({9}), 1).seconds < 100.0);
  }
}

TEST_CASE(
    "cost book: without a file that can be read or written there are estimates all the same") {
  const Scratch scratch;
  const auto file = scratch / "costs.json";
  const std::string text =
      GENERATE("", "not json", "{}",
               R"({"schema": 1, "stages": {"mpm.run": [{"seconds": "x"}]}, "sha256": 0})");
  scratch.write("costs.json", text);
  CostBook book(file);
  CHECK(book.expect(kTask, 1).seconds == Approx(10.0));
  book.learn(kTask, 1, 20.0, 0.0);
  CHECK(CostBook(file).expect(kTask, 1).seconds == Approx(20.0).epsilon(2e-3));  // replaced
  CostBook below(file / "costs.json");
  below.learn(kTask, 1, 20.0, 0.0);
  CHECK(below.expect(kTask, 1).seconds == Approx(20.0).epsilon(2e-3));
  CostBook none;
  none.learn(kTask, 1, 20.0, 0.0);
}

TEST_CASE("cost book: a forged file is read as a whole or not at all") {
  const Scratch scratch;
  const std::string records =
      GENERATE(R"([{"seconds": 2, "memory": null, "settings": [3, 1]}])",
               R"([{"seconds": 2, "memory": null, "settings": [5000000000]}])",
               R"([{"seconds": 2, "memory": null, "settings": [-1]}])", R"({"seconds": 2})", "7");
  const Json json = {{"schema", 1}, {"stages", {{"mpm.run", Json::parse(records)}}}};
  scratch.write("costs.json", seal(json));
  CHECK(CostBook(scratch / "costs.json").expect(kTask, 1).seconds == Approx(10.0));
}

TEST_CASE("a run learns what its stages take, and a plan tells it") {
  RunBench bench;
  CostBook book(bench.scratch / "costs.json");
  const Workflow workflow = bench.load();
  RunOptions options{.folder = bench.out};
  options.costs = &book;
  std::vector<Cost> expected;
  RunEvents events;
  events.decided = [&](std::string_view, const Decision& d) { expected.push_back(d.expected); };
  run_workflow(workflow, options, events);
  REQUIRE(expected.size() == 3);
  CHECK_FALSE(is_set(expected[0].seconds));  // nothing is known of such a stage
  CHECK(is_set(expected[1].seconds));        // but of the same kind
  book.keep();
  const CostBook later(bench.scratch / "costs.json");
  for (const PlanLine& line : plan_workflow(workflow, bench.scratch / "elsewhere", &later, 1)) {
    CHECK(is_set(line.decision.expected.seconds));
    CHECK(line.decision.expected.seconds < 10.0);
  }
  for (const PlanLine& line : plan_workflow(workflow, bench.out, &later, 1))
    CHECK_FALSE(is_set(line.decision.expected.seconds));  // up to date
}

TEST_CASE("what other programs take is not learnt") {
  const Work work{.seconds = 10.0, .parallel = 0.95, .memory = 1e8};
  const double alone = work.on(2);
  const double used = 10.0;  // by both threads together
  CHECK(quiet_seconds(work, 2, 8.0 * alone, used) == Approx(alone));
  CHECK(quiet_seconds(work, 2, alone, used) == Approx(alone));
  CHECK(quiet_seconds(work, 1, 80.0, used) == Approx(10.0));
  // Helper processes may use more than the stage says that it divides.
  CHECK(quiet_seconds({.seconds = 6.0, .parallel = 0.0, .memory = 1e8}, 2, 3.0, 6.0) == 3.0);
}

TEST_CASE("the damping of another program shortens the steps that a shaking is expected to take") {
  const auto seconds = [](const std::vector<std::string>& set) {
    const Workflow workflow =
        load_workflow(test::source("workflows/mochikoshi.yaml"), set, all_stages());
    return workflow.stages[2].work.seconds;
  };
  const double own = seconds({"stages.shake.with.damping={}"});
  const double like = seconds({"stages.shake.with.damping={like_newmark: {}}"});
  CHECK(like > 1.5 * own);
  // Written out, rounded to 0.00447 s: the same.
  CHECK(like == Approx(seconds({"stages.shake.with.damping.largest_ratio=null"})).epsilon(0.01));
  // Bounded by what is critical for the thinnest element (0.66 m): 1/(a + sqrt(a^2 + 1/u^2)) with
  // 1/u = 1060/s and a = 380 in place of 640/s.
  CHECK(seconds({}) / like == Approx(0.80).epsilon(0.02));
}

TEST_CASE("every stage of the shipped workflows says how much it has to do") {
  const std::string file = GENERATE("mochikoshi-static.yaml", "mochikoshi.yaml");
  const auto seconds = [&](const std::vector<std::string>& set) {
    double flow = kUnset;
    for (const WorkflowStage& s :
         load_workflow(test::source("workflows/" + file), set, all_stages()).stages) {
      CAPTURE(s.name);
      CHECK(s.work.seconds > 0.0);
      CHECK(s.work.memory > 1e7);
      if (s.name == "flow") flow = s.work.seconds;
    }
    return flow;
  };
  // Half the cell: four times the points, twice the steps; what a stage takes in any case is little
  // beside that.
  CHECK(seconds({"stages.flow.with.cell=0.625 m"}) / seconds({"stages.flow.with.cell=1.25 m"}) ==
        Approx(8.0).epsilon(0.02));
}
