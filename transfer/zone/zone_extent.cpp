#include "transfer/zone/zone_extent.hpp"

#include "core/check.hpp"
#include "model/outline.hpp"
#include "transfer/zone/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

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
  if (!shape.polygon.empty())
    return on_outline(shape.polygon, point) || inside_outline(shape.polygon, point);
  return point[1] >= height_on(shape.lower_boundary, point[0]);
}

std::vector<Vec2> column_boundary(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                  std::span<const double> r_u, double threshold,
                                  const ColumnConfig& config) {
  FLOWSLIDE_EXPECT(r_u.size() == mesh.num_nodes());
  const std::vector<std::uint8_t> counted =
      confirmed_nodes(soil_neighbours(mesh, elements), r_u, threshold, config.neighbours);
  std::vector<Vec2> line;
  for (const SoilColumn& column : soil_columns(mesh, elements, config.width)) {
    const double top = mesh.nodes[static_cast<std::size_t>(column.nodes.back())][1];
    const auto lowest = std::ranges::find_if(column.nodes, [&counted](std::int32_t n) {
      return counted[static_cast<std::size_t>(n)] != 0;
    });
    double y = top;
    if (config.interpolate)
      y = liquefied_bottom(column, mesh.nodes, r_u, counted, threshold).value_or(top);
    else if (lowest != column.nodes.end())
      y = mesh.nodes[static_cast<std::size_t>(*lowest)][1];
    line.push_back({column.x, y});
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
                          {config.columns.width, 0, false});
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
