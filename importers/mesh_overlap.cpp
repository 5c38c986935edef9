#include "importers/mesh_overlap.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// An edge of an element, which lies on its left.
struct Side {
  std::int32_t from, to;
  std::size_t element;
};

/// An outer side with the distance within which something lies on it [m].
struct OuterSide {
  Side side;
  Vec2 a, b;
  double tolerance;
};

struct Contact {
  const char* how = nullptr;  ///< none
  Vec2 at{};
  bool twice = false;  ///< is there soil on soil, and not only a seam between two parts of it?
};

double distance(const Vec2& a, const Vec2& b) { return hypot(b[0] - a[0], b[1] - a[1]); }

double cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Sides of all elements; those of one edge stand together, equal ones next to each other.
std::vector<Side> sides_by_edge(const QuadMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.num_elements());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      sides.push_back({mesh.elements[e][k], mesh.elements[e][(k + 1) % 4], e});
  const auto key = [](const Side& s) {
    return std::tuple(std::min(s.from, s.to), std::max(s.from, s.to), s.from, s.element);
  };
  std::sort(sides.begin(), sides.end(),
            [key](const Side& a, const Side& b) { return key(a) < key(b); });
  return sides;
}

bool same_edge(const Side& a, const Side& b) {
  return std::minmax(a.from, a.to) == std::minmax(b.from, b.to);
}

/// A thousandth of the thickness of the element: digits that a text file lacks are less, a gap
/// that somebody drew is more. An edge may be far shorter than its element is thick.
double tolerance_of(const QuadMesh& mesh, const Side& side) {
  const auto quad = corners(mesh, mesh.nodes, side.element);
  double longest = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    longest = std::max(longest, distance(quad[k], quad[(k + 1) % 4]));
  const double length = distance(mesh.nodes[side.from], mesh.nodes[side.to]);
  return 1e-3 * std::min(area(quad) / longest, length);
}

/// By their smallest coordinate along the longer extent of the mesh, `axis`.
std::vector<OuterSide> outer_sides(const QuadMesh& mesh, const std::vector<Side>& sides,
                                   std::size_t axis) {
  std::vector<OuterSide> outer;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && same_edge(sides[i], sides[i - 1])) continue;
    if (i + 1 < sides.size() && same_edge(sides[i], sides[i + 1])) continue;
    const Side& s = sides[i];
    outer.push_back({s, mesh.nodes[s.from], mesh.nodes[s.to], tolerance_of(mesh, s)});
  }
  std::stable_sort(outer.begin(), outer.end(), [axis](const OuterSide& p, const OuterSide& q) {
    return std::min(p.a[axis], p.b[axis]) < std::min(q.a[axis], q.b[axis]);
  });
  return outer;
}

double distance_to_side(const Vec2& x, const OuterSide& s) {
  const double dx = s.b[0] - s.a[0], dy = s.b[1] - s.a[1];
  const double t = ((x[0] - s.a[0]) * dx + (x[1] - s.a[1]) * dy) / (dx * dx + dy * dy);
  const double c = std::clamp(t, 0.0, 1.0);
  return distance(x, {s.a[0] + c * dx, s.a[1] + c * dy});
}

Contact crossing(const OuterSide& p, const OuterSide& q) {
  if (p.side.from == q.side.from || p.side.from == q.side.to || p.side.to == q.side.from ||
      p.side.to == q.side.to)
    return {};
  const double of_a = cross(q.a, q.b, p.a), of_b = cross(q.a, q.b, p.b);
  const double of_c = cross(p.a, p.b, q.a), of_d = cross(p.a, p.b, q.b);
  if (!(of_a * of_b < 0.0 && of_c * of_d < 0.0)) return {};
  const double t = of_a / (of_a - of_b);
  // How far the ends lie beyond each other's line: digits that a file lacks make seams cross.
  const double p_beyond = std::min(std::abs(of_a), std::abs(of_b)) / distance(q.a, q.b);
  const double q_beyond = std::min(std::abs(of_c), std::abs(of_d)) / distance(p.a, p.b);
  return {"crosses",
          {p.a[0] + t * (p.b[0] - p.a[0]), p.a[1] + t * (p.b[1] - p.a[1])},
          std::min(p_beyond, q_beyond) > std::min(p.tolerance, q.tolerance)};
}

