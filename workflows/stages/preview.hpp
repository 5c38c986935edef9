#pragma once
#include "fem/config.hpp"
#include "model/history_material.hpp"
#include "model/section_mesh.hpp"
#include "mpm/run/flow_config.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/zone/stop_config.hpp"
#include "transfer/zone/zone_config.hpp"
#include "workflows/engine/stage.hpp"

#include <memory>
#include <optional>
#include <vector>

/// What later stages may compare their settings with before anything runs: the section and the
/// settings of the stages that feed them.
namespace flowslide {

struct Preview {
  std::shared_ptr<const SectionMesh> section;  ///< null where only a run can tell
  std::optional<double> motion_end;            ///< of the ground motion, if known [s]
  std::optional<double> mean_period;           ///< of the ground motion, likewise [s]
  std::optional<double> top_frequency;         ///< below which 4/5 of its energy lie [Hz]
  bool shakes = false;                         ///< the history has more than the state at rest
  std::optional<double> end;                   ///< of the shaking, if settings say it [s]
  std::vector<HistoryMaterial> materials;      ///< of the section; empty where only a run can tell
  std::optional<WaterConfig> water;            ///< of the finite elements
  std::shared_ptr<const FemConfig> fem;        ///< settings of the shaking; null of an import
  std::optional<double> toe;                   ///< that a report gives [m]
  std::optional<StopAtTransferConfig> stop;
  std::optional<ZoneConfig> zone;
  std::optional<MapConfig> map;
  std::optional<FlowConfig> flow;
};

/// All that the inputs know, first come first.
Preview merged(const Previews& inputs);

}  // namespace flowslide
