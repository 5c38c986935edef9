#include "report/section_lines.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
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

namespace {

/// A vertical line through a mesh, cut at the edges of the elements.
struct Cut {
  double y, pressure;
};

/// Where a line at x crosses the edges of an element; level edges add both ends.
void cut_element(const QuadMesh& mesh, const std::vector<double>& pressure, std::size_t e, double x,
                 std::vector<Cut>& cuts) {
  for (int k = 0; k < 4; ++k) {
    const std::int32_t i = mesh.elements[e][k];
    const std::int32_t j = mesh.elements[e][(k + 1) % 4];
    const Vec2& a = mesh.nodes[i];
    const Vec2& b = mesh.nodes[j];
    if (a[0] == b[0] || (a[0] < x) == (b[0] < x)) continue;
    const double s = (x - a[0]) / (b[0] - a[0]);
    cuts.push_back({a[1] + s * (b[1] - a[1]), pressure[i] + s * (pressure[j] - pressure[i])});
  }
}

/// y of the surface of the water on one line, highest cut first; unset if all is dry.
double surface_of(const std::vector<Cut>& cuts) {
  constexpr double dry = 1.0e3;      // [Pa]
  constexpr double weight = 9.81e3;  // of water [N/m3]
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (!(cuts[k].pressure > dry)) continue;
    const double still = cuts[k].y + cuts[k].pressure / weight;
    return k == 0 ? still : std::min(still, cuts[k - 1].y);
  }
  return kUnset;
}

}  // namespace

namespace {

/// Mean of five neighbours, fewer at ends: edges of elements must not show in still water.
void smooth_surface(Table& table) {
  const std::size_t rows = table.rows();
  const std::vector<double> raw = table.values;
  for (std::size_t r = 0; r < rows; ++r) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = r < 2 ? 0 : r - 2; k < std::min(rows, r + 3); ++k)
      if (is_set(raw[3 * k + 1])) sum += raw[3 * k + 1], ++count;
    if (is_set(raw[3 * r + 1])) table.values[3 * r + 1] = sum / count;
  }
}

}  // namespace

Table water_surface(const QuadMesh& mesh, const std::vector<double>& pore_pressure) {
  FLOWSLIDE_EXPECT(pore_pressure.size() == mesh.num_nodes());
  Table table{.columns = 3, .values = {}};
  if (mesh.num_elements() == 0) return table;
  const auto [left, right] = std::minmax_element(mesh.nodes.begin(), mesh.nodes.end());
  const double low = (*left)[0], width = (*right)[0] - low;
  double mean = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) mean += area(corners(mesh, mesh.nodes, e));
  mean = std::sqrt(mean / static_cast<double>(mesh.num_elements()));
  const auto lines = static_cast<std::size_t>(std::clamp(2.0 * width / mean, 8.0, 1000.0));
  const double step = width / static_cast<double>(lines);
  std::vector<std::vector<Cut>> cuts(lines);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const auto quad = corners(mesh, mesh.nodes, e);
    const auto [from, to] = std::minmax_element(quad.begin(), quad.end());
    for (auto k = static_cast<std::size_t>(((*from)[0] - low) / step); k < lines; ++k) {
      const double x = low + (static_cast<double>(k) + 0.5) * step;
      if (x > (*to)[0]) break;
      if (x >= (*from)[0]) cut_element(mesh, pore_pressure, e, x, cuts[k]);
    }
  }
  for (std::size_t k = 0; k < lines; ++k) {
    std::sort(cuts[k].begin(), cuts[k].end(), [](const Cut& a, const Cut& b) { return a.y > b.y; });
    if (!cuts[k].empty())
      table.add({low + (static_cast<double>(k) + 0.5) * step, surface_of(cuts[k]), cuts[k][0].y});
  }
  smooth_surface(table);
  return table;
}

}  // namespace flowslide