Contact contact(const OuterSide& p, const OuterSide& q) {
  // The sides of one element are apart where its Jacobians are positive.
  if (p.side.element == q.side.element) return {};
  if (const Contact c = crossing(p, q); c.how != nullptr) return c;
  const double tolerance = std::min(p.tolerance, q.tolerance);
  std::size_t inside = 0;
  Vec2 at{};
  // Whether both ends of s lie on t; those within t and not at its ends are counted.
  const auto lies_on = [&](const OuterSide& s, const OuterSide& t) {
    bool both = true;
    for (const Vec2& x : {s.a, s.b}) {
      const bool on = distance_to_side(x, t) <= tolerance;
      both = both && on;
      if (!on || distance(x, t.a) <= tolerance || distance(x, t.b) <= tolerance) continue;
      if (inside++ == 0) at = x;
    }
    return both;
  };
  const bool p_on_q = lies_on(p, q), q_on_p = lies_on(q, p);
  const OuterSide& shorter = p_on_q ? p : q;
  if (inside == 0) at = {0.5 * (shorter.a[0] + shorter.b[0]), 0.5 * (shorter.a[1] + shorter.b[1])};
  // Both have their soil on the left: on the same side of a common line if they run the same way.
  const bool same_way =
      (p.b[0] - p.a[0]) * (q.b[0] - q.a[0]) + (p.b[1] - p.a[1]) * (q.b[1] - q.a[1]) > 0.0;
  if (p_on_q || q_on_p || inside > 1) return {"lies along", at, same_way};
  return inside > 0 ? Contact{"touches", at} : Contact{};
}

std::string elements_on_one_side(const QuadMesh& mesh, const std::vector<Side>& sides) {
  const auto found = std::adjacent_find(
      sides.begin(), sides.end(),
      [](const Side& a, const Side& b) { return a.from == b.from && a.to == b.to; });
  if (found == sides.end()) return {};
  return fmt::format(
      "elements {} and {} lie on the same side of their common edge from node {} to {} at "
      "({:.6g}, {:.6g}) m (their soil would count twice)",
      mesh.element_tags[found->element], mesh.element_tags[(found + 1)->element],
      mesh.node_tags[found->from], mesh.node_tags[found->to], mesh.nodes[found->from][0],
      mesh.nodes[found->from][1]);
}

/// A corner of an element: its edges go from the node to `next` and from `before` to the node.
struct Corner {
  std::size_t element;
  Vec2 next, before;  ///< from the node, of unit length
};

