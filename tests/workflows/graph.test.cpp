#include "workflows/engine/graph.hpp"

#include "core/check.hpp"
#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

Workflow load(const Scratch& scratch, const std::string& stages,
              const std::vector<std::string>& overrides = {}) {
  const auto file = scratch.write("case.yaml", "schema: 1\nname: demo\nstages:\n" + stages);
  const auto types = sample::stages();
  return load_workflow(file, overrides, types);
}

std::string problem(const std::string& stages) {
  const Scratch scratch;
  try {
    (void)load(scratch, stages);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const std::string kNumber = "  one: {uses: sample.number, with: {value: 1}}\n";

}  // namespace

TEST_CASE("stages run after what feeds them, otherwise as written", "[workflows]") {
  const Scratch scratch;
  const Workflow w = load(scratch,
                          "  last: {uses: sample.sum, in: {a: first.sum, b: one.number}}\n"
                          "  first: {uses: sample.sum, in: {a: two.number, b: one.number}}\n"
                          "  two: {uses: sample.number, with: {value: 2}}\n" +
                              kNumber);
  REQUIRE(w.stages.size() == 4);
  CHECK(w.stages[0].name == "two");
  CHECK(w.stages[1].name == "one");
  CHECK(w.stages[2].name == "first");
  CHECK(w.stages[3].name == "last");
  REQUIRE(w.stages[3].inputs.size() == 2);
  CHECK(w.stages[3].inputs[0].from_stage == 2);
  CHECK(w.stages[3].inputs[0].from_port == "sum");
  CHECK(w.stages[3].inputs[1].from_stage == 1);
}

TEST_CASE("settings can be overridden from outside", "[workflows]") {
  const Scratch scratch;
  const Workflow w = load(scratch, kNumber, {"stages.one.with.value=7"});
  CHECK_THAT(w.stages[0].prepared.settings, Contains("value = 7"));
}

TEST_CASE("overrides that leave out a part of the path are told the whole", "[workflows]") {
  const Scratch scratch;
  const auto meant = [&](const std::string& option) {
    try {
      (void)load(scratch, kNumber, {option});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  for (const char* option : {"one.value=2", "one.with.value=2", "stages.one.value=2"})
    CHECK_THAT(meant(option), Contains("Did you mean 'stages.one.with.value'?"));
  CHECK_THAT(meant("one.list.value=2"), Contains("Did you mean 'stages.one.with.list.value'?"));
  CHECK_THAT(meant("onne.value=2"), Contains("'stages.one.with.value'"));
  CHECK_THAT(meant("nothing.value=2"), Contains("Known: schema"));
  CHECK_THAT(meant("stages.one.usse=2"), Contains("Did you mean 'uses'?"));
  CHECK(meant("stages.one.with.value=2") == "no error");
}

TEST_CASE("wrong graphs are refused with place, reason and suggestion", "[workflows]") {
  SECTION("unknown stage type") {
    const std::string text = problem("  one: {uses: sample.numbr}\n");
    CHECK_THAT(text, Contains("case.yaml:4:") && Contains("there is no stage 'sample.numbr'") &&
                         Contains("Did you mean 'sample.number'?"));
  }
  SECTION("unknown input") {
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: one.number, c: one.number}}\n"),
               Contains("case.yaml:5:") && Contains("unknown key 'c'"));
  }
  SECTION("unknown source stage and port") {
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: on.number, b: one.number}}\n"),
               Contains("no stage named 'on'") && Contains("Did you mean 'one'?"));
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: one.numbers, b: one.number}}\n"),
               Contains("has no output 'numbers'") && Contains("Did you mean 'number'?"));
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: one, b: one.number}}\n"),
               Contains("names no output port"));
  }
  SECTION("kinds do not match") {
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: one.number, b: one.number}}\n"
                                 "  t: {uses: sample.count, in: {start: s.folder}}\n"),
               Contains("'s.folder' is of kind text") && Contains("takes number"));
  }
  SECTION("an input is not connected") {
    CHECK_THAT(problem(kNumber + "  s: {uses: sample.sum, in: {a: one.number}}\n"),
               Contains("input 'b' of stage 's' is not connected") &&
                   Contains("Write 'in: {b: one.number}'"));
  }
  SECTION("cycle") {
    CHECK_THAT(problem(kNumber + "  p: {uses: sample.sum, in: {a: one.number, b: q.sum}}\n"
                                 "  q: {uses: sample.sum, in: {a: one.number, b: p.sum}}\n"),
               Contains("case.yaml:") && Contains("cycle: p -> q -> p"));
    CHECK_THAT(problem(kNumber + "  p: {uses: sample.sum, in: {a: one.number, b: p.sum}}\n"),
               Contains("cycle: p -> p"));
  }
  SECTION("unknown keys") {
    CHECK_THAT(problem("  one: {uses: sample.number, wiht: {value: 1}}\n"),
               Contains("unknown key 'wiht'") && Contains("Did you mean 'with'?"));
    CHECK_THAT(problem("  one: {uses: sample.number, with: {valu: 1}}\n"), Contains("valu"));
  }
  SECTION("settings beside `with`") {
    CHECK_THAT(problem("  one: {uses: sample.number, value: 1}\n"),
               Contains("unknown key 'value'") && Contains("mean 'stages.one.with.value'?"));
  }
  SECTION("a relation between settings") {
    CHECK_THAT(problem("  one: {uses: sample.number, with: {value: 13}}\n"),
               Contains("case.yaml:4:") && Contains("value 13 is refused"));
  }
  SECTION("names that are no folder names") {
    CHECK_THAT(problem("  ../up: {uses: sample.number, with: {value: 1}}\n"),
               Contains("'../up' cannot be a stage's name"));
  }
  SECTION("no stages") { CHECK_THAT(problem("  {}\n"), Contains("no 'stages'")); }
}

