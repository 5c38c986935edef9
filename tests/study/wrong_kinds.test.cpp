#include "tests/study/study_bench.hpp"

#include <regex>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;

namespace {

/// Every key of a study file, with '@' for its value.
const std::vector<std::string> kKeys{
    "schema: @\nname: n\nstudy: {workflow: base.yaml}\n",
    "schema: 1\nname: @\nstudy: {workflow: base.yaml}\n",
    "schema: 1\nname: n\ndescription: @\nstudy: {workflow: base.yaml}\n",
    "schema: 1\nname: n\nstudy: @\n",
    "schema: 1\nname: n\nstudy: {workflow: @}\n",
    "workflow: {a: @}",
    "set: @",
    "set: {stages.one.with.value: @}",
    "set: {stages.one.with: @}",
    "vary: @",
    "vary: {f: @}",
    "vary: {f: {setting: @, values: [1]}}",
    "vary: {f: {setting: [@], values: [1]}}",
    "vary: {f: {setting: stages.one.with.value, values: @}}",
    "vary: {f: {setting: stages.one.with.value, values: [@]}}",
    "vary: {f: {setting: stages.one.with.value, values: [1], labels: @}}",
    "vary: {f: {setting: stages.one.with.value, values: [1], labels: [@]}}",
    "vary: {f: {setting: stages.one.with.value, range: @}}",
    "vary: {f: {setting: stages.one.with.value, range: {from: @, to: 2, step: 1}}}",
    "vary: {f: {setting: stages.one.with.value, range: {from: 1, to: @, step: 1}}}",
    "vary: {f: {setting: stages.one.with.value, range: {from: 1, to: 2, step: @}}}",
    "vary: {f: {setting: stages.one.with.value, range: {from: 1, to: 2, count: @}}}",
    "vary: {f: {setting: stages.one.with.value, range: {from: 1, to: 2, count: 2, spacing: @}}}",
    "vary: {f: {zip: @}}",
    "vary: {f: {zip: {stages.one.with.value: @}}}",
    "vary: {f: {zip: {stages.one.with.value: [@]}}}",
    "vary: {f: {zip: {stages.one.with.value: [1]}, labels: @}}",
    "vary: {f: {table: @, columns: {a: stages.one.with.value}}}",
    "vary: {f: {table: cases.csv, columns: @}}",
    "vary: {f: {table: cases.csv, columns: {a: @}}}",
    "vary: {f: {table: cases.csv, columns: {a: stages.one.with.value}, rows: @}}",
    "sample: @",
    "sample: {count: @, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}}",
    "sample: {count: 2, method: @, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}}",
    "sample: {count: 2, seed: @, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}}",
    "sample: {count: 2, inputs: @}",
    "sample: {count: 2, inputs: {f: @}}",
    "sample: {count: 2, inputs: {f: {setting: @, uniform: {from: 1, to: 2}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, uniform: @}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, uniform: {from: @, to: 2}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, triangular: {from: 1, mode: @, to: 2}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, normal: @}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, normal: {mean: 5, deviation: @}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, normal: {mean: 5, deviation: 1, min: @}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, lognormal: {mean: @, deviation: 1}}}}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}, correlations: @}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}, correlations: [@]}",
    "sample: {count: 2, inputs: {f: {setting: stages.one.with.value, uniform: {from: 1, to: 2}}}, correlations: [[f, @, 0.5]]}",
    "repeat: @",
    "repeat: {count: @}",
    "repeat: {count: 2, motion: @}",
    "repeat: {count: 2, grid: @}",
    "repeat: {count: 2, scale: @}",
    "repeat: {count: 2, scale: {stages.one.with.value: @}}",
    "repeat: {count: 2, scale: {stages.one.with.value: 1e-3}, rows: @}",
    "also: @",
    "also: {b: @}",
    "also: {b: {workflow: @}}",
    "also: {b: {set: @}}",
    "also: {b: {vary: @}}",
    "also: {b: {sample: @}}",
    "also: {b: {repeat: @}}",
    "keep: @",
    "disk: @",
    "limits: @",
    "limits: {stage_time: @}",
    "slurm: @",
    "slurm: {partition: @}",
    "slurm: {account: @}",
    "slurm: {cpus: @}",
    "slurm: {memory: @}",
    "slurm: {time: @}",
    "slurm: {chunk: @}",
    "slurm: {options: @}",
    "slurm: {options: [@]}",
    "analysis: @",
    "analysis: {results: @}",
    "analysis: {results: [@]}",
    "analysis: {thresholds: @}",
    "analysis: {thresholds: [@]}",
    "analysis: {thresholds: [[@, b]]}",
    "analysis: {seed: @}"};

const std::vector<std::string> kNodes{"",
                                      "null",
                                      "{}",
                                      "[]",
                                      "\"\"",
                                      "word",
                                      "7",
                                      "-1",
                                      "0",
                                      "1e99",
                                      "nan",
                                      "[[]]",
                                      "[{}]",
                                      "[null]",
                                      "[1, [2]]",
                                      "{a: {}}",
                                      "{a: []}",
                                      "{a: }",
                                      "{a: 1}",
                                      "{\"\": 1}",
                                      "{stages.: 1}",
                                      "{stages.one: }",
                                      "${study}",
                                      "1 m"};

std::string whole(const std::string& key, const std::string& value) {
  std::string text = key.starts_with("schema") ? key
                     : key.starts_with("workflow")
                         ? "schema: 1\nname: n\nstudy:\n  " + key + "\n"
                         : "schema: 1\nname: n\nstudy:\n  workflow: base.yaml\n  " + key + "\n";
  return text.replace(text.find('@'), 1, value);
}

}  // namespace

