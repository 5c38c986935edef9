#pragma once
#include "config/schema.hpp"
#include "importers/mesh_text.hpp"
#include "model/section_mesh.hpp"

#include <map>
#include <optional>
#include <string>

/// Meshes of other programs.
namespace flowslide {

struct NamedTag {
  int tag = -1;
};

struct MeshImportConfig {
  std::optional<InputFile> gmsh;
  std::optional<MeshTextConfig> tables;
  std::string length = "m";                   ///< unit of the coordinates
  std::map<std::string, NamedTag> materials;  ///< names for material tags of the file
  std::optional<double> left, right;          ///< x between which elements are kept [m]
  int divide = 0;                             ///< times that each element is divided in four
  bool mirror = false;                        ///< after the rest: the file has its toe on the left
};

/// Exactly one source, a known unit. Throws InputError.
void check(const MeshImportConfig& config);

/// The mesh with the edge sets of the file. Materials are named by the settings, else by the file,
/// else "material N". Throws InputError, FileError.
SectionMesh import_mesh(const MeshImportConfig& config);

template <>
struct Schema<MeshImportConfig> {
  static constexpr std::string_view doc =
      "A mesh of four-node quadrilaterals: exactly one of `gmsh` and `tables`.";
  static void describe(FieldVisitor& v, MeshImportConfig& c);
};

}  // namespace flowslide
