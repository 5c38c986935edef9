#include "importers/mesh_faults.hpp"

#include "core/median.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace flowslide {
namespace {

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Distance within which two nodes are at one place [m]: far below any element, far above the
/// digits of a text file.
double coincidence(const QuadMesh& mesh) {
  std::vector<double> areas;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    areas.push_back(std::abs(area(corners(mesh, mesh.nodes, e))));
  if (areas.empty()) return 0.0;
  // The median: a misplaced node makes some elements as large as one likes.
  return 1e-5 * std::sqrt(median(std::move(areas)));
}

}  // namespace

std::vector<std::array<std::size_t, 2>> repeated_elements(const QuadMesh& mesh) {
  std::map<std::array<std::int32_t, 4>, std::size_t> seen;
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    std::array<std::int32_t, 4> nodes = mesh.elements[e];
    std::sort(nodes.begin(), nodes.end());
    const auto [at, is_new] = seen.emplace(nodes, e);
    if (!is_new) pairs.push_back({at->second, e});
  }
  return pairs;
}

MeshJoints find_joints(const QuadMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.num_nodes());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<bool> used(mesh.num_nodes(), false);
  for (const auto& nodes : mesh.elements)
    for (const std::int32_t n : nodes) {
      used[n] = true;
      parent[root_of(parent, n)] = root_of(parent, nodes[0]);
    }
  std::vector<std::int32_t> order;
  MeshJoints joints;
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(mesh.num_nodes()); ++n) {
    if (!used[n]) continue;
    order.push_back(n);
    if (root_of(parent, n) == n) ++joints.parts;
  }
  const auto& x = mesh.nodes;
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return std::pair(x[a], a) < std::pair(x[b], b); });
  const double tolerance = coincidence(mesh);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Vec2 &a = x[order[i]], &b = x[order[k]];
      if (b[0] - a[0] > tolerance) break;
      if (std::abs(b[1] - a[1]) <= tolerance) {
        joints.coincident.push_back({order[i], order[k]});
        break;
      }
    }
  return joints;
}

std::string unjoined(const QuadMesh& mesh) {
  const MeshJoints joints = find_joints(mesh);
  if (joints.coincident.empty() && joints.parts <= 1) return {};
  std::string text;
  if (!joints.coincident.empty()) {
    const auto [a, b] = joints.coincident.front();
    const std::size_t n = joints.coincident.size();
    text = fmt::format("{} node{} on another node, such as {} and {} at ({:.6g}, {:.6g}) m", n,
                       n == 1 ? " lies" : "s lie", mesh.node_tags[a], mesh.node_tags[b],
                       mesh.nodes[a][0], mesh.nodes[a][1]);
  }
  if (joints.parts > 1)
    text += fmt::format("{}the section falls into {} parts that share no node",
                        text.empty() ? "" : ", and ", joints.parts);
  return text + " (the soil is not joined there)";
}

}  // namespace flowslide
