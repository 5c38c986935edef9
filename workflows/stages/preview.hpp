#pragma once
#include "fem/config.hpp"
#include "model/section_mesh.hpp"
#include "mpm/run/flow_config.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/zone/stop_config.hpp"
#include "transfer/zone/zone_config.hpp"
#include "workflows/engine/stage.hpp"

#include <map>
#include <memory>
#include <optional>

/// What later stages may compare their settings with before anything runs: the section and the
/// settings of the stages that feed them.
namespace flowslide {

struct Preview {
  std::shared_ptr<const SectionMesh> section;  ///< null where only a run can tell
  bool shakes = false;                         ///< the history has more than the state at rest
  std::optional<double> end;                   ///< of the shaking, if settings say it [s]
  std::map<int, double> density;               ///< by material tag, of the finite elements [kg/m3]
  std::optional<WaterConfig> water;            ///< of the finite elements
  std::optional<StopAtTransferConfig> stop;
  std::optional<ZoneConfig> zone;
  std::optional<MapConfig> map;
  std::optional<FlowConfig> flow;
};

/// All that the inputs know, first come first.
Preview merged(const Previews& inputs);

}  // namespace flowslide
