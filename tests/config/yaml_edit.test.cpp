#include "tests/config/sample.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace flowslide;
using sample::load_problem;
using sample::YamlFile;

namespace {
constexpr std::string_view kText = "a: {b: 1 m}\nlist: [{x: 1}, 2]\nnone:\n";
}

TEST_CASE("An override of --set replaces, creates and removes values", "[config]") {
  const YamlFile file(kText);
  const std::vector<std::string> options = {"a.c.d=5 m",   "list.0.x=[1, 2]", "list.1=7", "n=x=y",
                                            "none.deep=1", "a.b=null",        "gone.x=~"};
  const YamlNode root = load_yaml(file.path(), options);
  CHECK(root.find("a")->find("c")->find("d")->scalar() == "5 m");
  CHECK(root.find("a")->find("c")->find("d")->where().text() == "--set a.c.d=5 m");
  CHECK(root.find("a")->find("c")->find("d")->path() == "a.c.d");
  CHECK(root.find("list")->item(0).find("x")->size() == 2);
  CHECK(root.find("list")->item(1).scalar() == "7");
  CHECK(root.find("n")->scalar() == "x=y");
  CHECK(root.find("none")->find("deep")->scalar() == "1");
  CHECK_FALSE(root.find("a")->find("b").has_value());
  CHECK_FALSE(root.find("gone").has_value());
  CHECK(root.size() == 4);
}

TEST_CASE("a --set option that fits nowhere is refused", "[config]") {
  const auto problem = [](const std::string& option) { return load_problem(kText, {option}); };
  CHECK(problem("a.b.c=1") ==
        "--set a.b.c=1: a.b is the single value '1 m' (it cannot have a key 'c')");
  CHECK(problem("list.2=3") ==
        "--set list.2=3: list has no item '2' (it is a list of 2) number its items from 0");
  CHECK(problem("list.x=3").find("list has no item 'x'") != std::string::npos);
  CHECK(problem("a") ==
        "--set a: is not of the form path.to.key=value (e.g. --set stages.flow.with.cell='1 m')");
  for (const std::string option : {"=3", "a..b=3", ".a=3", "a.=3"})
    CHECK(problem(option).find("is not of the form") != std::string::npos);
  CHECK(problem("a.b=").find("is empty (no value is given") != std::string::npos);
  CHECK(problem("a.b={c: 1, c: 2}").find("key 'c' is given twice") != std::string::npos);
  CHECK(problem("a.b=[1").find("a bracket that is not closed?") != std::string::npos);
  std::string deep = "x";
  for (int i = 0; i < 1000; ++i) deep += ".x";
  CHECK(problem(deep + "=1").find("is not of the form") != std::string::npos);
}

TEST_CASE("a long option of --set is named by its beginning", "[config]") {
  // Every value of the list has a place, of which the option's text is a part.
  std::string option = "a.b=[\u00e9";
  for (int i = 0; i < 10000; ++i) option += ",1";
  const YamlFile file(kText);
  const std::vector<std::string> options = {option + "]"};
  const YamlNode list = *load_yaml(file.path(), options).find("a")->find("b");
  CHECK(list.size() == 10001);
  CHECK(list.item(5000).where().text() == "--set " + option.substr(0, 200) + "...");
  // A letter of two bytes is not cut in two.
  CHECK(load_problem(kText, {std::string(199, 'x') + "\u00e9"}).find("x...: is not of") !=
        std::string::npos);
}

TEST_CASE("a reference takes the value at its path", "[config]") {
  const YamlFile file("a: {b: 1 m, c: \"${d.e}\"}\nd: {e: \"${a.b}\", l: [1, \"${a.c}\"]}\n");
  const YamlNode root = load_yaml(file.path());
  const YamlNode item = root.find("d")->find("l")->item(1);
  CHECK(item.scalar() == "1 m");
  CHECK(root.find("a")->find("c")->scalar() == "1 m");
  CHECK(std::string(item.error("is wrong").what()) ==
        file.path().string() + ":2:25: d.l.1: is wrong (the value comes from ${a.c})");
  const std::vector<std::string> options = {"a.b=2 m"};
  CHECK(load_yaml(file.path(), options).find("d")->find("e")->scalar() == "2 m");
}

