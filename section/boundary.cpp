#include "section/boundary.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

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
    section.notes.push_back(
        "the section has no vertical ends, so there are no sets base, right, surface and left");
    return;
  }
  const auto add = [&section](const std::string& name, std::vector<Edge> edges) {
    const bool exists = std::any_of(section.sets.begin(), section.sets.end(),
                                    [&name](const EdgeSet& set) { return set.name == name; });
    if (!exists) section.sets.push_back({name, std::move(edges)});
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
