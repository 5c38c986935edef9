#include "importers/mesh_import.hpp"

#include "core/check.hpp"
#include "core/units.hpp"
#include "importers/gmsh.hpp"
#include "importers/mesh_edit.hpp"
#include "importers/mesh_faults.hpp"
#include "importers/mesh_overlap.hpp"
#include "model/mirror.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

namespace flowslide {

template <>
struct Schema<NamedTag> {
  static constexpr std::string_view doc = "A material of the file.";
  static void describe(FieldVisitor& v, NamedTag& c) {
    v.integer("tag", c.tag, {.min = 0}, "its number in the file");
  }
};

void Schema<MeshImportConfig>::describe(FieldVisitor& v, MeshImportConfig& c) {
  v.file("gmsh", c.gmsh, "mesh of gmsh, .msh 2.2 or 4.1, text");
  v.group("tables", c.tables, "nodes and elements as text tables");
  v.text("length", c.length, "unit of the coordinates: m, mm, cm, km");
  v.table("materials", c.materials, "names of materials by their number in the file");
  v.quantity("left", c.left, Dim::length, {},
             "elements that reach beyond this x are left out, such as free-field columns");
  v.quantity("right", c.right, Dim::length, {}, "the same at the other end");
  v.integer("divide", c.divide, {.min = 0, .max = 4},
            "how often each element is divided in four, which halves its size");
  v.flag("mirror", c.mirror,
         "for a mesh with its toe on the left: x changes its sign, after `left` and `right`; sets "
         "named left and right change their names");
}

namespace {

SectionMesh from_tables(const MeshTextConfig& config, double length) {
  MeshText text = read_mesh_text(config, length);
  const std::string problem = unjoined(text.mesh);
  validate(problem.empty(), "{}: {} let elements that touch name the same nodes",
           config.nodes.path.filename().string(), problem);
  SectionMesh section;
  section.mesh = std::move(text.mesh);
  section.notes = std::move(text.notes);
  if (const auto loose = drop_loose_nodes(section.mesh); !loose.empty())
    section.notes.push_back(fmt::format(
        "{}: {} node{} to no element and {} left out, the first is node {}. Is a row of {} missing "
        "or wrong?",
        config.nodes.path.filename().string(), loose.size(),
        loose.size() == 1 ? " belongs" : "s belong", loose.size() == 1 ? "is" : "are",
        loose.front(), config.elements.path.filename().string()));
  const std::set<std::int32_t> tags(section.mesh.element_material.begin(),
                                    section.mesh.element_material.end());
  for (const std::int32_t tag : tags)
    section.materials.push_back({fmt::format("material {}", tag), tag});
  return section;
}

void rename(SectionMesh& section, const std::map<std::string, NamedTag>& names) {
  for (const auto& [name, material] : names) {
    const auto found =
        std::find_if(section.materials.begin(), section.materials.end(),
                     [tag = material.tag](const MaterialName& m) { return m.tag == tag; });
    if (found == section.materials.end()) {
      std::string tags;
      for (const MaterialName& m : section.materials) tags += fmt::format(" {}", m.tag);
      throw InputError(fmt::format(
          "materials: '{}' has the tag {}, which no element of the mesh has (tags:{}). Correct the "
          "tag or leave the material out",
          name, material.tag, tags));
    }
    found->name = name;
  }
}

/// After `left` and `right`: what they leave out may lie anywhere.
void check_overlap(const MeshImportConfig& config, const QuadMesh& mesh) {
  const std::string problem = overlap(mesh);
  const auto& path = config.gmsh ? config.gmsh->path : config.tables->nodes.path;
  validate(problem.empty(), "{}: {} {}", path.filename().string(), problem,
           config.gmsh ? "move surfaces that lie over each other apart, and let neighbours share "
                         "their points and lines: 'Coherence;' or BooleanFragments in the .geo file"
                       : "move elements that lie over each other apart, and let elements that "
                         "touch name the same nodes");
}

/// Elements have one material, so a number has one name.
void check_distinct_tags(const std::map<std::string, NamedTag>& names) {
  std::map<int, std::string> seen;
  for (const auto& [name, material] : names) {
    const auto [at, is_new] = seen.emplace(material.tag, name);
    validate(is_new,
             "materials: '{}' and '{}' have the same tag {} (its elements can have one name only) "
             "correct one of the tags or leave the material out",
             at->second, name, material.tag);
  }
}

/// A side that cuts nothing off was meant to.
void note_idle_cuts(SectionMesh& section, const MeshImportConfig& config) {
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Vec2& p : section.mesh.nodes) {
    begin = std::min(begin, p[0]);
    end = std::max(end, p[0]);
  }
  const auto note = [&](const char* side, const char* what, double at, double where) {
    section.notes.push_back(
        fmt::format("{}: x = {:g} m leaves nothing out, as the mesh {} at x = {:g} m. Are its "
                    "number and unit right?",
                    side, at, what, where));
  };
  if (config.left && *config.left < begin) note("left", "begins", *config.left, begin);
  if (config.right && *config.right > end) note("right", "ends", *config.right, end);
}

}  // namespace

void check(const MeshImportConfig& config) {
  validate(config.gmsh.has_value() != config.tables.has_value(),
           "{} of `gmsh` and `tables` (exactly one is the mesh)", config.gmsh ? "both" : "neither");
  validate(!config.left || !config.right || *config.left < *config.right,
           "left = {:g} m is not left of right = {:g} m (nothing lies between) exchange them?",
           config.left.value_or(0.0), config.right.value_or(0.0));
  (void)unit_factor(config.length, Dim::length);
  check_distinct_tags(config.materials);
}

SectionMesh import_mesh(const MeshImportConfig& config) {
  check(config);
  const double length = unit_factor(config.length, Dim::length);
  SectionMesh section =
      config.gmsh ? read_gmsh(config.gmsh->path, length) : from_tables(*config.tables, length);
  note_idle_cuts(section, config);
  if (config.left || config.right) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    keep_between(section, config.left.value_or(-kFar), config.right.value_or(kFar));
  }
  check_overlap(config, section.mesh);
  for (int i = 0; i < config.divide; ++i) divide_in_four(section);
  rename(section, config.materials);
  if (config.mirror) mirror(section);
  check(section);
  return section;
}

}  // namespace flowslide
