#include "importers/mesh_edit.hpp"

#include "core/check.hpp"

#include <limits>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Three elements in a row, x 0..3, the last one of another soil; its base as a set.
SectionMesh row() {
  SectionMesh s;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) {
      s.mesh.nodes.push_back({1.0 * i, 2.0 * j + (i == 3 ? 0.5 * j : 0.0)});
      s.mesh.node_tags.push_back(10 * (4 * j + i));
    }
  for (int i = 0; i < 3; ++i) {
    s.mesh.elements.push_back({i, i + 1, i + 5, i + 4});
    s.mesh.element_tags.push_back(100 + i);
    s.mesh.element_material.push_back(i < 2 ? 1 : 2);
  }
  s.materials = {{"sand", 1}, {"clay", 2}};
  s.sets = {{"below", {{0, 1}, {1, 2}, {2, 3}}}, {"end", {{3, 7}}}};
  return s;
}

double area(const QuadMesh& m) {
  double sum = 0.0;
  for (std::size_t e = 0; e < m.num_elements(); ++e) {
    const auto q = corners(m, m.nodes, e);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &a = q[i], &b = q[(i + 1) % 4];
      sum += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("What lies beyond left and right is left out with its nodes, edges and soil") {
  SectionMesh s = row();
  keep_between(s, 0.0, 2.0);
  check(s);
  CHECK(s.mesh.num_elements() == 2);
  CHECK(s.mesh.node_tags == std::vector<std::int64_t>{0, 10, 20, 40, 50, 60});
  CHECK(s.mesh.element_tags == std::vector<std::int64_t>{100, 101});
  REQUIRE(s.materials.size() == 1);
  CHECK(s.materials[0].name == "sand");
  REQUIRE(s.sets.size() == 1);
  CHECK(s.sets[0].edges.size() == 2);
  CHECK(s.notes.size() == 1);

  SectionMesh all = row();
  keep_between(all, -1.0, 3.0);
  CHECK(all.mesh.num_elements() == 3);
  CHECK(all.notes.empty());
  CHECK_THROWS_AS(keep_between(all, 0.5, 1.5), InputError);
}

TEST_CASE("An element divided in four covers the same ground with edges that still meet") {
  SectionMesh s = row();
  const double before = area(s.mesh);
  divide_in_four(s);
  check(s);
  CHECK(s.mesh.num_elements() == 12);
  CHECK(s.mesh.num_nodes() == 7 * 3);  // a conforming mesh has no node twice
  CHECK(area(s.mesh) == Approx(before));
  CHECK(s.mesh.element_material[7] == 1);
  CHECK(s.mesh.element_material[8] == 2);
  CHECK(s.sets[0].edges.size() == 6);
  CHECK(s.sets[1].edges.size() == 2);
  CHECK(s.mesh.nodes[s.sets[1].edges[0][1]][1] == Approx(1.25));
}

TEST_CASE("A division that would fill the memory or run out of numbers is refused") {
  SectionMesh many = row();
  many.mesh.elements.resize(500'001, many.mesh.elements[0]);
  CHECK_THROWS_AS(divide_in_four(many), InputError);
  SectionMesh large = row();
  large.mesh.node_tags[0] = std::numeric_limits<std::int64_t>::max();
  CHECK_THROWS_AS(divide_in_four(large), InputError);
}
