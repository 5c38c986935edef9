#pragma once
#include "fem/config.hpp"
#include "model/section_mesh.hpp"
#include "mpm/run/flow_config.hpp"
#include "report/config.hpp"
#include "transfer/map/map_config.hpp"
#include "workflows/engine/work.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <optional>
#include <vector>

/// How much there is to do in each stage: rates of a usual machine and where they come from in
/// docs/adr/0016-expected-cost.md.
namespace flowslide {

/// Elements times what is done to each.
Work mesh_work(const QuadMesh& mesh);
/// `end` of the shaking [s]; nothing where only the motion tells.
/// `until`: the end of the shaking or its motion, if known [s].
Work shaking_work(const FemConfig& config, const QuadMesh& mesh, std::optional<double> until,
                  bool stops_at_transfer);
Work zone_work(const QuadMesh& mesh, bool shakes, std::optional<double> end);
Work map_work(const MapConfig& map, const Soil& soil);
/// Points times the steps until it may be at rest.
Work flow_work(const FlowConfig& flow, const MapConfig& map,
               const std::vector<HistoryMaterial>& materials, const Soil& soil);
Work motion_work();
Work report_work(const ReportConfig& config);

}  // namespace flowslide
