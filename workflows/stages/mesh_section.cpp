#include "section/mesh_section.hpp"

#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/mesh_facts.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

namespace flowslide {
namespace {

struct MeshSectionStage {
  static constexpr std::string_view name = "mesh.section";
  static constexpr std::string_view doc = "Meshes a section of blocks with quadrilaterals.";
  static constexpr int version = 2;
  static constexpr bool checkpoints = false;
  using Config = SectionConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<SectionMesh> mesh{"mesh.h5"};
    void visit(auto&& port) { port("mesh", mesh); }
  };
  /// Meshing takes less than a second, and most errors of a section show in the mesh only.
  static void check(const Config& config) { (void)mesh_section(config); }
  static std::any preview(const Config& config, const Previews&, Findings& found) {
    Preview p;
    p.section = std::make_shared<const SectionMesh>(mesh_section(config));
    found.warnings = p.section->notes;
    check_size(p.section->mesh, found);
    found.work = mesh_work(p.section->mesh);
    return p;
  }
  static StageResult run(const RunContext&, const Config& config, const Inputs&,
                         const Outputs& out) {
    const SectionMesh section = mesh_section(config);
    write_section_mesh(out.mesh.path, section);
    return {.facts = mesh_facts(section), .publish = {}, .warnings = section.notes};
  }
};

}  // namespace

StageType mesh_section_stage() { return stage_type<MeshSectionStage>(); }

}  // namespace flowslide
