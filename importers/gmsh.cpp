#include "importers/gmsh.hpp"

#include "importers/gmsh_sections.hpp"
#include "importers/mesh_faults.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr int kLine = 1, kTriangle = 2, kQuad = 3, kPoint = 15;

std::string name_of(const GmshFile& file, int dimension, int tag) {
  const auto found = file.physical_names.find({dimension, tag});
  if (found != file.physical_names.end()) return found->second;
  return fmt::format("{} {}", dimension == 2 ? "surface" : "curve", tag);
}

void check_type(const GmshFile& file, const GmshElement& e) {
  validate(e.type != kTriangle,
           "{}:{}: element {} is a triangle (quadrilaterals are needed). Recombine the surfaces in "
           "gmsh: 'Recombine Surface {{...}};', and Mesh.RecombinationAlgorithm = 3",
           file.name, e.line, e.tag);
  validate(e.type == kLine || e.type == kQuad || e.type == kPoint,
           "{}:{}: element {} has the gmsh type {} (only lines and four-node quadrilaterals of "
           "first order are read). Mesh in two dimensions with Mesh.ElementOrder = 1",
           file.name, e.line, e.tag, e.type);
}

/// Places of the nodes of quadrilaterals in the mesh, in order of the file.
std::map<std::int64_t, std::int32_t> add_nodes(const GmshFile& file, double length,
                                               QuadMesh& mesh) {
  std::set<std::int64_t> used;
  for (const GmshElement& e : file.elements)
    if (e.type == kQuad) used.insert(e.nodes.begin(), e.nodes.end());
  std::map<std::int64_t, std::int32_t> index;
  double z = kUnset;
  for (const GmshNode& n : file.nodes) {
    if (used.count(n.tag) == 0) continue;
    if (std::isnan(z)) z = n.z;
    validate(std::abs(n.z - z) <= 1e-9 * (1.0 + std::abs(z)),
             "{}:{}: node {} has z = {}, others {} (a section is plane). Draw it in x and y",
             file.name, n.line, n.tag, n.z, z);
    validate(index.emplace(n.tag, static_cast<std::int32_t>(mesh.nodes.size())).second,
             "{}:{}: node {} is given twice", file.name, n.line, n.tag);
    mesh.nodes.push_back({length * n.x, length * n.y});
    mesh.node_tags.push_back(n.tag);
  }
  return index;
}

std::int32_t find_node(const GmshFile& file, const GmshElement& e, std::int64_t node,
                       const std::map<std::int64_t, std::int32_t>& index) {
  const auto found = index.find(node);
  validate(found != index.end(), "{}:{}: element {} names node {}, which $Nodes lacks", file.name,
           e.line, e.tag, node);
  return found->second;
}

void add_quads(const GmshFile& file, const std::map<std::int64_t, std::int32_t>& index,
               SectionMesh& section) {
  std::size_t reversed = 0;
  std::set<int> materials;
  for (const GmshElement& e : file.elements) {
    check_type(file, e);
    if (e.type != kQuad) continue;
    validate(
        e.physical > 0,
        "{}:{}: element {} belongs to no physical surface (its material is unknown). Add all "
        "surfaces to physical groups in gmsh: 'Physical Surface(\"tailings\", 168) = {{...}};'",
        file.name, e.line, e.tag);
    std::array<std::int32_t, 4> nodes{};
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = find_node(file, e, e.nodes[k], index);
    std::array<Vec2, 4> quad{};
    for (std::size_t k = 0; k < 4; ++k) quad[k] = section.mesh.nodes[nodes[k]];
    if (area(quad) < 0.0) {
      std::swap(nodes[1], nodes[3]);
      ++reversed;
    }
    section.mesh.elements.push_back(nodes);
    section.mesh.element_tags.push_back(e.tag);
    section.mesh.element_material.push_back(e.physical);
    materials.insert(e.physical);
  }
  validate(!section.mesh.elements.empty(),
           "{}: no quadrilaterals (nothing to compute on). Mesh the surfaces in gmsh, with "
           "'Recombine Surface', and save all elements",
           file.name);
  for (const int tag : materials) section.materials.push_back({name_of(file, 2, tag), tag});
  if (reversed > 0)
    section.notes.push_back(
        fmt::format("{}: {} clockwise elements were reversed", file.name, reversed));
}

/// gmsh writes the elements of a surface once for each physical group that it is in.
void check_repeated(const GmshFile& file, const SectionMesh& section) {
  const auto pairs = repeated_elements(section.mesh);
  if (pairs.empty()) return;
  const auto [a, b] = pairs.front();
  const QuadMesh& mesh = section.mesh;
  const int of_a = mesh.element_material[a], of_b = mesh.element_material[b];
  const std::string groups =
      of_a == of_b
          ? fmt::format("twice in '{}'", name_of(file, 2, of_a))
          : fmt::format("in '{}' and in '{}'", name_of(file, 2, of_a), name_of(file, 2, of_b));
  throw InputError(fmt::format(
      "{}: {} elements are given twice, such as {} and {} with the same nodes, {} (their soil "
      "would count twice) put every surface into one physical group",
      file.name, pairs.size(), mesh.element_tags[a], mesh.element_tags[b], groups));
}

void check_joined(const GmshFile& file, const SectionMesh& section) {
  const std::string problem = unjoined(section.mesh);
  validate(problem.empty(),
           "{}: {} let the surfaces share their lines: 'Coherence;' in the .geo file, "
           "gmsh.model.geo.removeAllDuplicates() or, in a finished mesh, "
           "gmsh.model.mesh.removeDuplicateNodes()",
           file.name, problem);
}

void add_curves(const GmshFile& file, const std::map<std::int64_t, std::int32_t>& index,
                SectionMesh& section) {
  using Edge = std::array<std::int32_t, 2>;
  std::set<Edge> edges;
  for (const auto& n : section.mesh.elements)
    for (std::size_t k = 0; k < 4; ++k) edges.insert({n[k], n[(k + 1) % 4]});
  std::map<std::string, std::vector<Edge>> curves;
  // Two groups may have one name: their common lines count once.
  std::set<std::pair<std::string, Edge>> seen;
  const auto add = [&](const GmshElement& e, const Edge& edge) {
    const std::string name = name_of(file, 1, e.physical);
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    if (seen.insert({name, {low, high}}).second) curves[name].push_back(edge);
  };
  std::size_t lost = 0;
  for (const GmshElement& e : file.elements) {
    if (e.type != kLine || e.physical <= 0) continue;
    const auto a = index.find(e.nodes[0]), b = index.find(e.nodes[1]);
    if (a == index.end() || b == index.end()) {
      ++lost;
      continue;
    }
    const Edge with{a->second, b->second}, against{b->second, a->second};
    // Outer edges have the soil on the left.
    if (edges.count(with) > 0)
      add(e, with);
    else if (edges.count(against) > 0)
      add(e, against);
    else
      ++lost;
  }
  for (auto& [name, list] : curves) section.sets.push_back({name, std::move(list)});
  if (lost > 0)
    section.notes.push_back(fmt::format(
        "{}: {} lines of physical curves are no edges of quadrilaterals and were left out",
        file.name, lost));
}

}  // namespace

SectionMesh read_gmsh(const std::filesystem::path& path, double length) {
  const GmshFile file = read_gmsh_file(path);
  SectionMesh section;
  section.notes = file.notes;
  const auto index = add_nodes(file, length, section.mesh);
  add_quads(file, index, section);
  add_curves(file, index, section);
  try {
    check(section);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", file.name, e.what()));
  }
  check_repeated(file, section);
  check_joined(file, section);
  return section;
}

}  // namespace flowslide
