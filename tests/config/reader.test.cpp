#include "tests/config/sample.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using sample::Settings;
using sample::YamlFile;

namespace {

std::string read_problem(std::string_view text) {
  return sample::problem_of(text,
                            [](const auto& path) { read_settings<Settings>(load_yaml(path), ""); });
}

/// The problem of one field beside a valid one.
std::string field_problem(const std::string& line) {
  return read_problem("spacing: 1 m\n" + line + "\n");
}

}  // namespace

TEST_CASE("every kind of field is read", "[config]") {
  const YamlFile file(
      "spacing: 50 cm\nslope: 45 deg\nmethod: gauss\nverbose: true\ntitle: a b\nmesh: "
      "sub/../m.txt\n"
      "toe: [1 m, 2 cm]\ntimes: [1 s, 1 min]\nids: [1, -2]\nnames: [a, yes]\n"
      "strength: [[1 m, 0.5], [2 m, 50 %]]\nbase: {count: 4}\ntop: {depth: 1 m, ratio: 1}\n"
      "layers:\n  - depth: 1 m\n  - {depth: 2 m, count: 9}\n"
      "zones:\n  tailings: {depth: 3 m}\n  dam: {depth: 4 m}\n");
  const auto s = read_settings<Settings>(load_yaml(file.path()), "");
  CHECK(s.spacing == 0.5);
  CHECK(s.slope == Approx(0.7853981633974483));
  CHECK(s.method == sample::Method::gauss);
  CHECK(s.verbose);
  CHECK(s.title == "a b");
  CHECK(s.mesh->path == file.folder() / "m.txt");
  CHECK(s.toe == std::array{1.0, 0.02});
  CHECK(s.times == std::vector{1.0, 60.0});
  CHECK(s.ids == std::vector{1, -2});
  CHECK(s.names == std::vector<std::string>{"a", "yes"});
  CHECK(s.strength == std::vector<std::vector<double>>{{1.0, 0.5}, {2.0, 0.5}});
  CHECK(s.base.depth == 1.0);  // a default of the outer settings stays
  CHECK(s.base.count == 4);
  CHECK(s.top->ratio == 1.0);
  REQUIRE(s.layers.size() == 2);
  CHECK(s.layers[1].count == 9);
  CHECK(s.zones.at("dam").depth == 4.0);
}

TEST_CASE("what is left out keeps its default", "[config]") {
  const YamlFile file("spacing: 1 m\nbase:\nlayers:\nzones: {}\n");
  const auto s = read_settings<Settings>(load_yaml(file.path()), "");
  CHECK(s.method == sample::Method::lattice);
  CHECK_FALSE(s.mesh.has_value());
  CHECK_FALSE(s.top.has_value());
  CHECK(s.base.count == 3);
  CHECK(s.layers.empty());
  CHECK_THROWS_WITH(
      read_settings<Settings>(std::nullopt, "stages.map.with"),
      "stages.map.with: 'spacing' is missing (distance of points) add 'spacing: 1 m'");
}

TEST_CASE("a list in the file replaces the default list", "[config]") {
  struct Outer {
    std::vector<sample::Layer> layers{{.depth = 7.0, .count = 5}, {.depth = 8.0}};
  };
  const YamlFile file("layers: [{depth: 1 m}]\n");
  const YamlNode root = load_yaml(file.path());
  Outer given;
  detail::read_fields(root, "", [&](FieldVisitor& v) { v.list("layers", given.layers, "layers"); });
  REQUIRE(given.layers.size() == 1);
  CHECK(given.layers[0].count == 3);
  Outer absent;
  detail::read_fields({}, "", [&](FieldVisitor& v) { v.list("layers", absent.layers, "layers"); });
  CHECK(absent.layers.size() == 2);
}

TEST_CASE("wrong keys are named with the nearest known one", "[config]") {
  CHECK(field_problem("top: {dept: 1 m, depth: 1 m}") ==
        "case.yaml:2:7: unknown key 'dept' in top (typing error?) did you mean 'depth'? known "
        "keys: depth, ratio, count");
  CHECK(field_problem("zones: {dam: {depth: 1 m, phi: 3}}") ==
        "case.yaml:2:27: unknown key 'phi' in zones.dam (typing error?) known keys: depth, ratio, "
        "count");
  CHECK(field_problem("top: {ratio: 0.5}") ==
        "case.yaml:2:1: top: 'depth' is missing (depth of the layer) add 'depth: 1 m'");
}

TEST_CASE("keys of older versions are refused with their new spelling", "[config]") {
  const auto problem = [](std::string_view text) {
    return sample::problem_of(text, [](const auto& path) {
      double width = kUnset;
      sample::Layer box;
      detail::read_fields(load_yaml(path), "", [&](FieldVisitor& v) {
        v.moved("breadth", "(no synonyms) write 'width: 2 m'");
        v.quantity("width", width, Dim::length, {}, "width");
        v.moved("box", "(sides have names) write 'box: {depth: 1 m}'", FieldVisitor::Moved::list);
        v.group("box", box, "box");
        v.passed_over("strength");
      });
    });
  };
  CHECK(problem("breadth: 2 m\nwidth: 2 m\nbox: {depth: 1 m}\n") ==
        "case.yaml:1:1: the file: 'breadth' is written as in an older version (no synonyms) write "
        "'width: 2 m'");
  CHECK(problem("width: 2 m\nbox: [1 m]\n") ==
        "case.yaml:2:1: the file: 'box' is written as in an older version (sides have names) write "
        "'box: {depth: 1 m}'");
  CHECK(problem("width: 2 m\nbox: {depth: 1 m}\nstrength: {any: thing}\n").empty());
  CHECK(problem("width: 2 m\nbox: {depth: 1 m}\nother: 1\n").find("unknown key") !=
        std::string::npos);
}

