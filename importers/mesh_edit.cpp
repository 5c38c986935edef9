#include "importers/mesh_edit.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace flowslide {
namespace {

using Edge = std::array<std::int32_t, 2>;

/// Nodes of the elements that are left, in their order; -1 for the rest.
std::vector<std::int32_t> renumber_nodes(QuadMesh& mesh) {
  std::vector<std::int32_t> number(mesh.num_nodes(), -1);
  for (const auto& e : mesh.elements)
    for (const std::int32_t n : e) number[static_cast<std::size_t>(n)] = 0;
  std::int32_t count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = count;
    mesh.nodes[static_cast<std::size_t>(count)] = mesh.nodes[i];
    mesh.node_tags[static_cast<std::size_t>(count++)] = mesh.node_tags[i];
  }
  mesh.nodes.resize(static_cast<std::size_t>(count));
  mesh.node_tags.resize(static_cast<std::size_t>(count));
  for (auto& e : mesh.elements)
    for (std::int32_t& n : e) n = number[static_cast<std::size_t>(n)];
  return number;
}

}  // namespace

void keep_between(SectionMesh& section, double left, double right) {
  QuadMesh& mesh = section.mesh;
  const std::size_t before = mesh.num_elements();
  std::size_t kept = 0;
  for (std::size_t e = 0; e < before; ++e) {
    const auto inside = [&](std::int32_t n) {
      const double x = mesh.nodes[static_cast<std::size_t>(n)][0];
      const double hair = 1e-9 * std::max(1.0, std::abs(x));
      return x >= left - hair && x <= right + hair;
    };
    if (!std::ranges::all_of(mesh.elements[e], inside)) continue;
    mesh.elements[kept] = mesh.elements[e];
    mesh.element_tags[kept] = mesh.element_tags[e];
    mesh.element_material[kept++] = mesh.element_material[e];
  }
  validate(kept > 0,
           "no element lies between left = {:g} m and right = {:g} m (nothing is left of the mesh) "
           "compare them with its coordinates",
           left, right);
  if (kept == before) return;
  mesh.elements.resize(kept);
  mesh.element_tags.resize(kept);
  mesh.element_material.resize(kept);
  const std::vector<std::int32_t> number = renumber_nodes(mesh);
  for (EdgeSet& set : section.sets) {
    for (Edge& edge : set.edges)
      for (std::int32_t& n : edge) n = number[static_cast<std::size_t>(n)];
    std::erase_if(set.edges, [](const Edge& e) { return e[0] < 0 || e[1] < 0; });
  }
  std::erase_if(section.sets, [](const EdgeSet& s) { return s.edges.empty(); });
  std::erase_if(section.materials, [&](const MaterialName& m) {
    return std::ranges::find(mesh.element_material, m.tag) == mesh.element_material.end();
  });
  section.notes.push_back(fmt::format(
      "{} of {} elements reach beyond left and right and are left out", before - kept, before));
}

std::vector<std::int64_t> drop_loose_nodes(QuadMesh& mesh) {
  const std::vector<std::int64_t> before = mesh.node_tags;
  const std::vector<std::int32_t> number = renumber_nodes(mesh);
  std::vector<std::int64_t> dropped;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] < 0) dropped.push_back(before[i]);
  return dropped;
}

void divide_in_four(SectionMesh& section) {
  QuadMesh& mesh = section.mesh;
  constexpr std::size_t kMostElements = 2'000'000;
  constexpr std::int64_t kLargestTag = std::int64_t{1} << 62;
  validate(4 * mesh.num_elements() <= kMostElements,
           "{} elements would become {} (at most {} are made) divide fewer times",
           mesh.num_elements(), 4 * mesh.num_elements(), kMostElements);
  std::int64_t tag = *std::ranges::max_element(mesh.node_tags);
  validate(tag < kLargestTag,
           "a node has the number {} (new ones count on from it) number them anew", tag);
  const auto add_node = [&](const Vec2& x) {
    mesh.nodes.push_back(x);
    mesh.node_tags.push_back(++tag);
    return static_cast<std::int32_t>(mesh.num_nodes() - 1);
  };
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), -1);
    const Vec2 &p = mesh.nodes[static_cast<std::size_t>(at->first.first)],
               &q = mesh.nodes[static_cast<std::size_t>(at->first.second)];
    if (is_new) at->second = add_node({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    return at->second;
  };
  QuadMesh old = mesh;
  mesh.elements.clear();
  mesh.element_tags.clear();
  mesh.element_material.clear();
  for (std::size_t e = 0; e < old.num_elements(); ++e) {
    const auto& n = old.elements[e];
    std::array<std::int32_t, 4> m{};
    for (std::size_t i = 0; i < 4; ++i) m[i] = middle(n[i], n[(i + 1) % 4]);
    Vec2 c{};
    for (const std::int32_t i : n)
      for (std::size_t d = 0; d < 2; ++d) c[d] += 0.25 * old.nodes[static_cast<std::size_t>(i)][d];
    const std::int32_t centre = add_node(c);
    for (std::size_t i = 0; i < 4; ++i) {
      mesh.elements.push_back({n[i], m[i], centre, m[(i + 3) % 4]});
      mesh.element_tags.push_back(static_cast<std::int64_t>(mesh.num_elements()));
      mesh.element_material.push_back(old.element_material[e]);
    }
  }
  for (EdgeSet& set : section.sets) {
    std::vector<Edge> halves;
    for (const Edge& edge : set.edges) {
      const std::int32_t m = middle(edge[0], edge[1]);
      halves.push_back({edge[0], m});
      halves.push_back({m, edge[1]});
    }
    set.edges = std::move(halves);
  }
}

}  // namespace flowslide
