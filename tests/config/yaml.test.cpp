#include "config/yaml.hpp"

#include "tests/config/sample.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using sample::load_problem;
using sample::YamlFile;

TEST_CASE("values of a file carry their place and path", "[config]") {
  const YamlFile file("a: 1 m\nlist:\n  - x\n  - {key: \"quoted\"}\nempty:\n");
  const YamlNode root = load_yaml(file.path());
  REQUIRE(root.kind() == YamlNode::Kind::map);
  CHECK(root.size() == 3);
  CHECK(root.folder() == file.folder());
  CHECK(root.entries()[1].first == "list");
  const YamlNode value = root.find("list")->item(1).find("key").value();
  CHECK(value.scalar() == "quoted");
  CHECK(value.path() == "list.1.key");
  CHECK(value.where().text() == file.path().string() + ":4:11");
  CHECK(value.key_where().text() == file.path().string() + ":4:6");
  CHECK(root.find("empty")->kind() == YamlNode::Kind::null);
  CHECK(root.find("empty")->where().line == 5);
  CHECK_FALSE(root.find("nothing").has_value());
  CHECK_FALSE(root.find("empty")->find("below").has_value());
}

TEST_CASE("a value of the wrong kind is refused at its place", "[config]") {
  const auto use = [](std::string_view text, auto access) {
    return sample::problem_of(
        text, [&](const auto& path) { static_cast<void>(access(load_yaml(path))); });
  };
  CHECK(use("a: [1]\n", [](const YamlNode& n) { return n.find("a")->entries(); }) ==
        "case.yaml:1:4: a: is a list (a map is expected) write 'key: value' lines");
  CHECK(use("- 1\n", [](const YamlNode& n) { return n.find("a"); }) ==
        "case.yaml:1:1: is a list (a map is expected) write 'key: value' lines");
  CHECK(use("a: {b: 1}\n", [](const YamlNode& n) { return n.find("a")->scalar(); }) ==
        "case.yaml:1:4: a: is a map (a single value is expected)");
  CHECK(use("a: x\n", [](const YamlNode& n) { return n.find("a")->item(0); }) ==
        "case.yaml:1:4: a: is a single value (a list is expected)");
  CHECK(use("a: [x]\n", [](const YamlNode& n) { return n.find("a")->item(1); }) ==
        "case.yaml:1:4: a: has no item 1 (the list has 1 items)");
}

