#include "workflows/engine/warnings.hpp"

#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"
#include "workflows/engine/runner.hpp"

#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

struct OddConfig {
  double value = 1.0;
  double limit = 10.0;  ///< a value above it gets a warning; no part of the result
};

/// Writes 1, whatever its settings.
struct OddStage {
  static constexpr std::string_view name = "sample.odd";
  static constexpr std::string_view doc = "A number that may be odd.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = false;
  using Config = OddConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<NumberFile> number{"number.txt"};
    void visit(auto&& port) { port("number", number); }
  };
  static std::any preview(const Config& c, const Previews&, Findings& found) {
    if (c.value < 0.0) found.errors.emplace_back("value is negative");
    if (c.value < 0.0) found.errors.emplace_back("and so is its root");
    if (c.value > 100.0) found.warnings.emplace_back("value is above 100.");
    return c.value;
  }
  static StageResult run(const RunContext&, const Config& c, const Inputs&, const Outputs& out) {
    std::ofstream(out.number.path) << 1;
    StageResult result;
    if (c.value > c.limit) result.warnings.emplace_back("the number is large.");
    return result;
  }
};

struct ReaderStage {
  static constexpr std::string_view name = "sample.reader";
  static constexpr std::string_view doc = "Tells what it was warned about.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = false;
  static constexpr bool reads_warnings = true;
  using Config = NoSettings;
  struct Inputs {
    Artifact<NumberFile> number;
    void visit(auto&& port) { port("number", number); }
  };
  struct Outputs {
    Artifact<TextFile> text{"text.txt"};
    void visit(auto&& port) { port("text", text); }
  };
  static std::any preview(const Config&, const Previews& in, Findings& found) {
    if (std::any_cast<double>(in.at("number")) == 50.0) found.warnings.emplace_back("fed with 50.");
    return {};
  }
  static StageResult run(const RunContext& context, const Config&, const Inputs&,
                         const Outputs& out) {
    std::ofstream(out.text.path) << fmt::format("{}", fmt::join(context.warnings, "|"));
    return {};
  }
};

/// Tells the settings and results that it builds on.
struct ChroniclerStage : ReaderStage {
  static constexpr std::string_view name = "sample.chronicler";
  static constexpr bool reads_warnings = false;
  static constexpr bool reads_earlier = true;
  static StageResult run(const RunContext& context, const Config&, const Inputs&,
                         const Outputs& out) {
    std::ofstream text(out.text.path);
    for (const EarlierStage& s : context.earlier)
      text << s.name << ' ' << s.uses << ' ' << s.settings
           << read_text_file(s.outputs.at("number").path);
    return {};
  }
};

}  // namespace

template <>
struct flowslide::Schema<OddConfig> {
  static constexpr std::string_view doc = "A number.";
  static void describe(FieldVisitor& v, OddConfig& c) {
    v.quantity("value", c.value, Dim::none, {}, "a number");
    v.quantity("limit", c.limit, Dim::none, {}, "of what is usual");
  }
};

namespace {

struct Told {
  std::map<std::string, std::string> why;
  std::vector<std::string> warnings;
};

struct Bench {
  Scratch scratch;
  std::vector<StageType> types{stage_type<OddStage>(), stage_type<ReaderStage>()};