TEST_CASE("A wrong kind of node at any key is an error with its line, or has a meaning",
          "[study]") {
  const StudyBench bench;
  bench.scratch.write("cases.csv", "name, a\nsmall, 1\nlarge, 2\n");
  const std::regex with_line("^[^\n]*(study|base)\\.yaml:[0-9]+:[0-9]+: ");
  std::size_t refused = 0;
  for (const std::string& key : kKeys)
    for (const std::string& value : kNodes) {
      const std::string text = whole(key, value);
      CAPTURE(text);
      try {
        const Plan plan =
            make_plan(read_study(bench.scratch.write("study.yaml", text)), bench.types);
        CHECK_FALSE(plan.rows.empty());
      } catch (const Error& e) {
        ++refused;
        CHECK(e.exit_code() != 3);
        const std::string message = e.what();
        CAPTURE(message);
        CHECK(std::regex_search(message, with_line));
      }
    }
  CHECK(refused > kKeys.size() * kNodes.size() / 2);
}

TEST_CASE("What would tell no rows apart, or fail only after a night, is refused", "[study]") {
  const StudyBench bench;
  const auto refusal = [&](const std::string& key, const std::string& value) {
    try {
      (void)make_plan(read_study(bench.scratch.write("study.yaml", whole(key, value))),
                      bench.types);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  using Catch::Contains;
  CHECK_THAT(refusal("vary: {f: {zip: @}}", "{}"), Contains("study.yaml:5:") && Contains("empty"));
  CHECK_THAT(refusal("workflow: @", "{}"), Contains("study.yaml:4:") && Contains("empty"));
  CHECK_THAT(refusal("sample: {count: 2, inputs: @}", "{}"), Contains("study.yaml:5:"));
  CHECK_THAT(refusal("workflow: @", "nowhere.yaml"), Contains("study.yaml:4:"));
  CHECK_THAT(refusal("analysis: {results: @}", "{}"), Contains("study.yaml:5:"));
  CHECK_THAT(refusal("analysis: {results: [@]}", "[]"), Contains("study.yaml:5:"));
}
