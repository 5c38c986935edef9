#include "model/section_mesh.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"
#include "model/mesh_store.hpp"
#include "model/names_of.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr std::string_view kMesh = "mesh";
constexpr int kMeshFormat = 1;

template <class T>
void check_names(const std::vector<T>& items, const char* what) {
  std::set<std::string> seen;
  for (const T& item : items)
    validate(!item.name.empty() && seen.insert(item.name).second,
             "the mesh has two {}s '{}' (a name must tell one from the other); rename one", what,
             item.name);
}

void check_material_tags(const SectionMesh& section) {
  std::set<std::int32_t> named;
  for (const MaterialName& m : section.materials)
    validate(named.insert(m.tag).second,
             "material '{}' has the tag {} of another material (their elements would be one); give "
             "it its own tag",
             m.name, m.tag);
  for (std::size_t e = 0; e < section.mesh.num_elements(); ++e)
    validate(named.count(section.mesh.element_material[e]) > 0,
             "element {} has the material tag {}, which has no name (known: {})",
             section.mesh.element_tags[e], section.mesh.element_material[e],
             names_of(section.materials));
}

void check_sets(const SectionMesh& section) {
  std::set<std::array<std::int32_t, 2>> edges;
  for (const auto& n : section.mesh.elements)
    for (std::size_t k = 0; k < 4; ++k) edges.insert({n[k], n[(k + 1) % 4]});
  for (const EdgeSet& set : section.sets)
    for (const auto& [a, b] : set.edges)
      validate(edges.count({a, b}) > 0 || edges.count({b, a}) > 0,
               "set '{}' joins the node indices {} and {} (no element has that edge)", set.name, a,
               b);
}

}  // namespace

const EdgeSet& find_set(const SectionMesh& section, std::string_view name) {
  for (const EdgeSet& set : section.sets)
    if (set.name == name) return set;
  throw InputError(
      fmt::format("the mesh has no set '{}' (known: {})", name, names_of(section.sets)));
}

std::int32_t material_tag(const SectionMesh& section, std::string_view name) {
  for (const MaterialName& m : section.materials)
    if (m.name == name) return m.tag;
  throw InputError(
      fmt::format("the mesh has no material '{}' (known: {})", name, names_of(section.materials)));
}

std::vector<std::int32_t> nodes_of(const EdgeSet& set) {
  std::set<std::int32_t> nodes;
  for (const auto& [a, b] : set.edges) nodes.insert({a, b});
  return {nodes.begin(), nodes.end()};
}

void check(const SectionMesh& section) {
  check(section.mesh);
  check_names(section.materials, "material");
  check_names(section.sets, "set");
  check_material_tags(section);
  check_sets(section);
}

void write_section_mesh(const std::filesystem::path& path, const SectionMesh& section) {
  check(section);
  FieldWriter out(path, kMesh, kMeshFormat);
  write_mesh(out, section.mesh);
  std::vector<std::string> material_names, set_names;
  std::vector<std::int32_t> tags, edge_set;
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const MaterialName& m : section.materials) {
    material_names.push_back(m.name);
    tags.push_back(m.tag);
  }
  for (std::size_t i = 0; i < section.sets.size(); ++i) {
    set_names.push_back(section.sets[i].name);
    for (const auto& edge : section.sets[i].edges) {
      edges.push_back(edge);
      edge_set.push_back(static_cast<std::int32_t>(i));
    }
  }
  out.write_texts("materials/name", material_names);
  out.write("materials/tag", tags, {.unit = "", .convention = "as in mesh/element_material"});
  out.write_texts("sets/name", set_names);
  out.write("sets/edge", edges,
            {.unit = "", .convention = "rows of mesh/nodes; soil on the left of outer edges"});
  out.write("sets/edge_set", edge_set, {.unit = "", .convention = "row of sets/name"});
  out.write_texts("notes", section.notes);
  out.finish();
}

SectionMesh read_section_mesh(const std::filesystem::path& path) {
  const FieldReader in(path, kMesh, kMeshFormat);
  SectionMesh section;
  section.mesh = read_mesh(in);
  const std::vector<std::string> names = in.read_texts("materials/name");
  const auto tags = in.read<std::int32_t>("materials/tag", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) section.materials.push_back({names[i], tags[i]});
  for (const std::string& name : in.read_texts("sets/name")) section.sets.push_back({name, {}});
  const auto edges = in.read<std::array<std::int32_t, 2>>("sets/edge");
  const auto edge_set = in.read<std::int32_t>("sets/edge_set", edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto set = static_cast<std::size_t>(edge_set[i]);
    validate(edge_set[i] >= 0 && set < section.sets.size(),
             "'{}': edge {} belongs to set {} (there are {})", path.string(), i, edge_set[i],
             section.sets.size());
    section.sets[set].edges.push_back(edges[i]);
  }
  section.notes = in.read_texts("notes");
  try {
    check(section);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}': {}", path.string(), error.what()));
  }
  return section;
}

}  // namespace flowslide
