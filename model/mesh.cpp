#include "model/mesh.hpp"

#include "core/check.hpp"

#include <cmath>
#include <unordered_set>

namespace flowslide {
namespace {

double cross(Vec2 a, Vec2 b, Vec2 c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

void check_mesh_lengths(const QuadMesh& mesh) {
  validate(!mesh.nodes.empty() && !mesh.elements.empty(),
           "the mesh has {} nodes and {} elements (nothing to compute on); check which files were "
           "read",
           mesh.num_nodes(), mesh.num_elements());
  validate(mesh.node_tags.size() == mesh.num_nodes(), "the mesh has {} nodes but {} node tags",
           mesh.num_nodes(), mesh.node_tags.size());
  validate(mesh.element_tags.size() == mesh.num_elements() &&
               mesh.element_material.size() == mesh.num_elements(),
           "the mesh has {} elements but {} element tags and {} material tags", mesh.num_elements(),
           mesh.element_tags.size(), mesh.element_material.size());
}

void check_unique(const std::vector<std::int64_t>& tags, const char* what) {
  std::unordered_set<std::int64_t> seen;
  seen.reserve(tags.size());
  for (std::int64_t tag : tags)
    validate(seen.insert(tag).second,
             "{} tag {} occurs twice (recorders could not tell the two apart); give each {} its "
             "own tag",
             what, tag, what);
}

}  // namespace

std::array<Vec2, 4> corners(const QuadMesh& mesh, const std::vector<Vec2>& positions,
                            std::size_t e) {
  FLOWSLIDE_EXPECT(positions.size() == mesh.num_nodes());
  const std::array<std::int32_t, 4>& n = mesh.elements[e];
  return {positions[n[0]], positions[n[1]], positions[n[2]], positions[n[3]]};
}

double area(const std::array<Vec2, 4>& quad) {
  return 0.5 * ((quad[2][0] - quad[0][0]) * (quad[3][1] - quad[1][1]) -
                (quad[3][0] - quad[1][0]) * (quad[2][1] - quad[0][1]));
}

Vec2 centroid(const std::array<Vec2, 4>& quad) {
  return {0.25 * (quad[0][0] + quad[1][0] + quad[2][0] + quad[3][0]),
          0.25 * (quad[0][1] + quad[1][1] + quad[2][1] + quad[3][1])};
}

void check(const QuadMesh& mesh) {
  check_mesh_lengths(mesh);
  check_unique(mesh.node_tags, "node");
  check_unique(mesh.element_tags, "element");
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i)
    validate(std::isfinite(mesh.nodes[i][0]) && std::isfinite(mesh.nodes[i][1]),
             "node {} has coordinates ({}, {}) (not finite)", mesh.node_tags[i], mesh.nodes[i][0],
             mesh.nodes[i][1]);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const std::int64_t tag = mesh.element_tags[e];
    for (std::int32_t n : mesh.elements[e])
      validate(n >= 0 && static_cast<std::size_t>(n) < mesh.num_nodes(),
               "element {} refers to node index {} (the mesh has {} nodes)", tag, n,
               mesh.num_nodes());
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    for (std::size_t k = 0; k < 4; ++k)
      validate(cross(quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4]) > 0.0,
               "element {} has no positive Jacobian at node {} (clockwise numbering, a corner of "
               "180 degrees or more, or two nodes at one place); list its nodes counter-clockwise "
               "or repair the mesh",
               tag, mesh.node_tags[mesh.elements[e][k]]);
  }
}

}  // namespace flowslide
