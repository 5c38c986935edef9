#include "workflows/engine/cache.hpp"

#include "core/check.hpp"
#include "core/hash.hpp"
#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("a key depends on type, version, settings and inputs only", "[workflows]") {
  StageType type = stage_type<sample::SumStage>();
  const std::string key = stage_key(type, "factor = 1\n", {{"a", "11"}, {"b", "22"}});
  CHECK(key.size() == 64);
  CHECK(stage_key(type, "factor = 2\n", {{"a", "11"}, {"b", "22"}}) != key);
  CHECK(stage_key(type, "factor = 1\n", {{"a", "22"}, {"b", "11"}}) != key);
  type.version = 2;
  CHECK(stage_key(type, "factor = 1\n", {{"a", "11"}, {"b", "22"}}) != key);
  type.version = 1;
  CHECK(stage_key(type, "factor = 1\n", {{"a", "11"}, {"b", "22"}}) == key);
}

TEST_CASE("changes of settings are told by name", "[workflows]") {
  CHECK(describe_changes("c_soft_ratio = 1\ncell = 2 m\n", "c_soft_ratio = 0.5\ncell = 2 m\n") ==
        "c_soft_ratio 1 -> 0.5");
  CHECK(describe_changes("a = 1\n", "a = 1\nb = 2\n") == "b = 2 is new");
  CHECK(describe_changes("a = 1\nb = 2\n", "a = 1\n") == "b is gone");
  CHECK(describe_changes("f = sha256:11\n", "f = sha256:22\n") == "content of f");
  CHECK(describe_changes("a = 1\nb = 1\nc = 1\nd = 1\ne = 1\n",
                         "a = 2\nb = 2\nc = 2\nd = 2\ne = 2\n") ==
        "a 1 -> 2, b 1 -> 2, c 1 -> 2, and 2 more");
}

TEST_CASE("the hash of a folder sees names and contents", "[workflows]") {
  const Scratch one, two;
  one.write("f/a", "1");
  one.write("f/deep/b", "2");
  two.write("f/deep/b", "2");
  two.write("f/a", "1");
  const auto hash = [](const Scratch& s, const char* name) {
    return content_hash(list_files(s.path()), name);
  };
  CHECK(hash(one, "f") == hash(two, "f"));
  two.write("f/a", "2");
  CHECK(hash(one, "f") != hash(two, "f"));
  CHECK(hash(one, "f/a") == sha256("1"));
}

TEST_CASE("a result holds files and folders only", "[workflows]") {
  const Scratch scratch;
  scratch.write("a", "1");
  std::filesystem::create_symlink("a", scratch / "link");
  CHECK_THROWS_AS(list_files(scratch.path()), FileError);
}

namespace {

StageRecord sample_record() {
  return {.stage = "map",
          .uses = "transfer.map",
          .version = 3,
          .key = std::string(64, 'a'),
          .settings = "a = 1\nb = \"x = y\"\n",
          .inputs = {{"history", "11"}},
          .outputs = {{"particles", "p.h5", sha256("p")}},
          .files = {{"p.h5", 1, sha256("p")}},
          .publish = {"flow.pvd"},
          .give = {"plot/plot.py"},
          .facts = R"({"x":0.1,"list":[1,2]})",
          .program = "flowslide",
          .seconds = 0.1};
}

}  // namespace

TEST_CASE("records survive the disk", "[workflows]") {
  const Scratch scratch;
  scratch.write("p.h5", "p");
  StageRecord record = sample_record();
  write_record(scratch.path(), record);
  const auto [back, problem] = read_stage_record(scratch.path());
  REQUIRE(back);
  CHECK(problem.empty());
  CHECK(back->settings == record.settings);
  CHECK(back->inputs == record.inputs);
  REQUIRE(back->outputs.size() == 1);
  CHECK(back->outputs[0].sha256 == record.outputs[0].sha256);
  REQUIRE(back->files.size() == 2);
  CHECK(back->files[0].name == "facts.json");
  CHECK(back->publish == record.publish);
  CHECK(back->give == record.give);
  CHECK(back->facts == record.facts);
  CHECK(back->seconds == record.seconds);
  CHECK(verify(*back, scratch.path()).problems.empty());
  CHECK(verify(*back, scratch.path()).files.size() == 2);
}

TEST_CASE("every bit of a record counts", "[workflows]") {
  const Scratch scratch;
  StageRecord record = sample_record();
  write_record(scratch.path(), record);
  for (const char* name : {"stage.json", "facts.json"}) {
    const std::string whole = read_text_file(scratch / name);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::string text = whole;
      text[i] = static_cast<char>(text[i] ^ 1);
      scratch.write(name, text);
      const RecordRead read = read_stage_record(scratch.path());
      REQUIRE_FALSE(read.record);
      REQUIRE_THAT(read.problem, Catch::Contains(name));
    }
    for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
      scratch.write(name, whole.substr(0, size));
      CHECK_FALSE(read_stage_record(scratch.path()).record);
    }
    scratch.write(name, whole);
  }
  CHECK(read_stage_record(scratch.path()).record);
}

TEST_CASE("records of other programs are refused with the reason", "[workflows]") {
  const Scratch scratch;
  CHECK(read_stage_record(scratch / "none").problem.empty());
  CHECK_THAT(read_stage_record(scratch.path()).problem, Catch::Contains("missing"));
  scratch.write("stage.json", "{\n  \"schema\": 1\n}\n");
  CHECK_THAT(read_stage_record(scratch.path()).problem, Catch::Contains("earlier program"));
  scratch.write("stage.json", seal({{"schema", 2}, {"stage", 3}}));
  CHECK_THAT(read_stage_record(scratch.path()).problem, Catch::Contains("cannot be used"));
}

TEST_CASE("nested text is refused before anything calls itself at every level", "[workflows]") {
  const std::string deep(100'000, '[');
  CHECK_FALSE(parse_object("{\"a\": " + deep + std::string(100'000, ']') + "}"));
  CHECK(parse_object("{\"a\": \"" + deep + "\"}"));
  CHECK(parse_object(R"({"a": [[1], {"b": "\"[["}]})"));
}
