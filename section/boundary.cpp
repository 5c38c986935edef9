#include "section/boundary.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

using Edge = std::array<std::int32_t, 2>;

std::set<Edge> directed_edges(const QuadMesh& mesh) {
  std::set<Edge> edges;
  for (const auto& n : mesh.elements)
    for (std::size_t k = 0; k < 4; ++k) edges.insert({n[k], n[(k + 1) % 4]});
  return edges;
}

/// The edge of the loop after which the part with that name starts.
std::vector<Edge> part(const std::vector<Edge>& loop, std::size_t from, std::size_t to) {
  std::vector<Edge> edges;
  for (std::size_t i = from; i != to; i = (i + 1) % loop.size()) edges.push_back(loop[i]);
  return edges;
}

double length(const QuadMesh& mesh, const std::set<Edge>& edges) {
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += distance(mesh.nodes[a], mesh.nodes[b]);
  return sum;
}

std::string place(const QuadMesh& mesh, const Edge& e) {
  const Vec2 &a = mesh.nodes[e[0]], &b = mesh.nodes[e[1]];
  return fmt::format("({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m", a[0], a[1], b[0], b[1]);
}

constexpr std::array<std::string_view, 4> kSides{"base", "right", "surface", "left"};

/// Sets of the file with the name of a side: on the outer boundary, soil on the left. A file may
/// have drawn one where `left` or `right` has cut since, so its direction is not known.
void turn_given(SectionMesh& section, const std::vector<Edge>& loop) {
  const std::set<Edge> outer(loop.begin(), loop.end());
  for (EdgeSet& set : section.sets) {
    if (std::ranges::find(kSides, set.name) == kSides.end()) continue;
    std::vector<Edge> inner;
    for (Edge& e : set.edges) {
      if (outer.count({e[1], e[0]}) > 0) std::swap(e[0], e[1]);
      if (outer.count(e) == 0) inner.push_back(e);
    }
    validate(inner.empty(),
             "set '{}' of the file: {} of its {} edges lie inside the section, such as {} (the set "
             "of this name is the side that is held, shaken or loaded, and has soil on one side "
             "only). Give this physical curve another name",
             set.name, inner.size(), set.edges.size(),
             inner.empty() ? std::string() : place(section.mesh, inner.front()));
  }
}

/// The set that the file has for a side, against the side that is found.
void compare_given(SectionMesh& section, EdgeSet& given, const std::vector<Edge>& found) {
  const QuadMesh& mesh = section.mesh;
  const std::set<Edge> file(given.edges.begin(), given.edges.end());
  const std::set<Edge> side(found.begin(), found.end());
  if (file == side) {
    given.edges = found;  // in walking order
    return;
  }
  std::set<Edge> common;
  for (const Edge& e : file)
    if (side.count(e) > 0) common.insert(e);
  validate(!common.empty(),
           "set '{}' of the file lies elsewhere than that side of the section: it has the edge {}, "
           "the side the edge {}, and no edge is in both (it would be held, shaken or loaded in "
           "place of the side). Give this physical curve another name: the side is found without "
           "it",
           given.name, file.empty() ? "none" : place(mesh, *file.begin()),
           side.empty() ? "none" : place(mesh, found.front()));
  section.notes.push_back(fmt::format(
      "set '{}' of the file is {:.6g} m long, the side of this name that is found {:.6g} m, and "
      "they have {:.6g} m in common: the set of the file is what is held, shaken or loaded, and "
      "nothing else of the side. If that is not meant, give its physical curve another name",
      given.name, length(mesh, file), length(mesh, side), length(mesh, common)));
}

/// A section without vertical ends has the sides that its file gives it.
void note_not_found(SectionMesh& section, const std::vector<Edge>& loop) {
  std::vector<std::string_view> missing;
  std::map<Edge, int> times;
  for (const Edge& e : loop) times[e] = 0;
  for (const std::string_view name : kSides) {
    const auto set = std::ranges::find(section.sets, name, &EdgeSet::name);
    if (set == section.sets.end())
      missing.push_back(name);
    else
      for (const Edge& e : set->edges) ++times[e];
  }
  if (!missing.empty()) {
    section.notes.push_back(fmt::format("the section has no vertical ends, so there {} no set{} {}",
                                        missing.size() == 1 ? "is" : "are",
                                        missing.size() == 1 ? "" : "s", fmt::join(missing, ", ")));
    return;
  }
  std::set<Edge> open, twice;
  for (const auto& [e, n] : times)
    if (n != 1) (n == 0 ? open : twice).insert(e);
  if (!open.empty() || !twice.empty())
    section.notes.push_back(fmt::format(
        "the sets base, right, surface and left of the file leave out {:.6g} m of the outer "
        "boundary, and {:.6g} m are in two of them or twice in one: together they should cover it "
        "once",
        length(section.mesh, open), length(section.mesh, twice)));
}

}  // namespace

