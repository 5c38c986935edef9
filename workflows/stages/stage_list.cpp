#include "workflows/stages/stage_list.hpp"

namespace flowslide {

std::vector<StageType> all_stages() {
  return {mesh_section_stage(),
          import_mesh_stage(),
          motion_prepare_stage(),
          import_opensees_stage(),
          fem_run_stage(),
          zone_stage(),
          map_stage(),
          sordo2024_stage(),
          flow_stage(),
          report_stage()};
}

}  // namespace flowslide
