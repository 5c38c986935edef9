#include "workflows/stages/stage_list.hpp"

namespace flowslide {

std::vector<StageType> all_stages() {
  return {import_opensees_stage(), zone_stage(), map_stage(), flow_stage(), report_stage()};
}

}  // namespace flowslide