  [[nodiscard]] Workflow load(const std::string& value) const {
    scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n  a: {uses: sample.odd, with: {value: " +
                                value + "}}\n  b: {uses: sample.reader, in: {number: a.number}}\n");
    return load_workflow(scratch / "w.yaml", {}, types);
  }
  [[nodiscard]] Told run(const std::string& value) const {
    Told told;
    RunEvents events;
    events.decided = [&](std::string_view stage, const Decision& d) {
      told.why[std::string(stage)] = d.why;
    };
    events.warned = [&](std::string_view stage, const std::vector<std::string>& all) {
      for (const std::string& text : all) told.warnings.push_back(std::string(stage) + ": " + text);
    };
    run_workflow(load(value), {.folder = scratch / "out"}, events);
    return told;
  }
  [[nodiscard]] nlohmann::json result() const {
    return nlohmann::json::parse(read_text_file(scratch / "out/result.json"));
  }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("Warnings of a stage are told, kept, and told again when its result is used again") {
  const Bench bench;
  CHECK(bench.run("1").warnings.empty());
  CHECK(bench.result()["warnings"].empty());
  const Lines large{"a: the number is large."};
  CHECK(bench.run("20").warnings == large);
  CHECK(bench.result()["warnings"] == nlohmann::json(large));
  CHECK(bench.result()["stages"]["a"]["facts"]["warnings"].size() == 1);
  const Told again = bench.run("20");
  CHECK(again.why.at("a") == "up to date");
  CHECK(again.warnings == large);
  CHECK(bench.result()["warnings"] == nlohmann::json(large));
}

TEST_CASE("Warnings about settings are told before the stage runs, and once with its own") {
  const Bench bench;
  const Told told = bench.run("200");
  CHECK(told.warnings ==
        Lines{"a: value is above 100.", "a: value is above 100.", "a: the number is large."});
  CHECK(bench.result()["warnings"].size() == 2);
  CHECK(bench.run("50").warnings.back() == "b: fed with 50.");
}

TEST_CASE("A stage that reads warnings runs again when they change") {
  const Bench bench;
  CHECK(bench.run("1").why.at("b") == "no result yet");
  CHECK(bench.run("2").why.at("b") == "up to date");  // control: same number, nothing to tell
  CHECK(bench.run("20").why.at("b") == "input changed (warnings)");
  const auto key = bench.result()["stages"]["b"]["key"].get<std::string>().substr(0, 16);
  CHECK(read_text_file(bench.scratch / "out/stages/b" / key / "text.txt") ==
        "a: the number is large.");
  CHECK(bench.run("30").why.at("b") == "up to date");
}

TEST_CASE("A stage that tells of earlier ones knows their settings, and runs again with them") {
  Bench bench;
  bench.types.push_back(stage_type<ChroniclerStage>());
  const auto run = [&](const char* value) {
    bench.scratch.write(
        "w.yaml",
        fmt::format("schema: 1\nname: w\nstages:\n  a: {{uses: sample.odd, with: {{value: {}}}}}\n"
                    "  other: {{uses: sample.odd}}\n"
                    "  b: {{uses: sample.chronicler, in: {{number: a.number}}}}\n",
                    value));
    std::string why;
    RunEvents events;
    events.decided = [&](std::string_view stage, const Decision& d) {
      if (stage == "b") why = d.why;
    };
    run_workflow(load_workflow(bench.scratch / "w.yaml", {}, bench.types),
                 {.folder = bench.scratch / "out"}, events);
    return why;
  };
  CHECK(run("1") == "no result yet");
  CHECK(run("1") == "up to date");
  CHECK(run("2") == "input changed (stages)");  // the number it reads is the same
  const auto key = bench.result()["stages"]["b"]["key"].get<std::string>().substr(0, 16);
  CHECK(read_text_file(bench.scratch / "out/stages/b" / key / "text.txt") ==
        "a sample.odd value = 2\nlimit = 10\n1");  // and nothing of the stage that does not feed it
  CHECK(
      plan_workflow(load_workflow(bench.scratch / "w.yaml", {}, bench.types), bench.scratch / "out")
          .back()
          .decision.action == Action::reuse);
}

TEST_CASE("Errors of a look at the files stand at the stage's settings, one to a line") {
  const Bench bench;
  CHECK_THROWS_WITH(bench.load("-1"), Contains("w.yaml:4:") &&
                                          Contains("stages.a.with: value is") && Contains("\n") &&
                                          Contains("and so is its root"));
  CHECK(bench.load("200").stages[0].warnings.size() == 1);
}

TEST_CASE("An option for a stage that is not there names the nearest") {
  const Bench bench;
  bench.scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n  flow: {uses: sample.odd}\n");
  const std::vector<std::string> option{"stages.flw.with.value=1"}, far{"stages.x.with.value=1"};
  const auto load = [&](const std::vector<std::string>& set) {
    return load_workflow(bench.scratch / "w.yaml", set, bench.types);
  };
  CHECK_THROWS_WITH(load(option), Contains("no such stage") && Contains("Did you mean 'flow'?"));
  CHECK_THROWS_WITH(load(far), Contains("no such stage") && Contains("Known: flow."));
}
