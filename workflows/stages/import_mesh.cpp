#include "importers/mesh_import.hpp"
#include "section/boundary.hpp"
#include "section/quality.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/mesh_facts.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

namespace flowslide {
namespace {

SectionMesh imported(const MeshImportConfig& config) {
  SectionMesh section = import_mesh(config);
  add_outer_sets(section);
  for (std::string& note : quality_notes(section.mesh, measure_quality(section.mesh)))
    section.notes.push_back(std::move(note));
  return section;
}

struct ImportMeshStage {
  static constexpr std::string_view name = "import.mesh";
  static constexpr std::string_view doc = "Reads a mesh of gmsh, or tables of nodes and elements.";
  static constexpr int version = 3;
  static constexpr bool checkpoints = false;
  using Config = MeshImportConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<SectionMesh> mesh{"mesh.h5"};
    void visit(auto&& port) { port("mesh", mesh); }
  };
  static void check(const Config& config) { flowslide::check(config); }
  static std::any preview(const Config& config, const Previews&, Findings& found) {
    Preview p;
    p.section = std::make_shared<const SectionMesh>(imported(config));
    found.warnings = p.section->notes;
    check_size(p.section->mesh, found);
    found.work = mesh_work(p.section->mesh);
    return p;
  }
  static StageResult run(const RunContext&, const Config& config, const Inputs&,
                         const Outputs& out) {
    const SectionMesh section = imported(config);
    write_section_mesh(out.mesh.path, section);
    return {.facts = mesh_facts(section), .publish = {}, .warnings = section.notes};
  }
};

}  // namespace

StageType import_mesh_stage() { return stage_type<ImportMeshStage>(); }

}  // namespace flowslide
