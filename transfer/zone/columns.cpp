#include "transfer/zone/columns.hpp"

#include "core/check.hpp"
#include "core/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

double median_width(const QuadMesh& mesh, std::span<const std::int32_t> elements) {
  std::vector<double> widths;
  for (const std::int32_t e : elements) {
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, static_cast<std::size_t>(e));
    const auto [low, high] = std::minmax({quad[0][0], quad[1][0], quad[2][0], quad[3][0]});
    widths.push_back(high - low);
  }
  return median(std::move(widths));
}

}  // namespace

std::vector<std::int32_t> nodes_of(const QuadMesh& mesh, std::span<const std::int32_t> elements) {
  std::vector<std::int32_t> nodes;
  for (const std::int32_t e : elements) {
    for (const std::int32_t n : mesh.elements[static_cast<std::size_t>(e)]) nodes.push_back(n);
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

NodeNeighbours soil_neighbours(const QuadMesh& mesh, std::span<const std::int32_t> elements) {
  NodeNeighbours adjacent(mesh.num_nodes());
  for (const std::int32_t e : elements) {
    for (const std::int32_t a : mesh.elements[static_cast<std::size_t>(e)]) {
      for (const std::int32_t b : mesh.elements[static_cast<std::size_t>(e)]) {
        if (a != b) adjacent[static_cast<std::size_t>(a)].push_back(b);
      }
    }
  }
  for (std::vector<std::int32_t>& nodes : adjacent) {
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return adjacent;
}

std::vector<std::uint8_t> confirmed_nodes(const NodeNeighbours& adjacent,
                                          std::span<const double> r_u, double threshold,
                                          int neighbours) {
  FLOWSLIDE_EXPECT(adjacent.size() == r_u.size());
  std::vector<std::uint8_t> result(r_u.size());
  for (std::size_t n = 0; n < r_u.size(); ++n) {
    if (!(r_u[n] > threshold)) continue;
    const auto above = [&](std::int32_t b) { return r_u[static_cast<std::size_t>(b)] > threshold; };
    result[n] = std::ranges::count_if(adjacent[n], above) >= neighbours;
  }
  return result;
}

std::vector<SoilColumn> soil_columns(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                     std::optional<double> width) {
  FLOWSLIDE_EXPECT(!elements.empty());
  const double w = width.value_or(median_width(mesh, elements));
  const std::vector<std::int32_t> nodes = nodes_of(mesh, elements);
  const auto place = [&mesh](std::int32_t n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  for (const std::int32_t n : nodes) {
    left = std::min(left, place(n)[0]);
    right = std::max(right, place(n)[0]);
  }
  validate((right - left) / w < 1e6,
           "columns.width {} m cuts the liquefiable soil into {:.0f} columns (that many cannot be "
           "meant) choose about the element size",
           w, (right - left) / w);
  // Columns are centred on the first node and multiples of the width, so that the nodes of a
  // regular mesh do not lie on their edges.
  std::vector<SoilColumn> columns(static_cast<std::size_t>(std::lround((right - left) / w)) + 1);
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k].x = left + static_cast<double>(k) * w;
  for (const std::int32_t n : nodes)
    columns[static_cast<std::size_t>(std::lround((place(n)[0] - left) / w))].nodes.push_back(n);
  std::erase_if(columns, [](const SoilColumn& c) { return c.nodes.empty(); });
  for (SoilColumn& c : columns)
    std::ranges::stable_sort(c.nodes, {}, [&place](std::int32_t n) { return place(n)[1]; });
  return columns;
}

std::optional<double> liquefied_bottom(const SoilColumn& column, std::span<const Vec2> positions,
                                       std::span<const double> r_u,
                                       std::span<const std::uint8_t> counted, double threshold) {
  for (std::size_t i = 0; i < column.nodes.size(); ++i) {
    const auto n = static_cast<std::size_t>(column.nodes[i]);
    if (!counted[n]) continue;
    const double y = positions[n][1];
    if (i == 0) return y;
    const auto below = static_cast<std::size_t>(column.nodes[i - 1]);
    if (!(r_u[below] <= threshold)) return y;
    const double share = (r_u[n] - threshold) / (r_u[n] - r_u[below]);
    return y + share * (positions[below][1] - y);
  }
  return std::nullopt;
}

}  // namespace flowslide
