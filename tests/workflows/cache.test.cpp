#include "workflows/engine/cache.hpp"

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
  CHECK(content_hash(one / "f") == content_hash(two / "f"));
  two.write("f/a", "2");
  CHECK(content_hash(one / "f") != content_hash(two / "f"));
  CHECK(content_hash(one / "f/a") == sha256("1"));
}

TEST_CASE("records survive the disk", "[workflows]") {
  const Scratch scratch;
  const StageRecord record{.stage = "map",
                           .uses = "transfer.map",
                           .version = 3,
                           .key = std::string(64, 'a'),
                           .settings = "a = 1\nb = \"x = y\"\n",
                           .inputs = {{"history", "11"}},
                           .outputs = {{"particles", "p.h5", "22", 7, 1234567890123456789}},
                           .publish = {"flow.pvd"},
                           .facts = R"({"x":0.1,"list":[1,2]})",
                           .program = "flowslide",
                           .seconds = 0.1};
  write_record(scratch.path(), record);
  const auto back = read_record(scratch.path());
  REQUIRE(back);
  CHECK(back->settings == record.settings);
  CHECK(back->inputs == record.inputs);
  REQUIRE(back->outputs.size() == 1);
  CHECK(back->outputs[0].modified == record.outputs[0].modified);
  CHECK(back->facts == record.facts);
  CHECK(back->seconds == record.seconds);

  scratch.write("stage.json", "{\"schema\": 1, \"stage\": 3}");
  CHECK_FALSE(read_record(scratch.path()));
  scratch.write("stage.json", "{\"schema\": 1,");
  CHECK_FALSE(read_record(scratch.path()));
}
