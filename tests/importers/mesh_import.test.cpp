#include "importers/mesh_import.hpp"

#include "core/check.hpp"
#include "tests/importers/two_elements.hpp"
#include "tests/support/data_folder.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;

namespace {

const std::string &kNodes = flowslide::test::kTwoNodes, &kElements = flowslide::test::kTwoElements;

struct Tables {
  DataFolder folder;
  MeshImportConfig config;
  Tables(std::string_view nodes, std::string_view elements) {
    config.tables.emplace();
    config.tables->nodes.path = folder.write("nodeinfo.dat", nodes);
    config.tables->elements.path = folder.write("elementinfo.dat", elements);
  }
};

}  // namespace

TEST_CASE("nodes of no element are left out of tables, with a note", "[importers]") {
  CHECK(import_mesh(Tables(kNodes, kElements).config).notes.empty());
  const SectionMesh one = import_mesh(Tables("99 -20 12\n" + kNodes, kElements).config);
  CHECK(one.mesh.node_tags == std::vector<std::int64_t>{1, 2, 3, 4, 5, 6});
  CHECK(one.mesh.elements[1] == std::array<std::int32_t, 4>{1, 2, 5, 4});
  REQUIRE(one.notes.size() == 2);  // and that its number is out of order
  CHECK_THAT(one.notes[1], Contains("nodeinfo.dat: 1 node belongs to no element and is left out") &&
                               Contains("node 99") && Contains("elementinfo.dat"));
  const SectionMesh two = import_mesh(Tables(kNodes + "7 9 9\n8 9 8\n", kElements).config);
  REQUIRE(two.notes.size() == 1);
  CHECK_THAT(two.notes[0], Contains("2 nodes belong to no element") && Contains("node 7"));
}

TEST_CASE("a mesh that lies over itself is refused by its importer", "[importers]") {
  // The second element has a corner of its own, which lies within the first.
  Tables tables(kNodes + "7 0.5 0.9\n", "10 1 2 5 4 168\n20 2 3 6 7 170\n");
  CHECK_THROWS_WITH(import_mesh(tables.config),
                    Contains("nodeinfo.dat: a pair of outer edges") && Contains("element 10") &&
                        Contains("element 20") && Contains("name the same nodes"));
  // What is left out may lie anywhere.
  tables.config.right = 1.0;
  CHECK(import_mesh(tables.config).mesh.num_elements() == 1);
}

TEST_CASE("a material number with two names is refused", "[importers]") {
  Tables tables(kNodes, kElements);
  tables.config.materials["soil"].tag = 168;
  tables.config.materials["clay"].tag = 170;
  CHECK(material_tag(import_mesh(tables.config), "soil") == 168);
  tables.config.materials["clay"].tag = 168;
  CHECK_THROWS_WITH(check(tables.config), Contains("'clay' and 'soil' have the same tag 168"));
}
