#include "config/manual.hpp"
#include "core/conventions.hpp"
#include "tests/config/sample.hpp"

#include <regex>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using sample::Settings;
using sample::YamlFile;

namespace {

/// A whole number without a default, and angles.
struct Numbered {
  int tag = 0;
  double phi = 33.0 * kPi / 180.0;
};

}  // namespace

template <>
struct flowslide::Schema<Numbered> {
  static constexpr std::string_view doc = "Something with a number.";
  static void describe(FieldVisitor& v, Numbered& c) {
    v.integer("tag", c.tag, {.min = 1}, "its number");
    v.quantity("phi", c.phi, Dim::angle, {.max = 0.5 * kPi, .above = 0.0}, "an angle");
  }
};

namespace {

std::string canonical(std::string_view text) {
  const YamlFile file(text);
  std::ofstream(file.folder() / "one.txt") << "abc";
  std::ofstream(file.folder() / "two.txt") << "abc";
  return canonical_text(read_settings<Settings>(load_yaml(file.path()), ""));
}

}  // namespace

TEST_CASE("canonical text lists every field in SI", "[config]") {
  CHECK(
      canonical("spacing: 50 cm\ntoe: [0 m, -0 m]\nmesh: one.txt\ntitle: \"a \\\"b\\\"\\nc = d\"\n"
                "strength: [[1 m, 50 %]]\ntop: {depth: 1 m}\nzones: {dam: {depth: 2 m}}\n") ==
      "spacing = 0.5 m\n"
      "slope = 0.1 rad\n"
      "method = lattice\n"
      "verbose = false\n"
      "title = \"a \\\"b\\\"\\x0ac = d\"\n"
      "mesh = sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\n"
      "toe = [0 m, 0 m]\n"
      "times = []\n"
      "ids = []\n"
      "names = []\n"
      "strength = [[1 m, 0.5]]\n"
      "base.depth = 1 m\n"
      "base.count = 3\n"
      "top = given\n"
      "top.depth = 1 m\n"
      "top.count = 3\n"
      "layers = list of 0\n"
      "zones = table of [\"dam\"]\n"
      "zones.\"dam\".depth = 2 m\n"
      "zones.\"dam\".count = 3\n");
}

TEST_CASE("equal settings have equal canonical text, different ones differ", "[config]") {
  const std::string text = canonical("spacing: 500 mm\nmesh: one.txt\nbase: {count: 3}\n");
  CHECK(canonical("base:\nmesh: two.txt\nmethod: lattice\nspacing: 0.5 m\n") == text);
  CHECK(canonical("spacing: 500 mm\n") != text);
  CHECK(canonical("spacing: 501 mm\nmesh: one.txt\n") != text);
  CHECK(canonical("spacing: 1 m\nnames: [\"a, b\"]\n") !=
        canonical("spacing: 1 m\nnames: [a, b]\n"));
}

TEST_CASE("canonical text of a missing file names the setting", "[config]") {
  Settings settings{.spacing = 1.0};
  settings.mesh = InputFile{"no-such-file.txt"};
  CHECK_THROWS_AS(canonical_text(settings), FileError);
  CHECK_THROWS_WITH(canonical_text(settings), Catch::StartsWith("mesh: "));
}

TEST_CASE("the manual page has one row per key", "[config]") {
  CHECK(manual_page<sample::Layer>("Layer") ==
        "# Layer\n\nA layer.\n\n"
        "| Key | Kind and units | Default | Allowed | Meaning |\n"
        "|---|---|---|---|---|\n"
        "| `depth` | length (m, mm, cm, km) | required | at least 0 m | depth of the layer |\n"
        "| `ratio` | number | optional | above 0 and at most 1 | a share |\n"
        "| `count` | whole number | `3` | at least 1 and at most 9 | number of points |\n");
  const std::string page = manual_page<Settings>("Settings");
  for (const std::string row :
       {"| `method` | choice | `lattice` | `lattice`, `gauss` | how points are placed |\n",
        "| `toe` | list of 2: length (m, mm, cm, km) | `[0 m, 0 m]` |  | toe of the dam |\n",
        "| `strength` | list of rows [depth: length (m, mm, cm, km); ratio: number] | `[]` |  | "
        "strength by depth |\n",
        "| `base.depth` | length (m, mm, cm, km) | `1 m` | at least 0 m | depth of the layer |\n",
        "| `top` | group | optional |  | uppermost layer |\n",
        "| `layers[].count` | whole number |", "| `zones.<name>.ratio` | number |"})
    CHECK_THAT(page, Catch::Contains(row));
}

TEST_CASE("a whole number whose default is out of range must be given", "[config]") {
  CHECK_THAT(
      sample::problem_of("phi: 30 deg\n",
                         [](const auto& path) { read_settings<Numbered>(load_yaml(path), ""); }),
      Catch::Contains("'tag' is missing (its number) add 'tag: 1'"));
  const YamlFile file("tag: 7\n");
  CHECK(read_settings<Numbered>(load_yaml(file.path()), "").tag == 7);
  const auto schema = nlohmann::json::parse(json_schema<Numbered>());
  CHECK(schema["required"] == nlohmann::json{"tag"});
  CHECK_FALSE(schema["properties"]["tag"].contains("default"));
  const std::string page = manual_page<Numbered>("x");
  CHECK_THAT(page, Catch::Contains("| `tag` | whole number | required | at least 1 |"));
  CHECK_THAT(page, Catch::Contains("`33 deg` | above 0 deg and at most 90 deg |"));
  CHECK_THAT(schema["properties"]["phi"]["default"].get<std::string>(), Catch::Equals("33 deg"));
}

TEST_CASE("the JSON Schema demands units and refuses unknown keys", "[config]") {
  const auto schema = nlohmann::json::parse(json_schema<Settings>());
  CHECK(schema["additionalProperties"] == false);
  CHECK(schema["required"] == nlohmann::json{"spacing"});
  const auto& properties = schema["properties"];
  const std::regex length(properties["spacing"]["pattern"].get<std::string>());
  for (const std::string good : {"0.5 m", "50cm", "-1e-3 km", ".5 mm", "${stages.flow.with.cell}"})
    CHECK(std::regex_match(good, length));
  for (const std::string bad : {"0.5", "0.5 kPa", "m", "x ${a}", "0.5 m ${a}", "1_0 m"})
    CHECK_FALSE(std::regex_match(bad, length));
  CHECK(properties["slope"]["default"] == "5.72957795131 deg");
  CHECK(properties["method"]["anyOf"][0]["enum"] == nlohmann::json{"lattice", "gauss"});
  CHECK(properties["toe"]["minItems"] == 2);
  CHECK_FALSE(properties["base"].contains("default"));
  CHECK(properties["layers"]["items"]["required"] == nlohmann::json{"depth"});
  CHECK(properties["layers"]["description"] == "layers between");
  CHECK(properties["zones"]["additionalProperties"]["additionalProperties"] == false);
  const auto& ratio = properties["top"]["properties"]["ratio"]["anyOf"][0];
  CHECK(ratio["exclusiveMinimum"] == 0.0);
  CHECK(ratio["maximum"] == 1.0);
  CHECK(properties["strength"]["items"]["prefixItems"].size() == 2);
}