TEST_CASE("a reference takes a list or a map with all that is in it", "[config]") {
  const YamlFile file(
      "rule: {box: {left: 1 m, right: \"${end}\"}, tags: [a, b]}\nend: 5 m\n"
      "zone: ${rule}\nmap: {box: \"${zone.box}\", tags: \"${rule.tags}\"}\n");
  const YamlNode root = load_yaml(file.path());
  CHECK(root.find("zone")->find("tags")->item(1).scalar() == "b");
  const YamlNode right = *root.find("map")->find("box")->find("right");
  CHECK(right.scalar() == "5 m");
  CHECK(right.path() == "map.box.right");
  // The place is that where the value can be changed.
  CHECK(std::string(right.error("is wrong").what()) ==
        file.path().string() +
            ":1:32: map.box.right: is wrong (the value comes from ${zone.box.right})");
  const std::vector<std::string> options = {"rule.box.left=2 m"};
  CHECK(load_yaml(file.path(), options).find("map")->find("box")->find("left")->scalar() == "2 m");
  // A copy is a value of its own: the other one keeps its entries.
  CHECK(root.find("rule")->find("box")->size() == 2);
}

TEST_CASE("references cannot blow a file up", "[config]") {
  std::string doubling = "k0: [1, 1]\n", nesting = "n0: [1]\n";
  for (int i = 1; i <= 40; ++i) {
    doubling += fmt::format("k{0}: [\"${{k{1}}}\", \"${{k{1}}}\"]\n", i, i - 1);
    nesting += fmt::format("n{0}: [[\"${{n{1}}}\"]]\n", i, i - 1);
  }
  CHECK(load_problem(doubling).find("makes the file too large") != std::string::npos);
  CHECK(load_problem(nesting).find("nests too deep") != std::string::npos);
}

TEST_CASE("a reference to nothing, or to itself, is refused", "[config]") {
  const auto problem = [](const std::string& line) {
    return load_problem(std::string(kText) + line);
  };
  CHECK(problem("z: ${a.x}") ==
        "case.yaml:4:4: z: '${a.x}': a has no key 'x' (a reference needs a value that is written "
        "there)");
  CHECK(load_problem("cell: 1 m\nz: ${cel}").find("did you mean 'cell'?") != std::string::npos);
  CHECK(load_problem("a: {b: \"${a}\"}") ==
        "case.yaml:1:8: a.b: '${a}' refers to itself (a.b -> a) refer to a part that lies outside");
  CHECK(load_problem("a: {b: \"${c}\"}\nc: {d: \"${a}\"}").find("(a.b -> c.d -> a)") !=
        std::string::npos);
  CHECK(problem("z: ${none}").find("none is without a value") != std::string::npos);
  CHECK(problem("z: ${list.7}").find("list has no item '7'") != std::string::npos);
  CHECK(problem("z: ${}").find("is not a path") != std::string::npos);
  CHECK(problem("z: \"${a.b} m\"") ==
        "case.yaml:4:4: z: '${a.b} m' holds a reference within text (a reference is the whole "
        "value) write '${path.to.key}' alone");
  CHECK(problem("z: ${z}") ==
        "case.yaml:4:4: z: '${z}' refers to itself (z -> z) give one of them a value");
  CHECK(problem("y: ${z}\nz: ${y}") ==
        "case.yaml:5:4: z: '${y}' refers to itself (y -> z -> y) give one of them a value");
  std::string chain;
  for (int i = 0; i < 8; ++i)
    chain += "k" + std::to_string(i) + ": ${k" + std::to_string(i + 1) + "}\n";
  CHECK(load_problem(chain + "k8: 1\n").empty());
  CHECK(load_problem(chain + "k8: ${k9}\nk9: 1\n").find("a chain of more than 8 references") !=
        std::string::npos);
}
