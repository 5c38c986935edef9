#include "model/section_mesh.hpp"

#include "core/check.hpp"
#include "model/motion_file.hpp"
#include "tests/model/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

SectionMesh two_cells() {
  SectionMesh s;
  s.mesh.nodes = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1.0 / 3.0}};
  s.mesh.node_tags = {1, 2, 3, 4, 5, 6};
  s.mesh.elements = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  s.mesh.element_tags = {1, 2};
  s.mesh.element_material = {7, 168};
  s.materials = {{"sand", 7}, {"tailings", 168}};
  s.sets = {{"base", {{0, 1}, {1, 2}}}, {"drain", {{4, 1}}}};
  s.notes = {"coarse"};
  return s;
}

}  // namespace

TEST_CASE("a section mesh comes back from its file") {
  const Scratch scratch;
  const SectionMesh s = two_cells();
  write_section_mesh(scratch / "mesh.h5", s);
  const SectionMesh r = read_section_mesh(scratch / "mesh.h5");
  CHECK(r.mesh.nodes == s.mesh.nodes);
  CHECK(r.mesh.elements == s.mesh.elements);
  CHECK(material_tag(r, "tailings") == 168);
  CHECK(find_set(r, "drain").edges == s.sets[1].edges);
  CHECK(nodes_of(find_set(r, "base")) == std::vector<std::int32_t>{0, 1, 2});
  CHECK(r.notes == s.notes);
  CHECK_THROWS_WITH(find_set(r, "pond"), Contains("known: base, drain"));
  CHECK_THROWS_WITH(material_tag(r, "clay"), Contains("known: sand, tailings"));
}

TEST_CASE("a section mesh that contradicts itself is refused") {
  SectionMesh s = two_cells();
  s.sets[1].edges = {{0, 5}};
  CHECK_THROWS_WITH(check(s), Contains("set 'drain' joins the node indices 0 and 5"));
  s = two_cells();
  s.materials.pop_back();
  CHECK_THROWS_WITH(check(s), Contains("element 2 has the material tag 168, which has no name"));
  s = two_cells();
  s.sets[1].name = "base";
  CHECK_THROWS_WITH(check(s), Contains("two sets 'base'"));
}

TEST_CASE("a motion comes back from its file") {
  const Scratch scratch;
  const GroundMotion m{.dt = 0.01, .acceleration = {0.0, 1.0 / 3.0, -2.0}, .origin = "by hand"};
  write_motion_file(scratch / "motion.h5", m);
  const GroundMotion r = read_motion_file(scratch / "motion.h5");
  CHECK(r.dt == m.dt);
  CHECK(r.acceleration == m.acceleration);
  CHECK(r.origin == m.origin);
  CHECK_THROWS_AS(write_motion_file(scratch / "no.h5", GroundMotion{}), InputError);
  CHECK_THROWS_WITH(read_section_mesh(scratch / "motion.h5"), Contains("motion"));
}