TEST_CASE("wrong values are named with place, path and what is expected", "[config]") {
  CHECK(read_problem("spacing: 0.5\n") ==
        "case.yaml:1:10: spacing: '0.5' has no unit (length expected, e.g. '0.5 m')");
  CHECK(read_problem("spacing: 11 m\n") ==
        "case.yaml:1:10: spacing: '11 m' is out of range (allowed: above 0 m and at most 10 m)");
  CHECK(
      read_problem("spacing: 0 cm\n") ==
      "case.yaml:1:10: spacing: '0 cm' is out of range (allowed: above 0 cm and at most 1000 cm)");
  CHECK(
      field_problem("slope: 90 deg") ==
      "case.yaml:2:8: slope: '90 deg' is out of range (allowed: at least 0 deg and below 90 deg)");
  CHECK(field_problem("method: gaus") ==
        "case.yaml:2:9: method: 'gaus' is not a choice here (one of: lattice, gauss) did you mean "
        "'gauss'?");
  CHECK(field_problem("verbose: yes") ==
        "case.yaml:2:10: verbose: 'yes' is neither true nor false (yes, no, on, off are not read: "
        "YAML versions differ on them) write true or false");
  CHECK(field_problem("title:") ==
        "case.yaml:2:1: title: has no value (nothing stands after ':') give one or remove the key");
  CHECK(field_problem("mesh: \"\"").find("mesh: is an empty file name") != std::string::npos);
  CHECK(field_problem("toe: [1 m]") ==
        "case.yaml:2:6: toe: has 1 values (2 are expected, e.g. [1 m, 1 m])");
  CHECK(field_problem("toe: 1 m") ==
        "case.yaml:2:6: toe: is a single value (a list is expected) write '[a, b]' or '- a' lines");
  CHECK(field_problem("strength: [[1 m]]") ==
        "case.yaml:2:12: strength.0: has 1 values (2 are expected: depth [m], ratio)");
  CHECK(field_problem("layers: {depth: 1 m}") ==
        "case.yaml:2:9: layers: is a map (a list is expected) write '[a, b]' or '- a' lines");
  CHECK(field_problem("zones: [1]") ==
        "case.yaml:2:8: zones: is a list (a map is expected) write 'key: value' lines");
  CHECK(field_problem("top:") ==
        "case.yaml:2:1: top: has no value (is it wanted or not?) remove the key, or write '{}' for "
        "its defaults");
  CHECK(read_problem("spacing: 1\xC2\xA0m\n").find("a non-breaking space") != std::string::npos);
}

TEST_CASE("numbers that YAML readers disagree on are refused", "[config]") {
  const auto ratio = [](const std::string& text) {
    return field_problem("top: {depth: 1 m, ratio: " + text + "}");
  };
  CHECK(ratio("1_000") ==
        "case.yaml:2:26: top.ratio: '1_000' has '_' between digits (only some YAML readers allow "
        "it) remove it");
  CHECK(ratio("0x1") ==
        "case.yaml:2:26: top.ratio: '0x1' is a hexadecimal, octal or binary number "
        "(only decimal ones are read)");
  CHECK(ratio(".inf") == "case.yaml:2:26: top.ratio: '.inf' is not a number");
  CHECK(ratio("nan") == "case.yaml:2:26: top.ratio: 'nan' is not a finite number");
  CHECK(ratio("\"0,5\"").find("has ',' in a number") != std::string::npos);
  CHECK(ratio("2") ==
        "case.yaml:2:26: top.ratio: '2' is out of range (allowed: above 0 and at most 1)");
  const auto count = [](const std::string& text) {
    return field_problem("base: {count: " + text + "}");
  };
  CHECK(count("010") ==
        "case.yaml:2:15: base.count: '010' starts with 0 (some YAML readers take that for an octal "
        "number) write it without");
  for (const std::string text : {"1.0", "1e1", "0o7", "+1", "five", "-"})
    CHECK(count(text).find("is not a whole number") != std::string::npos);
  CHECK(count("99999999999").find("is too large") != std::string::npos);
  CHECK(count("10") ==
        "case.yaml:2:15: base.count: '10' is out of range (allowed: at least 1 and at most 9)");
  CHECK(count("7").empty());
}

TEST_CASE("all problems of a file are reported in its order, up to a limit", "[config]") {
  CHECK(read_problem("spacng: 1 m\nslope: 3\nids: [1.5, 2, x]\n") ==
        "case.yaml:1:1: 'spacing' is missing (distance of points) add 'spacing: 1 m'\n"
        "case.yaml:1:1: unknown key 'spacng' in the file (typing error?) did you mean 'spacing'? "
        "known keys: spacing, slope, method, verbose, title, mesh, toe, times, ids, names, "
        "strength, base, top, layers, zones\n"
        "case.yaml:2:8: slope: '3' has no unit (angle expected, e.g. '3 rad')\n"
        "case.yaml:3:7: ids.0: '1.5' is not a whole number (only digits are read) write e.g. '10'\n"
        "case.yaml:3:15: ids.2: 'x' is not a whole number (only digits are read) write e.g. '10'");
  std::string many = "ids: [x";
  for (int i = 1; i < 5000; ++i) many += ", x";
  const std::string problem = field_problem(many + "]");
  CHECK(std::count(problem.begin(), problem.end(), '\n') == 20);
  CHECK(problem.ends_with("\nand 4980 more problems"));
}
