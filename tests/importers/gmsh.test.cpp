#include "importers/gmsh.hpp"

#include "core/check.hpp"
#include "importers/mesh_import.hpp"
#include "tests/model/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

// Two squares side by side, the right one clockwise; a base of two lines and an inner line.
const std::string kFormat2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 5 "base"
2 168 "tailings"
2 170 "deep clay"
$EndPhysicalNames
$Nodes
7
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
9 9 9 0
$EndNodes
$Elements
6
1 15 2 0 1 9
2 1 2 5 1 1 2
3 1 2 5 1 3 2
4 1 2 6 2 2 5
10 3 2 168 1 1 2 5 4
11 3 2 170 2 2 5 6 3
$EndElements
)";

// The same in format 4.1.
const std::string kFormat4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 5 "base"
2 168 "tailings"
2 170 "deep clay"
$EndPhysicalNames
$Entities
1 2 2 0
9 9 9 0 0
1 0 0 0 2 0 0 1 5 2 1 -3
2 1 0 0 1 1 0 1 6 2 2 -5
1 0 0 0 1 1 0 1 168 4 1 2 3 4
2 1 0 0 2 1 0 1 170 4 1 2 3 4
$EndEntities
$Nodes
2 7 1 9
0 9 0 1
9
9 9 0
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 5 2 11
1 1 1 2
2 1 2
3 3 2
1 2 1 1
4 2 5
2 1 3 1
10 1 2 5 4
2 2 3 1
11 2 5 6 3
$EndElements
)";

SectionMesh read(const std::string& text, double length = 1.0) {
  const Scratch scratch;
  put_bytes(scratch / "dam.msh", text);
  return read_gmsh(scratch / "dam.msh", length);
}

std::string error_of(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  try {
    read(text.replace(at, old.size(), replacement));
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("gmsh meshes of both formats are the same section") {
  for (const std::string& text : {kFormat2, kFormat4}) {
    const SectionMesh s = read(text, 0.5);
    CHECK(s.mesh.node_tags == std::vector<std::int64_t>{1, 2, 3, 4, 5, 6});
    CHECK(s.mesh.nodes[5] == Vec2{1.0, 0.5});
    CHECK(s.mesh.element_tags == std::vector<std::int64_t>{10, 11});
    CHECK(s.mesh.elements[0] == std::array<std::int32_t, 4>{0, 1, 4, 3});
    CHECK(s.mesh.elements[1] == std::array<std::int32_t, 4>{1, 2, 5, 4});
    CHECK(material_tag(s, "deep clay") == 170);
    // Both lines of the base with the soil on the left, though the file turns one.
    CHECK(find_set(s, "base").edges == std::vector<std::array<std::int32_t, 2>>{{0, 1}, {1, 2}});
    CHECK(find_set(s, "curve 6").edges.size() == 1);
    REQUIRE(s.notes.size() == 1);
    CHECK_THAT(s.notes[0], Contains("1 clockwise"));
  }
}

TEST_CASE("gmsh files that are no section are refused with their place") {
  CHECK_THAT(error_of(kFormat2, "2.2 0 8", "2.2 1 8"), Contains("dam.msh:2") && Contains("binary"));
  CHECK_THAT(error_of(kFormat2, "2.2 0", "4.0 0"), Contains("format 4"));
  CHECK_THAT(error_of(kFormat2, "10 3 2 168 1 1 2 5 4", "10 2 2 168 1 1 2 5"),
             Contains("dam.msh:26") && Contains("triangle") && Contains("Recombine"));
  CHECK_THAT(error_of(kFormat2, "10 3 2 168 1 1 2 5 4", "10 10 2 168 1 1 2 5 4 9 9 9 9 9"),
             Contains("type 10"));
  CHECK_THAT(error_of(kFormat2, "10 3 2 168 1 1 2 5 4", "10 3 2 0 1 1 2 5 4"),
             Contains("no physical surface"));
  CHECK_THAT(error_of(kFormat2, "1 1 2 5 4", "1 1 2 5 8"), Contains("names node 8"));
  CHECK_THAT(error_of(kFormat2, "6 2 1 0", "6 2 1 0.5"), Contains("z = 0.5"));
  CHECK_THAT(error_of(kFormat2, "6 2 1 0", "6 2 x 0"), Contains("dam.msh:17"));
  CHECK_THAT(error_of(kFormat2, "$Elements\n6", "$Elements\n7"), Contains("not an element"));
  CHECK_THAT(error_of(kFormat2, "$Elements\n6", "$Elements\n5"), Contains("more lines"));
  CHECK_THAT(error_of(kFormat2, "$Elements\n6", "$Elements\n1e99"), Contains("whole number"));
  // 2^32 + 168 is not 168.
  CHECK_THAT(error_of(kFormat2, "10 3 2 168", "10 3 2 4294967464"),
             Contains("dam.msh:26: physical group 4294967464 is larger"));
  CHECK_THAT(error_of(kFormat2, "10 3 2 168", "10 4294967299 2 168"),
             Contains("type 4294967299 is larger"));
  CHECK_THAT(error_of(kFormat2, "2 168 \"", "2 4294967464 \""), Contains("is larger"));
  CHECK_THAT(error_of(kFormat2, "2 168 \"", "2x168 \""),
             Contains("is not a dimension and a number"));
  CHECK_THAT(error_of(kFormat2, "2 168 \"", "168 \""), Contains("dimension, number, \"name\""));
  CHECK_THAT(error_of(kFormat4, "1 0 0 0 1 1 0 1 168", "1 0 0 0 1 1 0 1 4294967464"),
             Contains("is larger"));
  CHECK_THAT(error_of(kFormat4, "$EndElements\n", ""), Contains("ends inside $Elements"));
  CHECK_THAT(error_of(kFormat2, "$MeshFormat\n", "solid dam\n"), Contains("is this a .msh"));
}

TEST_CASE("soil that is in a gmsh file twice is refused") {
  CHECK_THAT(error_of(kFormat2, "$Elements\n6\n", "$Elements\n7\n100 3 2 170 1 2 5 4 1\n"),
             Contains("such as 100 and 10 with the same nodes") && Contains("'deep clay'") &&
                 Contains("'tailings'") && Contains("one physical group"));
  CHECK_THAT(error_of(kFormat4, "1 1 0 1 168 4", "1 1 0 2 168 170 4"),
             Contains("surface 1 is in 2 physical groups"));
}

TEST_CASE("soil that is not joined is refused") {
  // The right square with nodes of its own on the common side.
  std::string text = kFormat2;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"$Nodes\n7\n", "$Nodes\n9\n12 1 0 0\n15 1 1.0000001 0\n"},
           {"11 3 2 170 2 2 5 6 3", "11 3 2 170 2 12 15 6 3"}})
    text.replace(text.find(from), from.size(), to);
  CHECK_THAT(error_of(text, "9 9 9 0", "9 9 9 0"),
             Contains("2 nodes lie on another node, such as") && Contains("falls into 2 parts") &&
                 Contains("Coherence"));
}

