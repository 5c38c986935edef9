#include "section/mesh_section.hpp"

#include "section/quality.hpp"
#include "workflows/stages/stage_list.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct MeshSectionStage {
  static constexpr std::string_view name = "mesh.section";
  static constexpr std::string_view doc = "Meshes a section of blocks with quadrilaterals.";
  static constexpr int version = 1;
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
  static StageResult run(const RunContext&, const Config& config, const Inputs&,
                         const Outputs& out) {
    const SectionMesh section = mesh_section(config);
    write_section_mesh(out.mesh.path, section);
    const MeshQuality q = measure_quality(section.mesh);
    const nlohmann::ordered_json facts = {{"mesh_nodes", section.mesh.num_nodes()},
                                          {"mesh_elements", section.mesh.num_elements()},
                                          {"mesh_min_jacobian_ratio", q.jacobian_ratio.value},
                                          {"mesh_max_aspect", q.aspect.value},
                                          {"mesh_max_angle_off_90_deg", q.angle.value},
                                          {"mesh_shortest_edge_m", q.shortest_edge.value},
                                          {"mesh_thinnest_element_m", q.thickness.value},
                                          {"mesh_notes", section.notes}};
    return {.facts = facts.dump(), .publish = {}};
  }
};

}  // namespace

StageType mesh_section_stage() { return stage_type<MeshSectionStage>(); }

}  // namespace flowslide