std::vector<Edge> outer_edges(const QuadMesh& mesh) {
  const std::set<Edge> edges = directed_edges(mesh);
  std::map<std::int32_t, std::int32_t> next;
  for (const auto& [a, b] : edges) {
    if (edges.count({b, a}) > 0) continue;
    validate(next.emplace(a, b).second,
             "the mesh hangs together by node {} alone (two boundaries meet there). Join the "
             "elements around it by edges, or part them",
             mesh.node_tags[a]);
  }
  std::vector<Edge> loop;
  for (auto at = next.begin(); at != next.end() && loop.size() < next.size();
       at = next.find(at->second))
    loop.push_back({at->first, at->second});
  validate(loop.size() == next.size() && loop.back()[1] == loop.front()[0],
           "the mesh has holes or several parts: its boundary has {} edges, but only {} hang "
           "together from node {} on. Elements that touch must share nodes",
           next.size(), std::min(loop.size(), next.size()), mesh.node_tags[loop.front()[0]]);
  return loop;
}

void add_outer_sets(SectionMesh& section) {
  const QuadMesh& mesh = section.mesh;
  const std::vector<Edge> loop = outer_edges(mesh);
  turn_given(section, loop);
  const auto [lowest, highest] =
      std::minmax_element(mesh.nodes.begin(), mesh.nodes.end(),
                          [](const Vec2& a, const Vec2& b) { return a[0] < b[0]; });
  const double x_left = (*lowest)[0], x_right = (*highest)[0];
  const double tolerance = 1e-6 * (x_right - x_left);
  const auto lies_at = [&](const Edge& e, double x) {
    return std::abs(mesh.nodes[e[0]][0] - x) <= tolerance &&
           std::abs(mesh.nodes[e[1]][0] - x) <= tolerance;
  };
  const std::size_t n = loop.size();
  // Where a run of edges at x starts, and the first edge after it; n and n if there is none.
  const auto run_at = [&](double x) {
    std::pair<std::size_t, std::size_t> run{n, n};
    for (std::size_t i = 0; i < n; ++i) {
      if (lies_at(loop[i], x) && !lies_at(loop[(i + n - 1) % n], x)) run.first = i;
      if (!lies_at(loop[i], x) && lies_at(loop[(i + n - 1) % n], x)) run.second = i;
    }
    return run;
  };
  const auto left = run_at(x_left), right = run_at(x_right);
  if (left.first == n || right.first == n) {
    note_not_found(section, loop);
    return;
  }
  const auto add = [&section](const std::string& name, std::vector<Edge> edges) {
    const auto given = std::ranges::find(section.sets, name, &EdgeSet::name);
    if (given == section.sets.end())
      section.sets.push_back({name, std::move(edges)});
    else
      compare_given(section, *given, edges);
  };
  add("base", part(loop, left.second, right.first));
  add("right", part(loop, right.first, right.second));
  add("surface", part(loop, right.second, left.first));
  add("left", part(loop, left.first, left.second));
}

EdgeSet edges_along(const QuadMesh& mesh, const std::string& name, std::span<const Vec2> line,
                    double tolerance) {
  EdgeSet set{name, {}};
  const std::set<Edge> all = directed_edges(mesh);
  for (std::size_t leg = 1; leg < line.size(); ++leg) {
    const Vec2 a = line[leg - 1], b = line[leg];
    const double length = distance(a, b), slack = tolerance / length;
    std::map<double, Edge> on_leg;
    double covered = 0.0;
    for (const auto& [p, q] : all) {
      const Projection from = project(a, b, mesh.nodes[p]), to = project(a, b, mesh.nodes[q]);
      if (from.distance > tolerance || to.distance > tolerance) continue;
      const bool with = to.parameter > from.parameter;
      const double first = std::min(from.parameter, to.parameter);
      const double last = std::max(from.parameter, to.parameter);
      if (first < -slack || last > 1.0 + slack) continue;
      // An inner edge is seen from both elements; on the boundary the soil is on the left.
      if (all.count({q, p}) > 0 && !with) continue;
      on_leg.emplace(first, Edge{p, q});
      covered += distance(mesh.nodes[p], mesh.nodes[q]);
    }
    validate(covered > length - 10.0 * tolerance,
             "set '{}': its line from ({}, {}) to ({}, {}) follows element edges over {:.4g} m of "
             "{:.4g} m only. Draw it along sides of blocks, or make blocks that meet there",
             name, a[0], a[1], b[0], b[1], covered, length);
    for (const auto& [t, edge] : on_leg) set.edges.push_back(edge);
  }
  return set;
}

}  // namespace flowslide