TEST_CASE("all problems of a file are told at once", "[workflows]") {
  const std::string text = problem(
      "  one: {uses: sample.number, with: {valu: 1}}\n"
      "  two: {uses: sample.nothing}\n"
      "  s: {uses: sample.sum, in: {a: none.number, b: one.number}}\n");
  CHECK_THAT(text,
             Contains("case.yaml:4:") && Contains("case.yaml:5:") && Contains("case.yaml:6:"));
}

TEST_CASE("a missing file is a file error, unless there is wrong input as well", "[workflows]") {
  const Scratch scratch;
  const std::string missing = "  one: {uses: sample.number, with: {value: 1, note: none.txt}}\n";
  CHECK_THROWS_AS(load(scratch, missing), FileError);
  CHECK_THROWS_WITH(load(scratch, missing), Contains("none.txt"));
  CHECK_THROWS_AS(load(scratch, missing + "  two: {uses: sample.nothing}\n"), InputError);
}

TEST_CASE("the head of a workflow file is checked", "[workflows]") {
  const Scratch scratch;
  const auto types = sample::stages();
  const auto head = [&](const std::string& text) {
    return load_workflow(scratch.write("w.yaml", text + "stages:\n" + kNumber), {}, types);
  };
  CHECK_THROWS_WITH(head("name: a\n"), Contains("no 'schema'"));
  CHECK_THROWS_WITH(head("schema: 2\nname: a\n"), Contains("schema 2 is not known"));
  CHECK_THROWS_WITH(head("schema: 1\n"), Contains("no 'name'"));
  CHECK_THROWS_WITH(head("schema: 1\nname: a/b\n"), Contains("cannot be a name"));
  CHECK_THROWS_WITH(head("schema: 1\nname: a\nstage: 3\n"), Contains("unknown key 'stage'"));
  const auto study = scratch.write("s.yaml", "schema: 1\nname: a\nstudy: {workflow: w.yaml}\n");
  CHECK_THROWS_WITH(load_workflow(study, {}, types),
                    Contains("is a study") && Contains("'flowslide study run'"));
}
