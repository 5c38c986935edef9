#include "section/layout.hpp"

#include "core/check.hpp"
#include "section/layout_check.hpp"
#include "section/outline.hpp"
#include "section/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace flowslide {
namespace {

/// Share of the target size below which a distance is taken for an error of typing.
constexpr double kNearMiss = 0.05;

/// A point with the place where it was written, for messages.
struct NamedPoint {
  std::string owner;  ///< "block 'dam'"
  double size;        ///< target size there [m]
};

class PointList {
 public:
  PointList(Layout& layout, std::vector<NamedPoint>& origin) : layout_(layout), origin_(origin) {}

  int add(Vec2 p, const std::string& owner, double size) {
    for (std::size_t i = 0; i < layout_.points.size(); ++i) {
      const double d = distance(layout_.points[i], p);
      if (d <= layout_.tolerance) return static_cast<int>(i);
      const double least = kNearMiss * std::min(size, origin_[i].size);
      validate(d > least,
               "{}: its point ({}, {}) lies {:.3g} m from the point ({}, {}) of {} (that leaves a "
               "gap, an overlap or an element of that width). Write the same coordinates, or move "
               "them {:.3g} m apart",
               owner, p[0], p[1], d, layout_.points[i][0], layout_.points[i][1], origin_[i].owner,
               least);
    }
    layout_.points.push_back(p);
    origin_.push_back({owner, size});
    return static_cast<int>(layout_.points.size()) - 1;
  }

