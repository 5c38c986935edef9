#include "section/block_grid.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"
#include "section/transfinite.hpp"

#include <algorithm>
#include <array>

namespace flowslide {
namespace {

/// Nodes while the blocks are joined, and where each point and segment has its own.
struct Nodes {
  std::vector<Vec2> position;
  std::vector<std::int32_t> of_point;
  std::vector<std::vector<std::int32_t>> inside_segment;  ///< from a to b, without the ends
};

/// Points that divide a segment into n parts of equal length in target sizes.
std::vector<Vec2> divided(const Layout& layout, const SectionConfig& config, const Segment& s,
                          int n) {
  const Vec2 a = layout.points[s.a], b = layout.points[s.b];
  const auto size = [&](double t) {
    const double x = a[0] + t * (b[0] - a[0]);
    double least =
        size_in(config, config.blocks.at(layout.blocks[std::max(s.left, s.right)].name), x);
    if (s.left >= 0 && s.right >= 0)
      least = std::min(least, size_in(config, config.blocks.at(layout.blocks[s.left].name), x));
    return least;
  };
  const int parts = std::max(64, 8 * n);
  std::vector<double> sum(parts + 1, 0.0);
  for (int i = 0; i < parts; ++i) sum[i + 1] = sum[i] + 1.0 / size((i + 0.5) / parts);
  std::vector<Vec2> points;
  int i = 0;
  for (int k = 1; k < n; ++k) {
    const double target = sum.back() * k / n;
    while (sum[i + 1] < target) ++i;
    const double t = (i + (target - sum[i]) / (sum[i + 1] - sum[i])) / parts;
    points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
  return points;
}

Nodes segment_nodes(const Layout& layout, const SectionConfig& config,
                    const std::vector<int>& divisions) {
  Nodes nodes;
  nodes.of_point.assign(layout.points.size(), -1);
  const auto add = [&nodes](Vec2 p) {
    nodes.position.push_back(p);
    return static_cast<std::int32_t>(nodes.position.size()) - 1;
  };
  for (std::size_t i = 0; i < layout.segments.size(); ++i) {
    const Segment& s = layout.segments[i];
    for (const int p : {s.a, s.b})
      if (nodes.of_point[p] < 0) nodes.of_point[p] = add(layout.points[p]);
    nodes.inside_segment.emplace_back();
    for (const Vec2& p : divided(layout, config, s, divisions[i]))
      nodes.inside_segment.back().push_back(add(p));
  }
  return nodes;
}

std::vector<std::int32_t> side_nodes(const Layout& layout, const Nodes& nodes,
                                     const std::vector<DirectedSegment>& side) {
  std::vector<std::int32_t> line;
  for (const DirectedSegment& d : side) {
    const Segment& s = layout.segments[d.segment];
    line.push_back(nodes.of_point[d.forward ? s.a : s.b]);
    std::vector<std::int32_t> inside = nodes.inside_segment[d.segment];
    if (!d.forward) std::reverse(inside.begin(), inside.end());
    line.insert(line.end(), inside.begin(), inside.end());
  }
  const DirectedSegment& d = side.back();
  const Segment& s = layout.segments[d.segment];
  line.push_back(nodes.of_point[d.forward ? s.b : s.a]);
  return line;
}

/// A straight side on the boundary takes over the spacing of the opposite side, which blocks beyond
/// it have a say in: so the lines of the grid between them do not slant more than they must.
void follow_opposite_sides(const Layout& layout, Nodes& nodes) {
  const auto is_free = [&layout](const std::vector<DirectedSegment>& side) {
    if (side.size() != 1) return false;
    const Segment& s = layout.segments[side[0].segment];
    return s.left < 0 || s.right < 0;
  };
  for (const LayoutBlock& block : layout.blocks)
    for (int side = 0; side < 4; ++side) {
      const int opposite = (side + 2) % 4;
      if (!is_free(block.sides[side]) || is_free(block.sides[opposite])) continue;
      const std::vector<std::int32_t> line = side_nodes(layout, nodes, block.sides[side]);
      const std::vector<std::int32_t> other = side_nodes(layout, nodes, block.sides[opposite]);
      std::vector<Vec2> points;
      for (auto n = other.rbegin(); n != other.rend(); ++n) points.push_back(nodes.position[*n]);
      const std::vector<double> share = length_shares(points);
      const Vec2 a = nodes.position[line.front()], b = nodes.position[line.back()];
      for (std::size_t i = 1; i + 1 < line.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
          nodes.position[line[i]][k] = a[k] + share[i] * (b[k] - a[k]);
    }
}

void add_block(const Layout& layout, const SectionConfig& config, const LayoutBlock& block,
               Nodes& nodes, QuadMesh& mesh) {
  std::vector<std::int32_t> bottom = side_nodes(layout, nodes, block.sides[0]);
  std::vector<std::int32_t> right = side_nodes(layout, nodes, block.sides[1]);
  std::vector<std::int32_t> top = side_nodes(layout, nodes, block.sides[2]);
  std::vector<std::int32_t> left = side_nodes(layout, nodes, block.sides[3]);
  std::reverse(top.begin(), top.end());
  std::reverse(left.begin(), left.end());
  const auto positions = [&nodes](const std::vector<std::int32_t>& line) {
    std::vector<Vec2> points;
    for (const std::int32_t n : line) points.push_back(nodes.position[n]);
    return points;
  };
  const std::vector<Vec2> grid =
      transfinite({positions(bottom), positions(right), positions(top), positions(left)});
  const std::size_t nx = bottom.size(), ny = left.size();
  std::vector<std::int32_t> node(nx * ny);
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      std::int32_t& n = node[j * nx + i];
      if (j == 0)
        n = bottom[i];
      else if (j == ny - 1)
        n = top[i];
      else if (i == 0)
        n = left[j];
      else if (i == nx - 1)
        n = right[j];
      else {
        n = static_cast<std::int32_t>(nodes.position.size());
        nodes.position.push_back(grid[j * nx + i]);
      }
    }
  const std::int32_t tag = config.materials.at(config.blocks.at(block.name).material).tag;
  for (std::size_t j = 0; j + 1 < ny; ++j)
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      mesh.elements.push_back({node[j * nx + i], node[j * nx + i + 1], node[(j + 1) * nx + i + 1],
                               node[(j + 1) * nx + i]});
      mesh.element_material.push_back(tag);
    }
}

void check_folds(const QuadMesh& mesh, std::size_t first, const std::string& block) {
  for (std::size_t e = first; e < mesh.num_elements(); ++e) {
    const auto q = corners(mesh, mesh.nodes, e);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<Vec2, 3> corner{q[(k + 3) % 4], q[k], q[(k + 1) % 4]};
      validate(outline_area(corner) > 0.0,
               "block '{}': its grid folds over at ({:.4g}, {:.4g}) (the outline bends inwards "
               "too much for a grid between these corners). Choose other corners or divide the "
               "block",
               block, q[k][0], q[k][1]);
    }
  }
}

}  // namespace

QuadMesh block_grids(const Layout& layout, const SectionConfig& config,
                     const std::vector<int>& divisions) {
  Nodes nodes = segment_nodes(layout, config, divisions);
  follow_opposite_sides(layout, nodes);
  QuadMesh mesh;
  for (const LayoutBlock& block : layout.blocks) {
    const std::size_t first = mesh.num_elements();
    add_block(layout, config, block, nodes, mesh);
    mesh.nodes = nodes.position;
    check_folds(mesh, first, block.name);
  }
  return mesh;
}

}  // namespace flowslide
