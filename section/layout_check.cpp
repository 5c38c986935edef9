#include "section/layout_check.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"

#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

void check_pair(const LayoutBlock& a, const LayoutBlock& b) {
  for (std::size_t i = 0; i < a.outline.size(); ++i)
    for (std::size_t k = 0; k < b.outline.size(); ++k)
      if (const auto at = crossing(a.outline[i], a.outline[(i + 1) % a.outline.size()],
                                   b.outline[k], b.outline[(k + 1) % b.outline.size()]))
        throw InputError(fmt::format(
            "blocks '{}' and '{}' overlap: their sides cross at ({:.6g}, {:.6g}). Blocks may touch "
            "along sides only; correct the outline of one",
            a.name, b.name, (*at)[0], (*at)[1]));
}

/// A point well inside an outline: beside the middle of its longest side.
Vec2 point_inside(const std::vector<Vec2>& outline) {
  std::size_t longest = 0;
  double length = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double l = distance(outline[i], outline[(i + 1) % outline.size()]);
    if (l > length) {
      longest = i;
      length = l;
    }
  }
  const Vec2 a = outline[longest], b = outline[(longest + 1) % outline.size()];
  const double step = 1e-4;
  return {0.5 * (a[0] + b[0]) - step * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + step * (b[0] - a[0])};
}

struct Loop {
  std::vector<Vec2> points;
  std::vector<int> owner;  ///< block of the side from each point to the next
  std::set<int> blocks;
  double area = 0.0;
};

std::string block_names(const Layout& layout, const std::set<int>& blocks) {
  std::string text;
  for (const int b : blocks) text += (text.empty() ? "'" : ", '") + layout.blocks[b].name + "'";
  return text;
}

std::vector<Loop> boundary_loops(const Layout& layout) {
  std::map<int, std::pair<int, int>> next;  // from point to point, of block
  for (const Segment& s : layout.segments) {
    if (s.left >= 0 && s.right >= 0) continue;
    const int from = s.left >= 0 ? s.a : s.b;
    const int to = s.left >= 0 ? s.b : s.a;
    const int block = s.left >= 0 ? s.left : s.right;
    const auto [it, is_new] = next.emplace(from, std::make_pair(to, block));
    validate(is_new,
             "blocks '{}' and '{}' meet at the point ({}, {}) only (soil that hangs together there "
             "has no common side). Let them share a side or part them",
             layout.blocks[block].name, layout.blocks[it->second.second].name,
             layout.points[from][0], layout.points[from][1]);
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    for (auto at = next.begin(); at != next.end();) {
      loop.points.push_back(layout.points[at->first]);
      loop.owner.push_back(at->second.second);
      loop.blocks.insert(at->second.second);
      const int to = at->second.first;
      next.erase(at);
      at = next.find(to);
    }
    loop.area = outline_area(loop.points);
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Wedges of air of less than 30 degrees that the boundary leaves between two of its sides: nothing
/// that stands as built has one.
std::vector<std::string> open_wedges(const Layout& layout, const Loop& loop) {
  constexpr double kCosine = 0.866;
  std::vector<std::string> notes;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const Vec2 p = loop.points[i], p_before = loop.points[before],
               p_next = loop.points[(i + 1) % n];
    const double length_a = distance(p, p_before), length_b = distance(p, p_next);
    const Vec2 a{(p_before[0] - p[0]) / length_a, (p_before[1] - p[1]) / length_a};
    const Vec2 b{(p_next[0] - p[0]) / length_b, (p_next[1] - p[1]) / length_b};
    const bool inward = a[0] * b[1] - a[1] * b[0] > 0.0;
    if (!inward || a[0] * b[0] + a[1] * b[1] < kCosine) continue;
    const double length = std::min(length_a, length_b), width = distance(a, b) * length;
    notes.push_back(fmt::format(
        "a wedge is left open at ({:.6g}, {:.6g}), between the blocks {}: it is {:.3g} m wide {:.3g} "
        "m away. If they touch there, give their sides the same points.",
        p[0], p[1], block_names(layout, {loop.owner[before], loop.owner[i]}), width, length));
  }
  return notes;
}

}  // namespace

void check_overlaps(const Layout& layout) {
  for (std::size_t a = 0; a < layout.blocks.size(); ++a)
    for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
      if (a == b) continue;
      if (a < b) check_pair(layout.blocks[a], layout.blocks[b]);
      const Vec2 p = point_inside(layout.blocks[a].outline);
      validate(!inside_outline(layout.blocks[b].outline, p),
               "blocks '{}' and '{}' overlap: the point ({:.6g}, {:.6g}) lies in both. Correct the "
               "outline of one",
               layout.blocks[a].name, layout.blocks[b].name, p[0], p[1]);
    }
}

std::vector<std::string> check_boundary(const Layout& layout) {
  const std::vector<Loop> loops = boundary_loops(layout);
  for (const Loop& loop : loops)
    validate(loop.area > 0.0,
             "there is a hole of {:.3g} m2 beside the point ({}, {}), between the blocks {}. Fill "
             "it with a block, or correct the points around it",
             -loop.area, loop.points[0][0], loop.points[0][1], block_names(layout, loop.blocks));
  if (loops.size() > 1)
    throw InputError(fmt::format(
        "the section falls into {} parts: the blocks {} and the blocks {} share no side. Blocks "
        "that touch must name the same points",
        loops.size(), block_names(layout, loops[0].blocks), block_names(layout, loops[1].blocks)));
  return open_wedges(layout, loops[0]);
}

}  // namespace flowslide
