#include "importers/mesh_text.hpp"

#include "core/check.hpp"
#include "tests/importers/two_elements.hpp"
#include "tests/support/data_folder.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;

namespace {

const std::string &kNodes = flowslide::test::kTwoNodes, &kElements = flowslide::test::kTwoElements;

struct Files {
  DataFolder folder;
  MeshTextConfig config;
  Files(std::string_view nodes, std::string_view elements) {
    config.nodes.path = folder.write("nodeinfo.dat", nodes);
    config.elements.path = folder.write("elementinfo.dat", elements);
  }
  [[nodiscard]] MeshText read(double length = 1.0) const { return read_mesh_text(config, length); }
};

}  // namespace

TEST_CASE("a mesh is read from two tables", "[importers]") {
  const MeshText text = Files(kNodes, kElements).read(0.5);
  const QuadMesh& mesh = text.mesh;
  CHECK(mesh.node_tags == std::vector<std::int64_t>{1, 2, 3, 4, 5, 6});
  CHECK(mesh.nodes[2] == Vec2{1.0, 0.0});
  CHECK(mesh.element_tags == std::vector<std::int64_t>{10, 20});
  CHECK(mesh.elements[1] == std::array<std::int32_t, 4>{1, 2, 5, 4});
  CHECK(mesh.element_material == std::vector<std::int32_t>{168, 170});
  CHECK(text.notes.empty());
}

TEST_CASE("numbers may be written as floats, tags are not contiguous", "[importers]") {
  const Files files("1.0 0 0\n2e3 1 0\n-7 1 1\n5000000000 0 1\n", "0 1 2000 -7 5e9 1.68e2\n");
  const QuadMesh mesh = files.read().mesh;
  CHECK(mesh.node_tags == std::vector<std::int64_t>{1, 2000, -7, 5000000000});
  CHECK(mesh.elements[0] == std::array<std::int32_t, 4>{0, 1, 2, 3});
  CHECK(mesh.element_material[0] == 168);
}

TEST_CASE("declared columns may stand in any order", "[importers]") {
  Files files("0,0,9,1\n1,0,9,2\n1,1,9,3\n0,1,9,4\n", "168 7 4 1 2 3\n");
  files.config.node_columns = {"x", "y", "skip", "tag"};
  files.config.element_columns = {"material", "tag", "n4", "n1", "n2", "n3"};
  const QuadMesh mesh = files.read().mesh;
  CHECK(mesh.nodes[2] == Vec2{1.0, 1.0});
  CHECK(mesh.elements[0] == std::array<std::int32_t, 4>{0, 1, 2, 3});
  CHECK(mesh.element_tags[0] == 7);
}

TEST_CASE("recorder order is the file's or by tag", "[importers]") {
  Files files("2 1 0\n1 0 0\n4 0 1\n3 1 1\n", "1 1 2 3 4 5\n");
  const MeshText by_file = files.read();
  CHECK(by_file.mesh.node_tags == std::vector<std::int64_t>{2, 1, 4, 3});
  CHECK_THAT(by_file.notes.at(0), Contains("nodeinfo.dat: tags do not ascend"));
  files.config.recorder_order = RecorderOrder::tag;
  const MeshText by_tag = files.read();
  CHECK(by_tag.mesh.node_tags == std::vector<std::int64_t>{1, 2, 3, 4});
  CHECK(by_tag.mesh.elements[0] == std::array<std::int32_t, 4>{0, 1, 2, 3});
  CHECK(by_tag.notes.empty());
}

TEST_CASE("clockwise elements are listed, and reversed if asked", "[importers]") {
  Files files(kNodes, "10 1 4 5 2 168\n20 2 3 6 5 170\n");
  CHECK_THROWS_WITH(files.read(), Contains("elementinfo.dat: 1 elements run clockwise (10)"));
  files.config.reverse_clockwise = true;
  const MeshText text = files.read();
  CHECK(area(corners(text.mesh, text.mesh.nodes, 0)) == 1.0);
  CHECK_THAT(text.notes.at(0), Contains("1 clockwise elements were reversed"));
}

