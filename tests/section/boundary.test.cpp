#include "section/boundary.hpp"

#include "core/check.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

using Edges = std::vector<std::array<std::int32_t, 2>>;

/// Two rows of three unit squares, nodes by rows from below, with a set of the file. The upper
/// right corner is moved by `slant`, so that the right end is not vertical.
SectionMesh with_set(const std::string& name, Edges edges, double slant = 0.0) {
  SectionMesh s;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      s.mesh.nodes.push_back({1.0 * i, 1.0 * j});
      s.mesh.node_tags.push_back(100 + 4 * j + i);
    }
  s.mesh.nodes[11][0] += slant;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t n = 4 * j + i;
      s.mesh.elements.push_back({n, n + 1, n + 5, n + 4});
      s.mesh.element_tags.push_back(n);
      s.mesh.element_material.push_back(1);
    }
  s.materials = {{"sand", 1}};
  if (!name.empty()) s.sets = {{name, std::move(edges)}};
  check(s);
  return s;
}

const Edges kBase{{0, 1}, {1, 2}, {2, 3}};

}  // namespace

TEST_CASE("a set of the file that is the side of its name is that side") {
  SectionMesh found = with_set("", {});
  add_outer_sets(found);
  CHECK(find_set(found, "base").edges == kBase);
  CHECK(found.notes.empty());
  // In another order, one edge turned.
  SectionMesh given = with_set("base", {{1, 2}, {1, 0}, {2, 3}});
  add_outer_sets(given);
  CHECK(find_set(given, "base").edges == kBase);
  CHECK(given.notes.empty());
  CHECK(given.sets.size() == 4);
}

TEST_CASE("a set of the file that is part of the side of its name is told with both lengths") {
  SectionMesh part = with_set("base", {{0, 1}, {2, 1}});
  add_outer_sets(part);
  CHECK(find_set(part, "base").edges == Edges{{0, 1}, {1, 2}});
  REQUIRE(part.notes.size() == 1);
  CHECK_THAT(part.notes[0], Contains("set 'base' of the file is 2 m long") &&
                                Contains("that is found 3 m") && Contains("2 m in common"));
  // The side and one edge of the right end.
  SectionMesh more = with_set("base", {{0, 1}, {1, 2}, {2, 3}, {3, 7}});
  add_outer_sets(more);
  REQUIRE(more.notes.size() == 1);
  CHECK_THAT(more.notes[0], Contains("is 4 m long") && Contains("3 m in common"));
}

TEST_CASE("a set of the file that cannot be the side of its name is refused") {
  SectionMesh inner = with_set("base", {{4, 5}, {5, 6}, {6, 7}});
  CHECK_THROWS_WITH(add_outer_sets(inner),
                    Contains("set 'base' of the file: 3 of its 3 edges lie inside the section") &&
                        Contains("(0, 1) to (1, 1) m"));
  SectionMesh on_top = with_set("left", {{10, 9}});
  CHECK_THROWS_WITH(add_outer_sets(on_top), Contains("set 'left' of the file lies elsewhere") &&
                                                Contains("(2, 2) to (1, 2) m"));
  // Another name may lie wherever it likes.
  SectionMesh drain = with_set("drain", {{4, 5}, {5, 6}});
  add_outer_sets(drain);
  CHECK(drain.notes.empty());
}

TEST_CASE("a section without vertical ends takes its sides from the file") {
  SectionMesh s = with_set("base", kBase, 0.5);
  add_outer_sets(s);
  REQUIRE(s.notes.size() == 1);
  CHECK_THAT(s.notes[0], Contains("no vertical ends, so there are no sets right, surface, left"));

  SectionMesh all = with_set("base", kBase, 0.5);
  all.sets.push_back({"right", {{3, 7}, {7, 11}}});
  all.sets.push_back({"surface", {{11, 10}, {10, 9}, {9, 8}}});
  all.sets.push_back({"left", {{8, 4}, {4, 0}}});
  SectionMesh open = all;
  add_outer_sets(all);
  CHECK(all.notes.empty());
  open.sets[0].edges.pop_back();
  open.sets[3].edges.push_back({9, 8});
  add_outer_sets(open);
  REQUIRE(open.notes.size() == 1);
  CHECK_THAT(open.notes[0], Contains("leave out 1 m") && Contains("1 m are in two of them"));

  SectionMesh inner = with_set("left", {{1, 5}}, 0.5);
  CHECK_THROWS_WITH(add_outer_sets(inner), Contains("1 of its 1 edges lie inside"));
}
