#include "transfer/zone/zone_extent.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

bool inside(std::span<const Vec2> polygon, Vec2 p) {
  bool odd = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[j];
    const double cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    const double along = (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]);
    if (cross == 0.0 && along <= 0.0) return true;
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) odd = !odd;
  }
  return odd;
}

/// The chain of corners from the leftmost to the rightmost one that runs below the other.
std::vector<Vec2> lower_chain(std::span<const Vec2> polygon) {
  const auto lower_first = [](Vec2 a, Vec2 b) { return a < b; };
  const auto lower_last = [](Vec2 a, Vec2 b) { return Vec2{a[0], -a[1]} < Vec2{b[0], -b[1]}; };
  const auto left = std::ranges::min_element(polygon, lower_first) - polygon.begin();
  const auto right = std::ranges::max_element(polygon, lower_last) - polygon.begin();
  const auto n = static_cast<std::ptrdiff_t>(polygon.size());
  std::vector<Vec2> best;
  double least = kInf;
  for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, n - 1}) {
    std::vector<Vec2> chain;
    double below = 0.0;  // integral of y along x
    for (std::ptrdiff_t i = left;; i = (i + step) % n) {
      const Vec2 p = polygon[static_cast<std::size_t>(i)];
      if (!chain.empty()) below += 0.5 * (p[1] + chain.back()[1]) * (p[0] - chain.back()[0]);
      chain.push_back(p);
      if (i == right) break;
    }
    if (below < least) {
      least = below;
      best = std::move(chain);
    }
  }
  return best;
}

std::vector<Vec2> points(const std::vector<std::vector<double>>& rows) {
  std::vector<Vec2> result;
  for (const std::vector<double>& row : rows) result.push_back({row[0], row[1]});
  return result;
}

double median_width(const QuadMesh& mesh, std::span<const std::int32_t> elements) {
  std::vector<double> widths;
  for (const std::int32_t e : elements) {
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, static_cast<std::size_t>(e));
    const auto [low, high] = std::minmax({quad[0][0], quad[1][0], quad[2][0], quad[3][0]});
    widths.push_back(high - low);
  }
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::ranges::nth_element(widths, middle);
  return *middle;
}

std::vector<std::int32_t> nodes_of(const QuadMesh& mesh, std::span<const std::int32_t> elements) {
  std::vector<std::int32_t> nodes;
  for (const std::int32_t e : elements) {
    for (const std::int32_t n : mesh.elements[static_cast<std::size_t>(e)]) nodes.push_back(n);
  }
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  return nodes;
}

/// Nodes above the threshold that enough of their mesh neighbours confirm.
std::vector<std::uint8_t> confirmed(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                    std::span<const double> r_u, double threshold, int neighbours) {
  std::vector<std::vector<std::int32_t>> adjacent(mesh.num_nodes());
  for (const std::int32_t e : elements) {
    for (const std::int32_t a : mesh.elements[static_cast<std::size_t>(e)]) {
      for (const std::int32_t b : mesh.elements[static_cast<std::size_t>(e)]) {
        if (a != b && r_u[static_cast<std::size_t>(b)] > threshold) {
          adjacent[static_cast<std::size_t>(a)].push_back(b);
        }
      }
    }
  }
  std::vector<std::uint8_t> result(mesh.num_nodes());
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    std::ranges::sort(adjacent[n]);
    const auto end = std::ranges::unique(adjacent[n]).begin();
    result[n] = r_u[n] > threshold && end - adjacent[n].begin() >= neighbours;
  }
  return result;
}

}  // namespace

double height_on(std::span<const Vec2> line, double x) {
  FLOWSLIDE_EXPECT(!line.empty());
  if (line.size() == 1 || x <= line[0][0]) return line[0][1];
  std::size_t i = 1;
  while (i + 1 < line.size() && x > line[i][0]) ++i;
  const double share = (x - line[i - 1][0]) / (line[i][0] - line[i - 1][0]);
  return line[i - 1][1] + share * (line[i][1] - line[i - 1][1]);
}

bool contains(const ZoneShape& shape, Vec2 point) {
  if (!shape.polygon.empty()) return inside(shape.polygon, point);
  return point[1] >= height_on(shape.lower_boundary, point[0]);
}

std::vector<Vec2> column_boundary(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                  std::span<const double> r_u, double threshold,
                                  const ColumnConfig& config) {
  FLOWSLIDE_EXPECT(!elements.empty() && r_u.size() == mesh.num_nodes());
  const double width = config.width.value_or(median_width(mesh, elements));
  const std::vector<std::int32_t> nodes = nodes_of(mesh, elements);
  const std::vector<std::uint8_t> liquefied =
      confirmed(mesh, elements, r_u, threshold, config.neighbours);
  double left = kInf;
  double right = -kInf;
  for (const std::int32_t n : nodes) {
    left = std::min(left, mesh.nodes[static_cast<std::size_t>(n)][0]);
    right = std::max(right, mesh.nodes[static_cast<std::size_t>(n)][0]);
  }
  validate((right - left) / width < 1e6,
           "columns.width {} m cuts the liquefiable soil into {:.0f} columns (that many cannot be "
           "meant) choose about the element size",
           width, (right - left) / width);
  // Columns are centred on the first node and multiples of the width, so that the nodes of a
  // regular mesh do not lie on their edges.
  const auto count = static_cast<std::size_t>(std::lround((right - left) / width)) + 1;
  std::vector<double> lowest(count, kInf);
  std::vector<double> top(count, -kInf);
  for (const std::int32_t node : nodes) {
    const auto n = static_cast<std::size_t>(node);
    const auto k = static_cast<std::size_t>(std::lround((mesh.nodes[n][0] - left) / width));
    top[k] = std::max(top[k], mesh.nodes[n][1]);
    if (liquefied[n]) lowest[k] = std::min(lowest[k], mesh.nodes[n][1]);
  }
  std::vector<Vec2> line;
  for (std::size_t k = 0; k < count; ++k) {
    if (top[k] == -kInf) continue;  // no node: the line runs straight across
    line.push_back({left + static_cast<double>(k) * width, std::min(lowest[k], top[k])});
  }
  return line;
}

ZoneShape zone_shape(const ZoneConfig& config, const QuadMesh& mesh,
                     std::span<const std::int32_t> elements, std::span<const double> r_u) {
  ZoneShape shape;
  switch (config.zone) {
    case ZoneExtent::automatic:
    case ZoneExtent::liquefied:
      shape.lower_boundary =
          column_boundary(mesh, elements, r_u, config.r_u.threshold, config.columns);
      break;
    case ZoneExtent::all:
      // Everything has liquefied: the boundary is the bottom of the soil.
      shape.lower_boundary =
          column_boundary(mesh, elements, std::vector<double>(mesh.num_nodes(), 1.0), 0.5,
                          {config.columns.width, 0});
      break;
    case ZoneExtent::line:
      shape.lower_boundary = points(config.line);
      break;
    case ZoneExtent::polygon:
      shape.polygon = points(config.polygon);
      shape.lower_boundary = lower_chain(shape.polygon);
      break;
  }
  return shape;
}

}  // namespace flowslide