TEST_CASE("a section whose y points downwards is told from one clockwise element", "[importers]") {
  Files one(kNodes, "10 1 4 5 2 168\n20 2 3 6 5 170\n");
  CHECK_THROWS_WITH(one.read(), Contains("`reverse_clockwise: true`") && !Contains("downwards"));
  Files all("1 0 0\n2 1 0\n3 2 0\n4 0 -1\n5 1 -1\n6 2 -1\n", "10 1 2 5 4 168\n20 2 3 6 5 170\n");
  CHECK_THROWS_WITH(all.read(), Contains("2 elements run clockwise (10, 20)") &&
                                    Contains("does y point downwards") && Contains("upside down"));
}

TEST_CASE("coincident nodes and a missing last newline are noted", "[importers]") {
  const MeshText text = Files(kNodes + "7 2 1\n", "10 1 2 5 4 168\n20 2 3 7 5 170").read();
  REQUIRE(text.notes.size() == 2);
  CHECK_THAT(text.notes[0], Contains("1 nodes lie on another node"));
  CHECK_THAT(text.notes[1], Contains("last line has no newline, taken as complete"));
}

TEST_CASE("a broken mesh is explained with file and line", "[importers]") {
  struct Case {
    std::string nodes;
    std::string elements;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"", kElements, "nodeinfo.dat: no rows"},
      {kNodes, "", "elementinfo.dat: no rows"},
      {"1 0 0\n1.5 1 0\n", kElements, "nodeinfo.dat:2: node number 1.5 is not a whole number"},
      {"1 0 0\n2 x 0\n", kElements, "nodeinfo.dat:2: column 2 'x' is not a number"},
      {"1 0 0\n2 nan 0\n", kElements, "nodeinfo.dat:2: column 2 (x) is nan"},
      {"1 0 0 0\n", kElements, "nodeinfo.dat:1: 4 columns, but `node_columns` names 3"},
      {"1 0 0\n2 1\n", kElements, "nodeinfo.dat:2: 2 columns"},
      {kNodes + "2 9 9\n", kElements, "nodeinfo.dat:7: node 2 was already given in line 2"},
      {kNodes, kElements + "10 1 2 5 4 168\n",
       "elementinfo.dat:3: element 10 was already given in line 1"},
      {kNodes, "10 1 2 5 99 168\n",
       "elementinfo.dat:1: element 10 names node 99, which nodeinfo.dat lacks"},
      {kNodes, "10 1 2 5 5 168\n", "1 elements name a node twice (10)"},
      {kNodes, "10 1 2 4 5 168\n", "1 elements are folded or not convex (10)"},
      {kNodes, "10 1 2 3 5 168\n", "folded or not convex (10)"},
      {kNodes, "10 1 2 5 4 1e10\n", "material number 10000000000 is too large"},
      {kNodes, "10 1 2 5 4 1.5\n", "material number 1.5 is not a whole number"}};
  for (const Case& c : cases) {
    CAPTURE(c.message);
    const Files files(c.nodes, c.elements);
    CHECK_THROWS_AS(files.read(), InputError);
    CHECK_THROWS_WITH(files.read(), Contains(c.message));
  }
}

TEST_CASE("column names are checked", "[importers]") {
  Files files(kNodes, kElements);
  files.config.node_columns = {"tag", "x", "z"};
  CHECK_THROWS_WITH(files.read(), Contains("`node_columns`: unknown column 'z'"));
  files.config.node_columns = {"tag", "x", "x"};
  CHECK_THROWS_WITH(files.read(), Contains("names 'x' twice"));
  files.config.node_columns = {"tag", "x", "skip"};
  CHECK_THROWS_WITH(files.read(), Contains("lacks 'y'"));
}
