#include "report/section_lines.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <map>

namespace flowslide {

Table outline_segments(const QuadMesh& mesh) {
  struct Edge {
    std::int32_t material;
    int elements = 0;
    bool interface = false;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Edge> edges;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    for (int k = 0; k < 4; ++k) {
      const auto ends = std::minmax(mesh.elements[e][k], mesh.elements[e][(k + 1) % 4]);
      Edge& edge = edges.try_emplace(ends, Edge{mesh.element_material[e]}).first->second;
      ++edge.elements;
      edge.interface |= edge.material != mesh.element_material[e];
    }
  Table table{.columns = 5, .values = {}};
  for (const auto& [ends, edge] : edges) {
    if (edge.elements > 1 && !edge.interface) continue;
    const Vec2& a = mesh.nodes[ends.first];
    const Vec2& b = mesh.nodes[ends.second];
    table.add({a[0], a[1], b[0], b[1], edge.elements == 1 ? 1.0 : 0.0});
  }
  return table;
}

Table pressure_contour(const QuadMesh& mesh, const std::vector<double>& pore_pressure,
                       double level) {
  FLOWSLIDE_EXPECT(pore_pressure.size() == mesh.num_nodes());
  Table table{.columns = 4, .values = {}};
  for (const auto& element : mesh.elements) {
    std::vector<Vec2> crossings;
    for (int k = 0; k < 4; ++k) {
      const std::int32_t a = element[k];
      const std::int32_t b = element[(k + 1) % 4];
      const double ua = pore_pressure[a] - level;
      const double ub = pore_pressure[b] - level;
      if ((ua > 0.0) == (ub > 0.0)) continue;
      const double s = ua / (ua - ub);
      crossings.push_back({mesh.nodes[a][0] + s * (mesh.nodes[b][0] - mesh.nodes[a][0]),
                           mesh.nodes[a][1] + s * (mesh.nodes[b][1] - mesh.nodes[a][1])});
    }
    if (crossings.size() == 2)
      table.add({crossings[0][0], crossings[0][1], crossings[1][0], crossings[1][1]});
  }
  return table;
}

}  // namespace flowslide
