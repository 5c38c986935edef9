#include "model/history_material.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

/// Two unit squares side by side, of the tags 168 and 167.
QuadMesh two_soils() {
  QuadMesh m;
  m.nodes = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}};
  m.node_tags = {1, 2, 3, 4, 5, 6};
  m.elements = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  m.element_tags = {11, 12};
  m.element_material = {168, 167};
  return m;
}

const std::vector<HistoryMaterial> kSoils{{"tailings", 168, 1870.0}, {"dam", 167, 1690.0, 0.5}};

}  // namespace

TEST_CASE("Materials of a section have a name, a tag and a density each", "[model]") {
  CHECK_NOTHROW(check(two_soils(), kSoils));
  CHECK(element_densities(two_soils(), kSoils) == std::vector<double>{1870.0, 1690.0});
  const auto with = [](auto change) {
    std::vector<HistoryMaterial> soils = kSoils;
    change(soils);
    check(two_soils(), soils);
  };
  CHECK_THROWS_WITH(with([](auto& s) { s.pop_back(); }),
                    Contains("element 12 has the material tag 167") && Contains("known: tailings"));
  CHECK_THROWS_WITH(with([](auto& s) { s[1].name = "tailings"; }), Contains("two materials"));
  CHECK_THROWS_WITH(with([](auto& s) { s[1].tag = 168; }), Contains("the tag 168 of another"));
  CHECK_THROWS_WITH(with([](auto& s) { s[1].density = kUnset; }), Contains("no mass"));
  CHECK_THROWS_WITH(with([](auto& s) { s[1].porosity = 50.0; }), Contains("porosity 50"));
}

TEST_CASE("A material is found by its name; a tag is answered with the name", "[model]") {
  CHECK(find_material(kSoils, "dam", "liquefiable").tag == 167);
  CHECK_THROWS_WITH(find_material(kSoils, "168", "liquefiable"),
                    Contains("liquefiable: 168 is a tag") && Contains("write tailings"));
  CHECK_THROWS_WITH(find_material(kSoils, "tailing", "liquefiable"),
                    Contains("no material 'tailing' (known: tailings, dam)"));
}
