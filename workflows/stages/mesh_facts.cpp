#include "workflows/stages/mesh_facts.hpp"

#include "section/quality.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {

std::string mesh_facts(const SectionMesh& section) {
  const MeshQuality q = measure_quality(section.mesh);
  const nlohmann::ordered_json facts = {{"mesh_nodes", section.mesh.num_nodes()},
                                        {"mesh_elements", section.mesh.num_elements()},
                                        {"mesh_min_jacobian_ratio", q.jacobian_ratio.value},
                                        {"mesh_max_aspect", q.aspect.value},
                                        {"mesh_max_angle_off_90_deg", q.angle.value},
                                        {"mesh_shortest_edge_m", q.shortest_edge.value},
                                        {"mesh_thinnest_element_m", q.thickness.value},
                                        {"mesh_notes", section.notes}};
  return facts.dump();
}

}  // namespace flowslide