TEST_CASE("a file that cannot be read is a FileError", "[config]") {
  CHECK_THROWS_AS(load_yaml("no-such-file.yaml"), FileError);
  CHECK_THROWS_WITH(load_yaml("no-such-file.yaml"), "no-such-file.yaml: no such file");
  const YamlFile file("a: 1\n");
  CHECK_THROWS_AS(load_yaml(file.folder()), FileError);
  CHECK_THROWS_AS(load_yaml("/dev/zero"), FileError);
  REQUIRE(::mkfifo((file.folder() / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(load_yaml(file.folder() / "pipe"), Catch::Contains("a pipe or a device"));
}

TEST_CASE("text that is no UTF-8 YAML is refused with its place", "[config]") {
  using namespace std::string_view_literals;
  CHECK(load_problem("a:\n\tb: 1\n") ==
        "case.yaml:2:1: tab character (YAML forbids tabs in indentation, and they look like "
        "spaces) replace it by spaces");
  CHECK(load_problem("\xFF\xFE\x61\0"sv) ==
        "case.yaml:1:1: is UTF-16 or UTF-32 text (UTF-8 is expected) save it as UTF-8 in your "
        "editor");
  CHECK(load_problem("a: \0\n"sv) ==
        "case.yaml:1:4: NUL byte (this is not a text file, or it is UTF-16) save it as UTF-8");
  CHECK(load_problem("a: 1\n# caf\xE9\n") ==
        "case.yaml:2:6: byte 0xe9 is not UTF-8 text (the file may be in Latin-1) save it as UTF-8");
  CHECK(load_problem("a: \xED\xA0\x80\n").find("byte 0xed is not UTF-8") != std::string::npos);
  CHECK(load_problem("a: 1\rb: 2\n").find("case.yaml:1:5: carriage return") == 0);
  CHECK(load_problem("a: \x1b[0m\n").find("case.yaml:1:4: control character 0x1b") == 0);
  CHECK(load_problem(std::string((2u << 20u) + 1, '#')).find("is larger than 2 MiB") !=
        std::string::npos);
}

TEST_CASE("byte-order mark and Windows line ends do not change what is read", "[config]") {
  const YamlFile file(
      "\xEF\xBB\xBF"
      "a: 1\r\nb:\r\n  caf\xC3\xA9: 2 m\r\n");
  const YamlNode root = load_yaml(file.path());
  CHECK(root.find("a")->scalar() == "1");
  CHECK(root.find("b")->find("caf\xC3\xA9")->scalar() == "2 m");
  CHECK(root.find("b")->find("caf\xC3\xA9")->key_where().line == 3);
}

TEST_CASE("a file without a value is refused", "[config]") {
  const std::string problem = "case.yaml:1:1: is empty (no value is given, at most comments)";
  CHECK(load_problem("") == problem);
  CHECK(load_problem("# only\n\n# comments\n") == problem);
  CHECK(load_problem("~\n") == problem);
}

TEST_CASE("legal YAML that misleads users is refused", "[config]") {
  CHECK(load_problem("a: 1\nb: {c: 1, d: 2, c: 3}\n") ==
        "case.yaml:2:17: b: key 'c' is given twice (first at case.yaml:2:5) remove one of them");
  CHECK(load_problem("a: &x 1\n") ==
        "case.yaml:1:4: a: anchor '&...' (anchors and aliases are not supported) refer to a value "
        "with ${path.to.key}");
  CHECK(load_problem("a: *x\n") ==
        "case.yaml:1:4: YAML syntax: the referenced anchor is not defined (a value cannot start "
        "with *, and aliases are not supported) put it in quotes");
  CHECK(load_problem("a: !!int 3\n") ==
        "case.yaml:1:4: a: tag 'tag:yaml.org,2002:int' (tags are not supported) remove it");
  CHECK(load_problem("a: 1\n---\nb: 2\n") ==
        "case.yaml:2:1: a second document starts here (one per file is read) remove the '---' "
        "line, or correct the indentation");
  CHECK(load_problem(": 2\n") ==
        "case.yaml:1:1: nothing stands in place of a key (a bracket that is not closed?) close it, "
        "or write 'name: value'");
  CHECK(load_problem("{a: 1}: 2\n").find("a map stands in place of a key") != std::string::npos);
}

TEST_CASE("wrong syntax is reported with a hint", "[config]") {
  CHECK(load_problem("a: b: c\n") ==
        "case.yaml:1:5: YAML syntax: illegal map value (a ': ' inside a value, or wrong "
        "indentation) quote the value or align the keys");
  CHECK(load_problem("a:\n   b: 2\n  c: 3\n") ==
        "case.yaml:3:3: YAML syntax: end of map not found (wrong indentation here or just above) "
        "align the keys");
  CHECK(load_problem("a: [1, 2\nb: 3\n") ==
        "case.yaml:2:2: YAML syntax: end of sequence flow not found (a '[' is not closed) add ']'");
  CHECK(load_problem("a: %5\n") ==
        "case.yaml:1:4: YAML syntax: unknown token (a value cannot start with %, @ or `) put it in "
        "quotes");
  CHECK(load_problem("a: \"x\nb: 3\n") ==
        "case.yaml:1:4: a: the quote \" is not closed (the rest of the file would be the value) "
        "add \"");
  CHECK(load_problem("a: 'x''\nb: 3\n").find("the quote ' is not closed") != std::string::npos);
  CHECK(load_problem("a: 'it''s'\nb: \"x\\\"\"\n").empty());
}

TEST_CASE("hostile nesting is refused quickly", "[config]") {
  const auto repeat = [](std::string_view part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  CHECK(load_problem(repeat("- ", 1000000)) ==
        "case.yaml:1:129: lists and maps are nested more than 64 deep (brackets that are never "
        "closed?)");
  CHECK(load_problem(repeat("[", 1000000)).find("a list stands in place of a key") !=
        std::string::npos);
  CHECK(load_problem(repeat("[", 1000) + repeat("]", 1000)).find("more than 64 deep") !=
        std::string::npos);
  CHECK(load_problem(repeat("[", 64) + repeat("]", 64)).empty());
}

TEST_CASE("long keys above a long list do not multiply", "[config]") {
  // 60 keys of 1000 letters above 20000 values: as a text in every value they were 1.2 GB.
  std::string text;
  for (int depth = 0; depth < 60; ++depth)
    text += std::string(depth, ' ') + std::string(1000, 'k') + ":\n";
  text += std::string(60, ' ') + "[1";
  for (int i = 1; i < 20000; ++i) text += ",1";
  const YamlFile file(text + "]\n");
  const auto peak = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // [kB]
  };
  const long before = peak();
  YamlNode node = load_yaml(file.path());
  while (node.kind() == YamlNode::Kind::map) node = node.entries()[0].second;
  CHECK(peak() - before < 400'000);
  CHECK(node.item(19999).path().size() == 60 * 1001 + 5);
}

TEST_CASE("a near word is found, a far one is not", "[config]") {
  const std::vector<std::string> known = {"spacing", "cell", "c_soft_ratio", "end"};
  CHECK(nearest("spacng", known) == "spacing");
  CHECK(nearest("spaicng", known) == "spacing");  // a swap counts once
  CHECK(nearest("CELL", known) == "cell");
  CHECK(nearest("c-soft-ratio", known) == "c_soft_ratio");
  CHECK_FALSE(nearest("friction", known).has_value());
  CHECK_FALSE(nearest("x", known).has_value());
  CHECK_FALSE(nearest("", known).has_value());
  CHECK_FALSE(nearest(std::string(100000, 'a'), known).has_value());
}
