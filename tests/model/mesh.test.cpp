#include "model/mesh.hpp"

#include "core/check.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

QuadMesh two_quads() {
  QuadMesh m;
  m.nodes = {{0, 0}, {1, 0}, {3, 0}, {0, 1}, {1, 1}, {3, 2}};
  m.node_tags = {10, 20, 30, 40, 50, 60};
  m.elements = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  m.element_tags = {7, 8};
  m.element_material = {1, 2};
  return m;
}

}  // namespace

TEST_CASE("area and centroid of quadrilaterals with known answers") {
  const QuadMesh m = two_quads();
  CHECK_NOTHROW(check(m));
  CHECK(area(corners(m, m.nodes, 0)) == 1.0);
  CHECK(area(corners(m, m.nodes, 1)) == 3.0);  // trapezium of width 2, heights 1 and 2
  CHECK(centroid(corners(m, m.nodes, 1)) == Vec2{2.0, 0.75});
  const std::array<Vec2, 4> clockwise{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  CHECK(area(clockwise) == -1.0);
}

TEST_CASE("a broken mesh is refused by tag") {
  using Catch::Matchers::Contains;
  QuadMesh m = two_quads();
  SECTION("node index out of range") {
    m.elements[1][2] = 6;
    CHECK_THROWS_WITH(check(m), Contains("element 8") && Contains("node index 6"));
  }
  SECTION("negative node index") {
    m.elements[0][0] = -1;
    CHECK_THROWS_WITH(check(m), Contains("element 7") && Contains("-1"));
  }
  SECTION("clockwise element") {
    m.elements[0] = {0, 3, 4, 1};
    CHECK_THROWS_WITH(check(m), Contains("element 7") && Contains("Jacobian"));
  }
  SECTION("re-entrant corner, though the area is positive") {
    m.nodes[5] = {1.6, 0.3};
    CHECK(area(corners(m, m.nodes, 1)) > 0.0);
    CHECK_THROWS_WITH(check(m), Contains("element 8") && Contains("node 60"));
  }
  SECTION("coordinate is NaN") {
    m.nodes[2][1] = kUnset;
    CHECK_THROWS_WITH(check(m), Contains("node 30"));
  }
  SECTION("tag twice") {
    m.node_tags[3] = 10;
    CHECK_THROWS_WITH(check(m), Contains("node tag 10"));
  }
  SECTION("length differs") {
    m.element_material.pop_back();
    CHECK_THROWS_WITH(check(m), Contains("1 material tags"));
  }
  SECTION("empty") { CHECK_THROWS_AS(check(QuadMesh{}), InputError); }
}
