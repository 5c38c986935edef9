#include "section/triangles.hpp"

#include "section/layout.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// The points of a side from corner to corner, both included.
std::vector<Vec2> side_points(const std::vector<Vec2>& outline, int from, int to) {
  std::vector<Vec2> points{outline[from]};
  const int n = static_cast<int>(outline.size());
  for (int i = from; i != to;) {
    i = (i + 1) % n;
    points.push_back(outline[i]);
  }
  return points;
}

double elements_along(const SectionConfig& config, const SectionBlock& block,
                      const std::vector<Vec2>& side) {
  double n = 0.0;
  for (std::size_t i = 1; i < side.size(); ++i)
    n += distance(side[i - 1], side[i]) /
         size_in(config, block, 0.5 * (side[i - 1][0] + side[i][0]));
  return n;
}

/// A side cut where `share` of its length is reached: both parts have the cut point.
std::pair<std::vector<Vec2>, std::vector<Vec2>> cut(const std::vector<Vec2>& side, double share) {
  double total = 0.0;
  for (std::size_t i = 1; i < side.size(); ++i) total += distance(side[i - 1], side[i]);
  double rest = share * total;
  std::vector<Vec2> before{side[0]};
  for (std::size_t i = 1; i < side.size(); ++i) {
    const double leg = distance(side[i - 1], side[i]);
    if (rest < leg * (1.0 - 1e-9)) {
      // A cut close to a point of the outline is made there.
      if (rest < 0.05 * leg && i > 1) rest = 0.0;
      const double t = rest / leg;
      const Vec2 at = {side[i - 1][0] + t * (side[i][0] - side[i - 1][0]),
                       side[i - 1][1] + t * (side[i][1] - side[i - 1][1])};
      if (t > 0.0) before.push_back(at);
      std::vector<Vec2> after{at};
      after.insert(after.end(), side.begin() + static_cast<std::ptrdiff_t>(i), side.end());
      return {before, after};
    }
    rest -= leg;
    before.push_back(side[i]);
  }
  return {before, {side.back()}};
}

/// Long sides that meet at a sharp corner get equal numbers, so that the grid there is symmetric.
void even_out_at_sharpest(const std::vector<Vec2>& outline, const std::vector<int>& corner,
                          std::array<double, 3>& n) {
  std::size_t sharpest = 0;
  std::array<double, 3> opposite{};
  for (std::size_t k = 0; k < 3; ++k) {
    opposite[k] = distance(outline[corner[(k + 1) % 3]], outline[corner[(k + 2) % 3]]);
    if (opposite[k] < opposite[sharpest]) sharpest = k;
  }
  double& one = n[sharpest];
  double& other = n[(sharpest + 2) % 3];
  if (std::abs(one - other) < 0.3 * std::max(one, other)) one = other = 0.5 * (one + other);
}

PointRows to_rows(const std::vector<Vec2>& points) {
  PointRows rows;
  for (const Vec2& p : points) rows.push_back({p[0], p[1]});
  return rows;
}

void split(const std::string& name, const SectionBlock& block, const SectionConfig& config,
           SectionConfig& out) {
  const std::vector<Vec2> outline = to_points(block.outline);
  const std::vector<int> corner = corners_of(block);
  std::array<std::vector<Vec2>, 3> side;
  std::array<double, 3> n{};
  for (std::size_t k = 0; k < 3; ++k) {
    side[k] = side_points(outline, corner[k], corner[(k + 1) % 3]);
    n[k] = elements_along(config, block, side[k]);
  }
  even_out_at_sharpest(outline, corner, n);
  // Side k runs from corner k to k + 1. Its part at corner k + 1 has as many elements as the part
  // of the next side at the far end of that, and so on around.
  std::array<std::vector<Vec2>, 3> before, after;
  for (std::size_t k = 0; k < 3; ++k) {
    const double next = n[(k + 1) % 3], previous = n[(k + 2) % 3];
    const double at_start = 0.5 * (n[k] + next - previous);
    std::tie(before[k], after[k]) = cut(side[k], std::clamp(at_start / n[k], 0.15, 0.85));
  }
  Vec2 centre{};
  for (const auto& part : before)
    for (std::size_t i = 0; i < 2; ++i) centre[i] += part.back()[i] / 3.0;
  for (std::size_t k = 0; k < 3; ++k) {
    SectionBlock part{.outline = {},
                      .corners = {},
                      .material = block.material,
                      .size = block.size,
                      .divisions = {}};
    std::vector<Vec2> points = before[k];
    const int second = static_cast<int>(points.size());
    points.push_back(centre);
    const std::vector<Vec2>& last = after[(k + 2) % 3];
    points.insert(points.end(), last.begin(), last.end() - 1);
    part.corners = {1, second, second + 1, second + 2};
    part.outline = to_rows(points);
    out.blocks.emplace(fmt::format("{} ({})", name, k + 1), std::move(part));
  }
}

}  // namespace

std::vector<int> corners_of(const SectionBlock& block) {
  std::vector<int> corners = block.corners;
  if (corners.empty()) {
    corners.resize(block.outline.size());
    std::iota(corners.begin(), corners.end(), 1);
  }
  for (int& c : corners) --c;
  return corners;
}

SectionConfig split_triangles(const SectionConfig& config) {
  SectionConfig out = config;
  for (const auto& [name, block] : config.blocks) {
    if (corners_of(block).size() != 3) continue;
    out.blocks.erase(name);
    split(name, block, config, out);
  }
  return out;
}

}  // namespace flowslide
