#include "importers/mesh_overlap.hpp"

#include <utility>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

/// Nodes are 1, 2, ... and elements 10, 20, ...; corners by the numbers of nodes.
QuadMesh mesh_of(std::vector<Vec2> nodes,
                 const std::vector<std::array<std::int32_t, 4>>& elements) {
  QuadMesh mesh;
  mesh.nodes = std::move(nodes);
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i)
    mesh.node_tags.push_back(static_cast<std::int64_t>(i + 1));
  for (const auto& e : elements) {
    mesh.elements.push_back({e[0] - 1, e[1] - 1, e[2] - 1, e[3] - 1});
    mesh.element_tags.push_back(static_cast<std::int64_t>(10 * mesh.num_elements()));
    mesh.element_material.push_back(1);
  }
  check(mesh);
  return mesh;
}

/// Two elements on a ground of one; `middle` is their common node at the ground, the 8th.
QuadMesh on_ground(Vec2 middle) {
  return mesh_of({{0, 0}, {2, 0}, {2, 1}, {0, 1}, {2, 2}, {1, 2}, {0, 2}, middle},
                 {{1, 2, 3, 4}, {4, 8, 6, 7}, {8, 3, 5, 6}});
}

}  // namespace

TEST_CASE("a seam whose sides have other nodes is told with elements and place") {
  CHECK_THAT(overlap(on_ground({1, 1})),
             Contains("2 pairs of outer edges meet without being joined") &&
                 Contains("element 10") && Contains("lies along") && Contains("(1, 1) m") &&
                 Contains("no force passes"));
  // Digits that a file left out: a bit above the ground, and a bit within it.
  CHECK_THAT(overlap(on_ground({1, 1.0002})), Contains("lies along"));
  CHECK_THAT(overlap(on_ground({1, 0.9998})), Contains("lies along"));
  CHECK(overlap(on_ground({1, 1.02})).empty());  // a gap that somebody drew
  // Both sides have all nodes, and another one each for the node in the middle.
  const QuadMesh twice =
      mesh_of({{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}, {1, 1.0003}},
              {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 10, 8, 7}, {10, 6, 9, 8}});
  CHECK_THAT(overlap(twice), Contains("2 pairs") && Contains("lies along"));
}

TEST_CASE("a part that reaches into another one is told with elements and place") {
  // A dam and a berm that share the ground; the upper left corner of the berm is where x says.
  const auto berm = [](double x) {
    return mesh_of(
        {{0, -1}, {8, -1}, {16, -1}, {0, 0}, {8, 0}, {16, 0}, {0, 8}, {8, 8}, {x, 6}, {16, 6}},
        {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 5, 8, 7}, {5, 6, 10, 9}});
  };
  CHECK(overlap(berm(9)).empty());
  CHECK_THAT(overlap(berm(8)), Contains("2 pairs of outer edges") && Contains("lies along"));
  CHECK_THAT(overlap(berm(5)), Contains("crosses") && Contains("element 40") &&
                                   Contains("element 30") && Contains("(8, 6) m") &&
                                   Contains("counts twice"));
  // Two towers on one ground; the right one leans, its corner is where x says.
  const auto towers = [](double x) {
    return mesh_of({{0, 0},
                    {4, 0},
                    {8, 0},
                    {12, 0},
                    {0, 1},
                    {4, 1},
                    {8, 1},
                    {12, 1},
                    {0, 5},
                    {4, 5},
                    {12, 6},
                    {x, 3}},
                   {{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {5, 6, 10, 9}, {7, 8, 11, 12}});
  };
  CHECK(overlap(towers(4.1)).empty());
  CHECK_THAT(overlap(towers(4.0)), Contains("2 pairs") && Contains("touches"));
  CHECK_THAT(overlap(towers(3.9)), Contains("2 pairs") && Contains("crosses"));
}

TEST_CASE("elements on the same side of an edge are told") {
  const QuadMesh mesh =
      mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.2, 2}, {-0.2, 2}}, {{1, 2, 3, 4}, {1, 2, 5, 6}});
  CHECK_THAT(overlap(mesh), Contains("elements 10 and 20 lie on the same side") &&
                                Contains("from node 1 to 2 at (0, 0) m"));
}

TEST_CASE("sections that only look tight do not lie over themselves") {
  SECTION("elements that share one node") {
    CHECK(overlap(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}},
                          {{1, 2, 3, 4}, {3, 5, 6, 7}}))
              .empty());
  }
  SECTION("a layer far thinner than long, and its feathered end") {
    CHECK(overlap(mesh_of({{0, 0}, {100, 0}, {200, 0}, {0, 0.05}, {100, 0.05}, {200, 0.0001}},
                          {{1, 2, 5, 4}, {2, 3, 6, 5}}))
              .empty());
  }
  SECTION("a slot of 2 cm between blocks of 4 m") {
    CHECK(
        overlap(mesh_of({{0, 0},
                         {4, 0},
                         {4.02, 0},
                         {8, 0},
                         {0, 4},
                         {4, 4},
                         {4.02, 4},
                         {8, 4},
                         {0, 8},
                         {4, 8},
                         {4.02, 8},
                         {8, 8}},
                        {{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {5, 6, 10, 9}, {7, 8, 12, 11}}))
            .empty());
  }
  SECTION("far from the origin, sides along both axes") {
    const double x = 5e5, y = 4e6;
    CHECK(overlap(
              mesh_of({{x, y}, {x + 1, y}, {x + 2, y}, {x, y + 1}, {x + 1, y + 1}, {x + 2, y + 1}},
                      {{1, 2, 5, 4}, {2, 3, 6, 5}}))
              .empty());
  }
}

TEST_CASE("of parts that a model may tie to each other only soil on soil is told") {
  // A seam whose sides have other nodes, as it is and with digits that a file left out.
  for (const double y : {1.0, 1.0002, 0.9998}) {
    CHECK_FALSE(overlap(on_ground({1, y})).empty());
    CHECK(soil_on_soil(on_ground({1, y})).empty());
  }
  // Well within the ground, where no edges cross, as they share the nodes at their ends.
  for (const std::string& text : {overlap(on_ground({1, 0.9})), soil_on_soil(on_ground({1, 0.9}))})
    CHECK_THAT(text,
               Contains("elements 10 and 30 share node 3 and lie over each other at (2, 1) m"));
  // Two blocks one upon the other with nodes of their own, and one lying on the other.
  const auto blocks = [](double y) {
    return mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, y}, {1, y}, {1, y + 1}, {0, y + 1}},
                   {{1, 2, 3, 4}, {5, 6, 7, 8}});
  };
  CHECK(soil_on_soil(blocks(1)).empty());
  CHECK_THAT(overlap(blocks(1)), Contains("lies along"));
  CHECK_THAT(soil_on_soil(blocks(0)), Contains("4 pairs") && Contains("lies along"));
  CHECK_FALSE(soil_on_soil(blocks(0.5)).empty());
  CHECK_THAT(soil_on_soil(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.2, 2}, {-0.2, 2}},
                                  {{1, 2, 3, 4}, {1, 2, 5, 6}})),
             Contains("elements 10 and 20 lie on the same side"));
}
