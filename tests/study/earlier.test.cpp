#include "tests/study/study_bench.hpp"
#include "workflows/engine/runner.hpp"

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// Tells the settings of all that feeds it, and reads the files of stages that it is not linked to.
struct ChroniclerStage {
  static constexpr std::string_view name = "sample.chronicler";
  static constexpr std::string_view doc = "Tells what was before.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = false;
  static constexpr bool reads_earlier = true;
  using Config = NoSettings;
  struct Inputs {
    Artifact<NumberFile> number;
    void visit(auto&& port) { port("number", number); }
  };
  struct Outputs {
    Artifact<TextFile> text{"text.txt"};
    void visit(auto&& port) { port("text", text); }
  };
  static StageResult run(const RunContext& context, const Config&, const Inputs&,
                         const Outputs& out) {
    std::ofstream text(out.text.path);
    for (const EarlierStage& s : context.earlier) {
      text << s.name << ' ' << s.settings << '\n';
      if (const auto number = s.outputs.find("number"); number != s.outputs.end())
        text << read_text_file(number->second.path);
    }
    return {};
  }
};

/// Says whether a day has come, and whether it tells the day.
template <bool kTellsDay>
struct DayStage : ChroniclerStage {
  static constexpr std::string_view name = "sample.day";
  static constexpr bool dated = kTellsDay;
  static constexpr bool reads_earlier = false;
  static StageResult run(const RunContext&, const Config&, const Inputs&, const Outputs& out) {
    std::ofstream(out.text.path) << (std::getenv("FLOWSLIDE_TEST_DAY") ? "later" : "today");
    return {};
  }
};

const std::string kChronicle =
    "schema: 1\nname: demo\nstages:\n"
    "  one: {uses: sample.number, with: {value: 1}}\n"
    "  two: {uses: sample.number, with: {value: 2}}\n"
    "  sum: {uses: sample.sum, in: {a: one.number, b: two.number}}\n"
    "  other: {uses: sample.number, with: {value: 9}}\n"
    "  tell: {uses: sample.chronicler, in: {number: sum.sum}}\n";

}  // namespace

TEST_CASE("A stage that tells of earlier ones tells the same in a study as in a run", "[study]") {
  StudyBench bench(kChronicle);
  bench.types.push_back(stage_type<ChroniclerStage>());
  run_workflow(load_workflow(bench.scratch / "base.yaml", {}, bench.types),
               {.folder = bench.scratch / "single"}, {});
  const Plan plan = bench.plan("");
  bench.run(plan);
  const StudyState progress = bench.progress(plan);
  const NodeState& tell = progress.node(plan.rows[0].nodes.back());
  REQUIRE(tell.state == State::done);
  // The same key, or the text would lie elsewhere.
  const std::string alone =
      read_text_file(Store(bench.scratch / "single").result("tell", tell.key) / "text.txt");
  CHECK_THAT(alone, Contains("one value = 1") && Contains("sum ") && !Contains("other"));
  CHECK(read_text_file(Store(bench.folder).result("tell", tell.key) / "text.txt") == alone);
  // What is read back of the plan knows it too.
  write_plan(bench.folder, plan);
  const Plan again = read_plan(bench.folder);
  CHECK(StudyState(again, Store(bench.folder)).count(State::done) == plan.nodes.size());
}

TEST_CASE("Files of earlier stages that a stage reads are made again where they have gone",
          "[study]") {
  StudyBench bench(kChronicle);
  bench.types.push_back(stage_type<ChroniclerStage>());
  const Plan plan = bench.plan("  keep: frames\n");
  bench.run(plan);
  const Store store(bench.folder);
  const StudyState progress = bench.progress(plan);
  const std::string one = progress.node(plan.rows[0].nodes.front()).key,
                    tell = progress.node(plan.rows[0].nodes.back()).key;
  const auto text = store.result("tell", tell) / "text.txt";
  const std::string before = read_text_file(text);
  REQUIRE_THAT(before, Contains("one value = 1\n\n1\n"));
  // The file of its link stays; that of a stage before it goes.
  store.drop_files("one", one);
  store.drop_files("tell", tell);
  std::filesystem::remove(store.beside("tell", tell, ".json"));
  bench.run(plan);
  CHECK(read_text_file(text) == before);
  CHECK(bench.made_by_stage() ==
        std::map<std::string, int>{{"one", 2}, {"two", 1}, {"sum", 1}, {"other", 1}, {"tell", 2}});
}

TEST_CASE("A result that tells the day may be made again on another day", "[study]") {
  const auto again = [](StageType type) {
    type.name = "sample.chronicler";
    StudyBench bench(kChronicle);
    bench.types.push_back(std::move(type));
    const Plan plan = bench.plan("");
    bench.run(plan);
    const Store store(bench.folder);
    const std::string key = bench.progress(plan).node(plan.rows[0].nodes.back()).key;
    store.drop_files("tell", key);
    const Job job{.store = bench.folder,
                  .workflow = bench.scratch / "base.yaml",
                  .overrides = {},
                  .stage = "tell",
                  .key = key,
                  .allowed_programs = {}};
    ::setenv("FLOWSLIDE_TEST_DAY", "later", 1);
    std::string problem;
    try {
      (void)run_job(job, bench.types, nullptr, [](double, std::string_view) {});
    } catch (const NumericsError& e) {
      problem = e.what();
    }
    ::unsetenv("FLOWSLIDE_TEST_DAY");
    return problem;
  };
  CHECK(again(stage_type<DayStage<true>>()).empty());
  CHECK_THAT(again(stage_type<DayStage<false>>()), Contains("gave another 'text'"));
}