TEST_CASE("a curve in two physical groups is in the sets of both, whatever the format") {
  // The base is in 'drain' too: 2.2 repeats its lines, 4.1 lists both groups with the curve.
  std::string two = kFormat2, four = kFormat4;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"$PhysicalNames\n3\n", "$PhysicalNames\n4\n1 7 \"drain\"\n"},
           {"$Elements\n6\n", "$Elements\n8\n12 1 2 7 1 1 2\n13 1 2 7 1 3 2\n"}})
    two.replace(two.find(from), from.size(), to);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"$PhysicalNames\n3\n", "$PhysicalNames\n4\n1 7 \"drain\"\n"},
           {"2 0 0 1 5 2 1 -3", "2 0 0 2 5 7 2 1 -3"}})
    four.replace(four.find(from), from.size(), to);
  for (const std::string& text : {two, four}) {
    const SectionMesh s = read(text);
    CHECK(s.sets.size() == 3);
    for (const char* name : {"base", "drain"})
      CHECK(find_set(s, name).edges == std::vector<std::array<std::int32_t, 2>>{{0, 1}, {1, 2}});
  }
  // Groups of one name are one set, their common lines in it once.
  two.replace(two.find("1 7 \"drain\""), 11, "1 7 \"base\"");
  CHECK(find_set(read(two), "base").edges.size() == 2);
}

TEST_CASE("a physical group with two names is refused with its line") {
  CHECK_THAT(error_of(kFormat2, "3\n1 5 \"base\"\n", "4\n1 5 \"base\"\n1 5 \"drain\"\n"),
             Contains("dam.msh:7") && Contains("is 'drain', and was 'base'"));
  // The same once more, and a surface of the number of a curve, contradict nothing.
  CHECK(error_of(kFormat2, "3\n1 5 \"base\"\n", "4\n1 5 \"base\"\n1 5 \"base\"\n") == "no error");
  CHECK(error_of(kFormat2, "3\n1 5 \"base\"\n", "4\n1 5 \"base\"\n2 5 \"sand\"\n") == "no error");
  CHECK_THAT(error_of(kFormat2, "$Nodes\n",
                      "$PhysicalNames\n1\n1 6 \"drain\"\n$EndPhysicalNames\n$Nodes\n"),
             Contains("dam.msh:10: a second $PhysicalNames"));
}