Vec2 direction(const Vec2& a, const Vec2& b) {
  const double length = distance(a, b);
  return {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
}

/// Is there more of `d` between the edges of the corner than digits that a file lacks?
bool inside(const Vec2& d, const Corner& c) {
  constexpr double kAngle = 2e-3;
  return cross({}, c.next, d) > kAngle && cross({}, d, c.before) > kAngle;
}

bool lie_over(const Corner& a, const Corner& b) {
  return inside(a.next, b) || inside(a.before, b) || inside(b.next, a) || inside(b.before, a);
}

/// Elements that share a node and lie over each other there; edges that share it do not cross.
std::string elements_over_a_node(const QuadMesh& mesh) {
  std::vector<std::vector<Corner>> around(mesh.num_nodes());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& n = mesh.elements[e];
      const Vec2& at = mesh.nodes[n[k]];
      around[n[k]].push_back({e, direction(at, mesh.nodes[n[(k + 1) % 4]]),
                              direction(at, mesh.nodes[n[(k + 3) % 4]])});
    }
  for (std::size_t n = 0; n < around.size(); ++n)
    for (std::size_t i = 0; i < around[n].size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (lie_over(around[n][k], around[n][i]))
          return fmt::format(
              "elements {} and {} share node {} and lie over each other at ({:.6g}, {:.6g}) m (their "
              "soil would count twice)",
              mesh.element_tags[around[n][k].element], mesh.element_tags[around[n][i].element],
              mesh.node_tags[n], mesh.nodes[n][0], mesh.nodes[n][1]);
  return {};
}

std::string in_words(const QuadMesh& mesh, const OuterSide& s) {
  return fmt::format("from node {} to {} of element {}", mesh.node_tags[s.side.from],
                     mesh.node_tags[s.side.to], mesh.element_tags[s.side.element]);
}

/// The longer extent, so that few sides stand beside each other along it.
std::size_t longer_axis(const QuadMesh& mesh) {
  const auto extent = [&mesh](std::size_t d) {
    const auto [low, high] =
        std::minmax_element(mesh.nodes.begin(), mesh.nodes.end(),
                            [d](const Vec2& a, const Vec2& b) { return a[d] < b[d]; });
    return (*high)[d] - (*low)[d];
  };
  return extent(0) >= extent(1) ? 0 : 1;
}

struct Meetings {
  std::size_t count = 0;
  std::string first;
};

/// Outer edges that meet without being joined; all, or those that have soil on soil.
Meetings meetings(const QuadMesh& mesh, const std::vector<Side>& sides, bool all) {
  const std::size_t axis = longer_axis(mesh), other = 1 - axis;
  const std::vector<OuterSide> outer = outer_sides(mesh, sides, axis);
  Meetings found;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const OuterSide& p = outer[i];
    const auto [begin, end] = std::minmax(p.a[other], p.b[other]);
    const double last = std::max(p.a[axis], p.b[axis]) + p.tolerance;
    for (std::size_t k = i + 1; k < outer.size(); ++k) {
      const OuterSide& q = outer[k];
      if (std::min(q.a[axis], q.b[axis]) > last) break;
      if (std::min(q.a[other], q.b[other]) > end + p.tolerance) continue;
      if (std::max(q.a[other], q.b[other]) < begin - p.tolerance) continue;
      const Contact c = contact(p, q);
      if (c.how == nullptr || !(all || c.twice)) continue;
      if (found.count++ == 0)
        found.first = fmt::format("the one {} {} the one {} at ({:.6g}, {:.6g}) m",
                                  in_words(mesh, p), c.how, in_words(mesh, q), c.at[0], c.at[1]);
    }
  }
  return found;
}

std::string told(const Meetings& found) {
  const bool one = found.count == 1;
  return fmt::format("{} of outer edges {} without being joined: {}",
                     one ? "a pair" : fmt::format("{} pairs", found.count), one ? "meets" : "meet",
                     found.first);
}

}  // namespace

std::string overlap(const QuadMesh& mesh) {
  const std::vector<Side> sides = sides_by_edge(mesh);
  if (std::string text = elements_on_one_side(mesh, sides); !text.empty()) return text;
  const Meetings found = meetings(mesh, sides, true);
  if (found.count == 0) return elements_over_a_node(mesh);
  return told(found) +
         " (soil that lies over soil counts twice, and no force passes a seam whose sides have nodes "
         "of their own)";
}

std::string soil_on_soil(const QuadMesh& mesh) {
  const std::vector<Side> sides = sides_by_edge(mesh);
  if (std::string text = elements_on_one_side(mesh, sides); !text.empty()) return text;
  const Meetings found = meetings(mesh, sides, false);
  if (found.count == 0) return elements_over_a_node(mesh);
  return told(found) + " (their soil lies over each other and would count twice)";
}

}  // namespace flowslide
