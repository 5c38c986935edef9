#pragma once
#include "model/mesh.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// A section ready for a finite-element run: mesh, names of its materials, named edges. On disk:
/// HDF5, kind "mesh".
namespace flowslide {

struct MaterialName {
  std::string name;
  std::int32_t tag = 0;  ///< as in QuadMesh::element_material
};

/// Element edges that belong together, as node indices in walking order. On the outer boundary the
/// soil is on the left; inside (a drain) the direction has no meaning.
///
/// Sections of straight vertical ends have the sets "base", "right", "surface" and "left", which
/// cover the outer boundary once, counter-clockwise.
struct EdgeSet {
  std::string name;
  std::vector<std::array<std::int32_t, 2>> edges;
};

struct SectionMesh {
  QuadMesh mesh;
  std::vector<MaterialName> materials;  ///< one for each tag that occurs, by ascending tag
  std::vector<EdgeSet> sets;            ///< unique names
  std::vector<std::string> notes;       ///< what is unusual about the mesh, one line each
};

/// The set of that name. Throws InputError with the names that there are.
const EdgeSet& find_set(const SectionMesh& section, std::string_view name);

/// Tag of a material. Throws InputError with the names that there are.
std::int32_t material_tag(const SectionMesh& section, std::string_view name);

/// Node indices of a set, each once, ascending.
std::vector<std::int32_t> nodes_of(const EdgeSet& set);

/// Mesh as by check(const QuadMesh&); names unique; every material tag named; every edge of a set
/// an edge of an element. Throws InputError.
void check(const SectionMesh& section);

void write_section_mesh(const std::filesystem::path& path, const SectionMesh& section);
SectionMesh read_section_mesh(const std::filesystem::path& path);

}  // namespace flowslide
