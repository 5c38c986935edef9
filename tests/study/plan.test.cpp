#include "study/plan/perturb.hpp"
#include "tests/study/study_bench.hpp"

#include <set>

#include <fmt/format.h>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

std::vector<std::string> labels(const Plan& plan) {
  std::vector<std::string> result;
  for (const Row& row : plan.rows) result.push_back(row.label());
  return result;
}

std::string refusal(const StudyBench& bench, const std::string& study) {
  try {
    (void)bench.plan(study);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Variables are crossed, the first changes slowest", "[study]") {
  const StudyBench bench;
  const Plan plan = bench.plan(kValues);
  CHECK(labels(plan) == std::vector<std::string>{"one 1, factor 1", "one 1, factor 10",
                                                 "one 2, factor 1", "one 2, factor 10",
                                                 "one 3, factor 1", "one 3, factor 10"});
  CHECK(plan.nodes.size() == 16);
  CHECK(plan.rows[1].overrides ==
        std::vector<std::string>{"stages.one.with.value=1", "stages.sum.with.factor=10"});
  // Where a row stands does not change what it is.
  const Plan other = bench.plan(
      "  vary:\n    factor: {setting: stages.sum.with.factor, values: [10]}\n"
      "    one: {setting: stages.one.with.value, values: [1]}\n");
  CHECK(other.rows[0].id == plan.rows[1].id);
}

TEST_CASE("Ranges, zipped lists, tables and variants", "[study]") {
  const StudyBench bench;
  CHECK(labels(bench.plan("  vary: {f: {setting: stages.sum.with.factor, "
                          "range: {from: 0.1, to: 0.5, step: 0.1}}}\n")) ==
        std::vector<std::string>{"f 0.1", "f 0.2", "f 0.3", "f 0.4", "f 0.5"});
  CHECK(labels(bench.plan("  vary: {f: {setting: stages.sum.with.factor, "
                          "range: {from: 1, to: 100, count: 3, spacing: log}}}\n")) ==
        std::vector<std::string>{"f 1", "f 10", "f 100"});
  const Plan zipped = bench.plan(
      "  vary:\n    case:\n      zip: {stages.one.with.value: [1, 2], stages.two.with.value: [5, 6]}\n"
      "      labels: [low, high]\n");
  CHECK(labels(zipped) == std::vector<std::string>{"case low", "case high"});
  CHECK(zipped.rows[1].overrides ==
        std::vector<std::string>{"stages.one.with.value=2", "stages.two.with.value=6"});
  bench.scratch.write("cases.csv", "# our cases\nname, a, b\nsmall, 1, 2\nlarge, 10, 20\n");
  const std::string table =
      "  vary: {case: {table: cases.csv, columns: {a: stages.one.with.value, b: [stages.two.with.value]}";
  CHECK(labels(bench.plan(table + "}}\n")) == std::vector<std::string>{"case small", "case large"});
  const Plan one = bench.plan(table + ", rows: [large]}}\n");
  REQUIRE(one.rows.size() == 1);
  CHECK(one.rows[0].overrides ==
        std::vector<std::string>{"stages.one.with.value=10", "stages.two.with.value=20"});
  const Plan also = bench.plan(kValues + "  also:\n    plain: {set: {stages.one.with.value: 9}}\n");
  CHECK(also.rows.size() == 7);
  CHECK(also.rows[6].label() == "plain");
  CHECK(also.rows[6].variant == "plain");
}

TEST_CASE("Tables from spreadsheets of other countries are told what is wrong", "[study]") {
  using namespace std::string_literals;
  const StudyBench bench;
  const auto plan = [&](const std::string& csv) {
    bench.scratch.write("cases.csv", csv);
    return bench.plan(
        "  vary: {case: {table: cases.csv, columns: {name: stages.two.with.value, "
        "a: stages.one.with.value}}}\n");
  };
  CHECK(plan("\xEF\xBB\xBFname,a\r\n1,0.5\r\n").rows.size() == 1);
  CHECK(plan("# old Mac\rname,a\r1,0.5\r2,0.6\r").rows.size() == 2);
  CHECK_THROWS_WITH(plan("name,a\r\r1,2,3\r"), Contains("cases.csv:3: has 3 cells"));
  CHECK_THROWS_WITH(plan("name;a\n1;0,5\n"), Contains("It has semicolons"));
  CHECK_THROWS_WITH(plan("name,a\n1,\"0,5\"\n"), Contains("It has a decimal comma"));
  CHECK_THROWS_WITH(plan("name,a\n1,0.5\xC2\xA0\n"), Contains("non-breaking space"));
  CHECK_THROWS_WITH(plan("n\0a\0"s), Contains("UTF-16"));
  CHECK_THROWS_WITH(plan("name,a\n1,2,3\n"),
                    Contains("cases.csv:2: has 3 cells, and the header 2 (name, a). "));
  CHECK_THROWS_WITH(plan("name,a,a\n1,2,3\n"), Contains("several columns 'a'"));
  for (const std::string nothing : {"~", "null"})
    CHECK_THROWS_WITH(plan("name,a\n1," + nothing + "\n"),
                      Contains("cases.csv:2: row '1', column 'a' is empty"));
}

TEST_CASE("What is wrong in a table is told with its line and column", "[study]") {
  const StudyBench bench;
  const auto refused = [&](const std::string& csv) {
    bench.scratch.write("cases.csv", csv);
    try {
      (void)bench.plan(
          "  vary: {case: {table: cases.csv, columns: {a: stages.one.with.value, "
          "b: stages.two.with.value}}}\n");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(refused("name,a,b\nx,1,2\n").empty());  // control
  CHECK_THAT(refused("# ours\nname,a,b\n\nx,1\n"),
             Contains("study.yaml:5:") &&
                 Contains("cases.csv:4: has 2 cells, and the header 3 (name, a, b)"));
  CHECK_THAT(refused("name,a,b\nx,1,2\ny,1,2,3\n"),
             Contains("cases.csv:3: has 4 cells") && !Contains("decimal comma"));
  CHECK(refused("\"name\",\"a\",\"b\"\n\"x\",\"1\",\"2\"\n").empty());  // as from a spreadsheet
  CHECK_THAT(refused("name,a,b\nx,1,\n"), Contains("cases.csv:2: row 'x', column 'b' is empty"));
  CHECK_THAT(refused("name,a,b\nx,1,1 2\xC2\xA0\n"), Contains("cases.csv:2: column 'b': '1 2"));
  // What only the stage can refuse.
  CHECK_THAT(
      refused("name,a,b\n# none\nx,1,much\n"),
      Contains("study.yaml:5:") && Contains("cases.csv:3: column 'b': stages.two.with.value=much"));
}

TEST_CASE("A sample of more inputs than the sequence of Sobol has is refused", "[study]") {
  const StudyBench bench;
  const auto sample = [&](std::size_t inputs, const std::string& method) {
    std::string text = "  sample:\n    method: " + method + "\n    count: 2\n    inputs:\n";
    for (std::size_t i = 0; i < inputs; ++i)
      text += fmt::format(
          "      f{}: {{setting: stages.sum.with.x{}, uniform: {{from: 1, to: 2}}}}\n", i, i);
    return read_study(bench.scratch.write("study.yaml",
                                          "schema: 1\nname: demo\nstudy:\n"
                                          "  workflow: base.yaml\n" +
                                              text));
  };
  CHECK(sample(21, "sobol").parts[0].sample->inputs.size() == 21);
  CHECK_THROWS_WITH(sample(22, "sobol"),
                    Contains("study.yaml:6:") &&
                        Contains("takes 21 inputs at most, and there are 22") &&
                        Contains("latin_hypercube"));
  CHECK(sample(22, "latin_hypercube").parts[0].sample->inputs.size() == 22);
}

TEST_CASE("Sampled rows are the same for a seed", "[study]") {
  const StudyBench bench;
  const std::string sample =
      "  sample:\n    method: sobol\n    count: 8\n    seed: 5\n    inputs:\n"
      "      f: {setting: stages.sum.with.factor, uniform: {from: 1, to: 2}}\n"
      "      g: {setting: stages.one.with.value, normal: {mean: 100, deviation: 10, min: 0}}\n"
      "    correlations: [[f, g, 0.5]]\n";
  const Plan plan = bench.plan(sample);
  REQUIRE(plan.rows.size() == 8);
  CHECK(labels(plan) == labels(bench.plan(sample)));
  std::set<std::string> all;
  for (const std::string& l : labels(plan)) all.insert(l);
  CHECK(all.size() == 8);
  CHECK(plan.inputs[0].sampled);
  CHECK(plan.inputs[0].unit == "");
}

TEST_CASE("Repeats disturb what they say, by what they say", "[study]") {
  CHECK(change_of(0, 1e-6) == 0.0);
  CHECK(change_of(1, 1e-6) == 1e-6);
  CHECK(change_of(2, 1e-6) == -1e-6);
  CHECK(change_of(3, 1e-6) == 2e-6);
  CHECK(shift_of(0) == std::array{0.0, 0.0});
  for (std::size_t k = 1; k < 100; ++k)
    for (const double s : shift_of(k)) CHECK((s > 0.0 && s < 1.0));
  const StudyBench bench;
  const Plan plan = bench.plan(
      "  set: {stages.sum.with.factor: 2}\n"
      "  vary: {one: {setting: stages.one.with.value, values: [1, 2]}}\n"
      "  repeat: {count: 3, scale: {stages.sum.with.factor: 1e-6}, rows: {one: [2]}}\n");
  REQUIRE(plan.rows.size() == 4);
  CHECK(plan.rows[0].disturbed.empty());
  CHECK(plan.rows[1].disturbed.empty());
  CHECK(plan.rows[2].disturbed == Settings{{"stages.sum.with.factor", "2.000002"}});
  CHECK(plan.rows[3].disturbed == Settings{{"stages.sum.with.factor", "1.999998"}});
  CHECK(plan.rows[3].label() == "one 2, repeat 2");
  // The usual disturbances have nothing to act on here.
  const Plan none = bench.plan("  repeat: 2\n");
  CHECK_THAT(none.rows[1].problem,
             Contains("study.yaml:5:") && Contains("neither a motion nor a grid"));
}

TEST_CASE("A repeat that changes nothing is refused: its scatter would be zero", "[study]") {
  const StudyBench bench;
  // Below the digits of the number; below what the stage keeps of a number that is whole; zero.
  const Plan fine = bench.plan(
      "  set: {stages.sum.with.factor: 2}\n"
      "  repeat: {count: 2, scale: {stages.sum.with.factor: 1e-13}}\n");
  CHECK(fine.rows[1].problem.empty());
  const Plan lost = bench.plan(
      "  set: {stages.sum.with.factor: 2}\n"
      "  repeat: {count: 2, scale: {stages.sum.with.factor: 1e-17}}\n");
  CHECK(lost.rows[0].problem.empty());
  CHECK_THAT(lost.rows[1].problem, Contains("is the same number") && Contains("study.yaml:"));
  const Plan zero = bench.plan(
      "  set: {stages.sum.with.factor: 0}\n"
      "  repeat: {count: 2, scale: {stages.sum.with.factor: 1e-3}}\n");
  CHECK_THAT(zero.rows[1].problem, Contains("is the same number"));
  CHECK_THAT(refusal(bench, "  repeat: {count: 2, scale: {stages.sum.with.factor: 0}}\n"),
             Contains("is no step"));
}

TEST_CASE("Variants have names of their own", "[study]") {
  const StudyBench bench;
  CHECK_THAT(refusal(bench, "  also: {base: {}}\n"), Contains("two variants 'base'"));
  CHECK_THAT(refusal(bench, "  also: {\"a b\": {}}\n"),
             Contains("cannot be the name of a variant"));
  CHECK_THAT(refusal(bench, "  also: {\"a,b\": {}}\n"), Contains("study.yaml:5:"));
  CHECK_THAT(refusal(bench, "  vary: {cause: {setting: stages.one.with.value, values: [1]}}\n"),
             Contains("two columns 'cause'"));
}

TEST_CASE("Rows look once at what they share", "[study]") {
  StudyBench bench;
  const auto looks = std::make_shared<int>(0);
  for (StageType& type : bench.types)
    type.prepare = [looks, name = type.name, prepare = type.prepare](
                       const std::optional<YamlNode>& with, const YamlNode& stage) {
      PreparedStage prepared = prepare(with, stage);
      prepared.preview = [looks, name](const Previews& in, Findings& found) -> std::any {
        ++*looks;
        found.warnings.push_back(name);
        std::string all = name;
        for (const auto& [port, value] : in) all += "(" + std::any_cast<std::string>(value) + ")";
        return all;
      };
      return prepared;
    };
  const Plan plan = bench.plan(kValues);
  CHECK(plan.rows.size() == 6);
  // Three numbers, of which `two` is one; sums and counts.
  CHECK(*looks == 3 + 6 + 6);
  for (const Node& node : plan.nodes) {
    CHECK_FALSE(node.stage.preview.has_value());
    CHECK(node.stage.warnings == std::vector<std::string>{node.stage.type.name});
  }
}

TEST_CASE("A repeat scales the motion and moves the grid of map and flow alike", "[study]") {
  const Scratch scratch;
  scratch.write("w.yaml",
                "schema: 1\nname: w\nstages:\n"
                "  motion: {uses: motion.prepare, with: {preset: corinth, pga: 0.3 g}}\n"
                "  map: {uses: transfer.map, with: {cell: \"${stages.flow.with.cell}\"}}\n"
                "  flow: {uses: mpm.run, with: {cell: 2 m, grid_origin: [10 m, 0 m]}}\n");
  const Repeat repeat{
      .place = "s.yaml:1:1", .count = 3, .motion = 1e-6, .grid = true, .scale = {}, .rows = {}};
  const YamlNode workflow = load_yaml(scratch / "w.yaml");
  CHECK(perturbations(workflow, repeat, 0).empty());
  const Settings set = perturbations(workflow, repeat, 1);
  REQUIRE(set.size() == 3);
  CHECK(set[0] == std::pair<std::string, std::string>("stages.motion.with.pga", "0.3000003 g"));
  CHECK(set[1].first == "stages.map.with.grid_origin");
  CHECK(set[1].second == "[1.50975533249 m, 1.139680582 m]");
  CHECK(set[2].second == "[11.5097553325 m, 1.139680582 m]");
}

TEST_CASE("Mistakes in a study file are named with their place", "[study]") {
  const StudyBench bench;
  struct Case {
    std::string text;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases{
      {"  vry: {}\n", {"study.yaml:5:", "unknown key 'vry'", "Did you mean 'vary'?"}},
      {"  vary: {f: {setting: sum.factor, values: [1]}}\n", {"no path of a setting"}},
      {"  vary: {f: {setting: stages.sum.with.factor}}\n", {"either 'values' or 'range'"}},
      {"  vary: {f: {setting: stages.sum.with.factor, values: [1, 1]}}\n", {"stands there twice"}},
      {"  vary: {row: {setting: stages.sum.with.factor, values: [1]}}\n", {"two columns 'row'"}},
      {"  vary: {f: {setting: stages.sum.with.factor, range: {from: 1, to: 2, step: -1}}}\n",
       {"does not lead from 1 to 2"}},
      {"  vary: {f: {zip: {stages.one.with.value: [1, 2], stages.two.with.value: [1]}}}\n",
       {"zipped item by item"}},
      {"  sample: {count: 2, inputs: {f: {setting: stages.sum.with.factor}}}\n",
       {"0 distributions"}},
      {"  sample: {count: 2, inputs: {f: {setting: stages.sum.with.factor, "
       "normal: {mean: 1 m, deviation: 1 s}}}}\n",
       {"another unit"}},
      {"  sample: {count: 2, method: magic, inputs: {}}\n", {"no way of sampling"}},
      {"  repeat: {count: 2, motion: 0.1}\n", {"is no disturbance"}},
      {"  repeat: {count: 2, rows: {nobody: [1]}}\n", {"no variable 'nobody'"}},
      {"  keep: everything\n", {"nothing to keep"}},
      {"  disk: 2 m\n", {"no size"}},
      // Every row is wrong in the same way: told once, at its place in the study.
      {"  vary: {f: {setting: stages.sum.with.facto, values: [1, 2]}}\n",
       {"study.yaml:5:", "facto", "factor"}}};
  for (const Case& c : cases) {
    CAPTURE(c.text);
    const std::string message = refusal(bench, c.text);
    for (const std::string& part : c.parts) CHECK_THAT(message, Contains(part));
  }
  bench.scratch.write("w.yaml", std::string(kWorkflow));
  CHECK_THROWS_WITH(read_study(bench.scratch / "w.yaml"), Contains("is a workflow"));
}

TEST_CASE("A study whose table would not be what was computed is refused", "[study]") {
  const StudyBench bench;
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      // of two that set one setting the table would show the one that did not act
      {"  vary:\n    f: {setting: stages.sum.with.factor, values: [1, 2]}\n"
       "    g: {setting: stages.sum.with.factor, values: [3]}\n",
       {"study.yaml:7:", "'g' sets stages.sum.with.factor", "study.yaml:6:", "only one"}},
      {"  vary:\n    f: {setting: stages.sum.with.factor, values: [1, 2]}\n"
       "    g: {setting: stages.sum.with, values: [{factor: 3}]}\n",
       {"'g' sets stages.sum.with"}},
      {"  vary: {f: {setting: stages.sum.with.factor, values: [1, 2]}}\n"
       "  sample: {count: 2, inputs: {g: {setting: stages.sum.with.factor, uniform: {from: 1, to: "
       "2}}}}\n",
       {"'g' sets stages.sum.with.factor", "'f'"}},
      {"  set: {stages.sum.with.factor: 1, stages.sum.with: {factor: 2}}\n",
       {"all of stages.sum.with as well"}},
      {"  set: {stages.sum.with.factor: 1}\n"
       "  vary: {f: {setting: stages.sum.with, values: [{factor: 3}]}}\n",
       {"'f' replaces all of stages.sum.with"}},
      {"  vary: {f: {setting: stages.sum.with.factor, values: [0.3, 0.30]}}\n",
       {"'0.3' stands there twice, also as '0.30'"}},
      {"  vary: {f: {setting: stages.sum.with.factor, range: {from: 1, to: 2.5, step: 1}}}\n",
       {"and past 2.5"}},
      {"  sample: {count: 4, inputs: {a: {setting: stages.one.with.value, uniform: {from: 1, to: "
       "2}}, b: {setting: stages.two.with.value, uniform: {from: 1, to: 2}}}, correlations: [[a, "
       "b, 0.9], [b, a, -0.9]]}\n",
       {"correlated above"}},
      {"  repeat: {count: 10, motion: 5e-4}\n", {"0.0005 becomes 0.0025 in the last of 10"}}};
  for (const auto& [text, parts] : cases) {
    CAPTURE(text);
    const std::string message = refusal(bench, text);
    for (const std::string& part : parts) CHECK_THAT(message, Contains(part));
  }
  // `set` under `vary` is the value of rows that do not say it
  CHECK(refusal(bench,
                "  set: {stages.sum.with.factor: 1}\n"
                "  vary: {f: {setting: stages.sum.with.factor, values: [1, 2]}}\n")
            .empty());
}

TEST_CASE("What is asked of Slurm is read, and nothing that a script could take for a command",
          "[study]") {
  const StudyBench bench;
  const auto read = [&](const std::string& slurm) {
    return read_study(bench.scratch.write("study.yaml",
                                          "schema: 1\nname: demo\nstudy:\n"
                                          "  workflow: base.yaml\n  slurm: " +
                                              slurm + "\n"))
        .slurm;
  };
  const SlurmSettings all = read(
      "{partition: 'day,night', account: geo-2, cpus: 8, memory: 4 GB, time: 4 h, chunk: 1 h, "
      "options: [--qos=low, -v]}");
  CHECK(all.partition == "day,night");
  CHECK(all.account == "geo-2");
  CHECK(all.cpus == 8);
  CHECK(all.memory == 4e9);
  CHECK(all.time == 14400.0);
  CHECK(all.chunk == 3600.0);
  CHECK(all.options == std::vector<std::string>{"--qos=low", "-v"});
  CHECK(read("{}").chunk == 1800.0);
  CHECK_FALSE(is_set(read("{}").time));
  CHECK(read("{time: 20 min}").chunk == 600.0);  // a task must fit in its time

  const auto refused = [&](const std::string& slurm) {
    try {
      (void)read(slurm);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK_THAT(refused("{partition: \"day\\nrm -rf x\"}"), Contains("control character"));
  // sbatch takes the beginning of an option for the whole of it
  for (const std::string option : {"--tim=5", "--par=x", "--arr=0-5"})
    CHECK_THAT(refused("{options: [" + option + "]}"), Contains("study.yaml:5:"));
  CHECK_THAT(refused("{options: [--]}"), Contains("no option of sbatch"));
  CHECK_THAT(refused("{time: 1e30 h}"), Contains("more than a year"));
  CHECK_THAT(refused("{memory: 1 MB}"), Contains("no memory of a task"));
  CHECK_THAT(refused("{memory: 1e30 TB}"), Contains("no memory of a task"));
  CHECK_THAT(refused("{partition: $(x)}"),
             Contains("study.yaml:5:") && Contains("no name of Slurm"));
  CHECK_THAT(refused("{account: --wrap}"), Contains("no name of Slurm"));
  CHECK_THAT(refused("{time: 10 s}"), Contains("at least 1 min"));
  CHECK_THAT(refused("{time: 1 h, chunk: 45 min}"), Contains("more than half of 'time'"));
  CHECK_THAT(refused("{options: [qos]}"), Contains("no option of sbatch"));
  CHECK_THAT(refused("{options: [--qos low]}"), Contains("taken for one word"));
  CHECK_THAT(refused("{options: [--array=0-9]}"), Contains("set by the program"));
  CHECK_THAT(refused("{options: [-p night]}"), Contains("'partition: ...'"));
  CHECK_THAT(refused("{options: [\"--comment=a\\nb\"]}"), Contains("control character"));
  CHECK_THAT(refused("{queue: day}"), Contains("unknown key 'queue'"));
}