 private:
  Layout& layout_;
  std::vector<NamedPoint>& origin_;
};

double extent(const SectionConfig& config) {
  double lo[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double hi[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (const auto& [name, block] : config.blocks)
    for (const auto& row : block.outline)
      for (int k = 0; k < 2; ++k) {
        lo[k] = std::min(lo[k], row[k]);
        hi[k] = std::max(hi[k], row[k]);
      }
  return std::max(hi[0] - lo[0], hi[1] - lo[1]);
}

/// Points strictly between a and b, from a to b.
std::vector<int> points_between(const Layout& layout, const std::vector<NamedPoint>& origin, int a,
                                int b, const std::string& owner, double size) {
  const Vec2 pa = layout.points[a], pb = layout.points[b];
  std::vector<std::pair<double, int>> found;
  for (int i = 0; i < static_cast<int>(layout.points.size()); ++i) {
    if (i == a || i == b) continue;
    const Projection at = project(pa, pb, layout.points[i]);
    if (!(at.parameter > 0.0 && at.parameter < 1.0)) continue;
    if (at.distance <= layout.tolerance) {
      found.emplace_back(at.parameter, i);
      continue;
    }
    const double least = kNearMiss * std::min(size, origin[i].size);
    validate(at.distance > least,
             "{}: its side ({}, {})-({}, {}) passes the point ({}, {}) of {} at {:.3g} m (that "
             "leaves a gap or an overlap of that width). Put the point onto the side, or {:.3g} m "
             "away",
             owner, pa[0], pa[1], pb[0], pb[1], layout.points[i][0], layout.points[i][1],
             origin[i].owner, at.distance, least);
  }
  std::sort(found.begin(), found.end());
  std::vector<int> points;
  for (const auto& [t, i] : found) points.push_back(i);
  return points;
}

/// Points that nearly lie on a side: told before the overlaps and holes that they make.
void check_near_misses(const Layout& layout, const std::vector<NamedPoint>& origin,
                       const std::vector<std::vector<int>>& outlines, const SectionConfig& config) {
  for (std::size_t b = 0; b < outlines.size(); ++b) {
    const std::string& name = layout.blocks[b].name;
    for (std::size_t i = 0; i < outlines[b].size(); ++i) {
      const int from = outlines[b][i], to = outlines[b][(i + 1) % outlines[b].size()];
      const double x = 0.5 * (layout.points[from][0] + layout.points[to][0]);
      points_between(layout, origin, from, to, "block '" + name + "'",
                     size_in(config, config.blocks.at(name), x));
    }
  }
}

/// Length in target sizes: the integral of ds / h by the midpoint rule.
double length_in_sizes(const SectionConfig& config, const SectionBlock& block, Vec2 a, Vec2 b) {
  constexpr int kParts = 64;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i)
    sum += 1.0 / size_in(config, block, a[0] + (i + 0.5) / kParts * (b[0] - a[0]));
  return sum * distance(a, b) / kParts;
}

class SegmentList {
 public:
  SegmentList(Layout& layout, const SectionConfig& config) : layout_(layout), config_(config) {}

  DirectedSegment add(int from, int to, int block) {
    const auto [it, is_new] = index_.emplace(std::minmax(from, to), layout_.segments.size());
    if (is_new) {
      layout_.segments.push_back({.a = from, .b = to});
      layout_.segments.back().length = distance(layout_.points[from], layout_.points[to]);
    }
    Segment& s = layout_.segments[it->second];
    const bool forward = s.a == from;
    int& owner = forward ? s.left : s.right;
    if (owner >= 0)
      throw InputError(fmt::format(
          "blocks '{}' and '{}' lie on the same side of their common edge ({}, {})-({}, {}) (they "
          "overlap). Correct the outline of one",
          layout_.blocks[owner].name, layout_.blocks[block].name, layout_.points[from][0],
          layout_.points[from][1], layout_.points[to][0], layout_.points[to][1]));
    owner = block;
    const SectionBlock& b = config_.blocks.at(layout_.blocks[block].name);
    s.elements =
        std::max(s.elements, length_in_sizes(config_, b, layout_.points[from], layout_.points[to]));
    return {static_cast<int>(it->second), forward};
  }

 private:
  Layout& layout_;
  const SectionConfig& config_;
  std::map<std::pair<int, int>, std::size_t> index_;
};

/// Points of the outline of a block as indices, then its sides as segments.
void add_sides(Layout& layout, SegmentList& segments, const std::vector<NamedPoint>& origin,
               const std::vector<int>& outline, const SectionConfig& config, int block) {
  LayoutBlock& b = layout.blocks[block];
  const SectionBlock& settings = config.blocks.at(b.name);
  const std::vector<int> corners = corners_of(settings);
  const int n = static_cast<int>(outline.size());
  const std::string owner = "block '" + b.name + "'";
  for (int side = 0; side < 4; ++side) {
    b.corner[side] = outline[corners[side]];
    const int first = corners[side];
    const int last = side == 3 ? corners[0] + n : corners[side + 1];
    for (int i = first; i < last; ++i) {
      int from = outline[i % n];
      const int to = outline[(i + 1) % n];
      const double x = 0.5 * (layout.points[from][0] + layout.points[to][0]);
      std::vector<int> stops =
          points_between(layout, origin, from, to, owner, size_in(config, settings, x));
      stops.push_back(to);
      for (const int stop : stops) {
        b.sides[side].push_back(segments.add(from, stop, block));
        from = stop;
      }
    }
  }
}

}  // namespace

double size_in(const SectionConfig& config, const SectionBlock& block, double x) {
  return block.size ? *block.size : size_at(config, x);
}

Layout lay_out(const SectionConfig& config) {
  Layout layout;
  layout.tolerance = 1e-6 * extent(config);
  std::vector<NamedPoint> origin;
  PointList points(layout, origin);
  std::vector<std::vector<int>> outlines;
  for (const auto& [name, block] : config.blocks) {
    outlines.emplace_back();
    for (const auto& row : block.outline)
      outlines.back().push_back(
          points.add(to_point(row), "block '" + name + "'", size_in(config, block, row[0])));
    layout.blocks.push_back({.name = name, .outline = to_points(block.outline), .sides = {}});
  }
  for (const auto& [name, set] : config.sets)
    for (const auto& row : set.line)
      points.add(to_point(row), "set '" + name + "'", size_at(config, row[0]));

  check_near_misses(layout, origin, outlines, config);
  check_overlaps(layout);
  SegmentList segments(layout, config);
  for (std::size_t b = 0; b < layout.blocks.size(); ++b)
    add_sides(layout, segments, origin, outlines[b], config, static_cast<int>(b));
  layout.notes = check_boundary(layout);
  return layout;
}

}  // namespace flowslide
