#pragma once
#include "workflows/engine/stage.hpp"

#include <vector>

/// Every stage that `uses:` may name. A new stage is one file here and one line in stage_list.cpp.
namespace flowslide {

StageType import_opensees_stage();
StageType mesh_section_stage();
StageType import_mesh_stage();
StageType motion_prepare_stage();
StageType fem_run_stage();
StageType zone_stage();
StageType map_stage();
StageType sordo2024_stage();
StageType flow_stage();
StageType report_stage();

std::vector<StageType> all_stages();

}  // namespace flowslide