TEST_CASE("odd characters in gmsh files are named") {
  CHECK_THAT(error_of(kFormat2, "6 2 1 0", "6 2,5 1 0"), Contains("decimal comma"));
  CHECK_THAT(error_of(kFormat2, "6 2 1 0",
                      "6 2\xC2\xA0"
                      "1 0"),
             Contains("non-breaking space"));
}

TEST_CASE("materials of imported meshes can be named") {
  const Scratch scratch;
  put_bytes(scratch / "dam.msh", kFormat2);
  MeshImportConfig config;
  CHECK_THROWS_WITH(import_mesh(config), Contains("neither"));
  config.gmsh = InputFile{scratch / "dam.msh"};
  config.materials["foundation"].tag = 170;
  CHECK(material_tag(import_mesh(config), "foundation") == 170);
  config.materials["clay"].tag = 3;
  CHECK_THROWS_WITH(import_mesh(config), Contains("'clay' has the tag 3") && Contains("168 170"));
  config.materials.erase("clay");
  const std::size_t before = import_mesh(config).notes.size();
  config.left = -1e6;
  config.right = 1e6;
  const std::vector<std::string> notes = import_mesh(config).notes;
  REQUIRE(notes.size() == before + 2);
  CHECK_THAT(notes[before], Contains("left: x = -1e+06 m leaves nothing out"));
  CHECK_THAT(notes[before + 1], Contains("right: x = 1e+06 m leaves nothing out"));
  config.length = "furlong";
  CHECK_THROWS_AS(import_mesh(config), InputError);
}

TEST_CASE("numbers that a .msh file has too many are refused with their line") {
  const auto changed = [](std::string text, const std::string& line, const std::string& instead) {
    const std::size_t at = text.find("\n" + line + "\n");
    REQUIRE(at != std::string::npos);
    return read(text.replace(at + 1, line.size(), instead));
  };
  using Case = std::array<std::string, 4>;
  for (const auto& [format, line, instead, message] : std::vector<Case>{
           {kFormat2, "2.2 0 8", "2.2 0 8 1", "dam.msh:2: 4 numbers"},
           {kFormat2, "7", "7 7", "dam.msh:11: 2 numbers"},
           {kFormat2, "2 1 0 0", "2 1 0 0 0", "dam.msh:13: 5 numbers, but a node"},
           {kFormat2, "10 3 2 168 1 1 2 5 4", "10 3 2 168 1 1 2 5 4 6", "element 10 has 5 nodes"},
           {kFormat2, "10 3 2 168 1 1 2 5 4", "10 3 1 168 1 1 2 5 4", "element 10 has 5 nodes"},
           {kFormat4, "2 1 0 0 2 1 0 1 170 4 1 2 3 4", "2 1 0 0 2 1 0 1 170 4 1 2 3 4 5",
            "dam.msh:16: 15 numbers"},
           {kFormat4, "2 7 1 9", "2 7 1 9 0", "dam.msh:19: 5 numbers"},
           {kFormat4, "2 7 1 9", "2 8 1 9", "dam.msh:19: 8 nodes, and the blocks after it have 7"},
           {kFormat4, "2 0 0", "2 0 0 0.5", "dam.msh:32: 4 numbers"},
           {kFormat4, "4 5 2 11", "4 6 2 11",
            "dam.msh:38: 6 elements, and the blocks after it have 5"}}) {
    CAPTURE(line, instead);
    CHECK_THROWS_WITH(changed(format, line, instead), Contains(message));
  }
  // What a writer may leave out or put in, and a range that is only told.
  CHECK(changed(kFormat4, "2 1 0 0 2 1 0 1 170 4 1 2 3 4", "2 1 0 0 2 1 0 1 170").notes.size() ==
        1);
  const SectionMesh odd = changed(kFormat4, "2 7 1 9", "2 7 1 10");
  REQUIRE(odd.notes.size() == 2);
  CHECK_THAT(odd.notes[0],
             Contains("dam.msh:19: the numbers of nodes are said to go from 1 to 10"));
  CHECK(changed(kFormat4, "2 1 0 6", "2 1 0 6").notes.size() == 1);  // control
}

TEST_CASE("parametric coordinates of format 4.1 are passed over") {
  std::string text = kFormat4;
  const std::string plain = "2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n";
  REQUIRE(text.find(plain) != std::string::npos);
  text.replace(text.find(plain), plain.size(),
               "2 1 1 6\n1\n2\n3\n4\n5\n6\n0 0 0 8 9\n1 0 0 8 9\n2 0 0 8 9\n0 1 0 8 9\n1 1 0 8 9\n"
               "2 1 0 8 9\n");
  const SectionMesh mesh = read(text);
  CHECK(mesh.mesh.nodes == read(kFormat4).mesh.nodes);
}
