#pragma once
#include "model/mesh.hpp"

namespace flowslide {

/// nx by ny rectangles of size dx by dy with the lower left corner at (0, 0), one material.
/// Node (i, j) has index j (nx + 1) + i and tag 1 + index.
inline QuadMesh rectangle_mesh(int nx, int ny, double dx, double dy, std::int32_t material) {
  QuadMesh mesh;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      mesh.nodes.push_back({i * dx, j * dy});
      mesh.node_tags.push_back(static_cast<std::int64_t>(mesh.nodes.size()));
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int n = j * (nx + 1) + i;
      mesh.elements.push_back({n, n + 1, n + nx + 2, n + nx + 1});
      mesh.element_tags.push_back(static_cast<std::int64_t>(mesh.elements.size()));
      mesh.element_material.push_back(material);
    }
  }
  return mesh;
}

inline std::vector<std::int32_t> all_elements(const QuadMesh& mesh) {
  std::vector<std::int32_t> elements;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    elements.push_back(static_cast<std::int32_t>(e));
  }
  return elements;
}

}  // namespace flowslide
