#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace flowslide {

using Vec2 = std::array<double, 2>;

/// Mesh of four-node quadrilaterals. Indices are positions in these arrays; the numbers that the
/// source program used are kept as tags for messages and for recorders.
struct QuadMesh {
  std::vector<Vec2> nodes;                            ///< reference coordinates [m]
  std::vector<std::int64_t> node_tags;                ///< unique, one per node
  std::vector<std::array<std::int32_t, 4>> elements;  ///< node indices, counter-clockwise
  std::vector<std::int64_t> element_tags;             ///< unique, one per element
  std::vector<std::int32_t> element_material;         ///< material tag of the source program

  [[nodiscard]] std::size_t num_nodes() const { return nodes.size(); }
  [[nodiscard]] std::size_t num_elements() const { return elements.size(); }
};

/// Corner coordinates of element e at the given nodal positions (size num_nodes) [m].
std::array<Vec2, 4> corners(const QuadMesh& mesh, const std::vector<Vec2>& positions,
                            std::size_t e);

/// Signed area of a quadrilateral, positive if counter-clockwise [m2].
double area(const std::array<Vec2, 4>& quad);

/// Mean of the four corners [m].
Vec2 centroid(const std::array<Vec2, 4>& quad);

/// Checks indices, unique tags and positive Jacobians at all corners; throws InputError naming the
/// tags of the element and node.
void check(const QuadMesh& mesh);

}  // namespace flowslide
