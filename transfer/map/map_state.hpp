#pragma once
#include "core/progress.hpp"
#include "model/history.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "transfer/audit/audit.hpp"
#include "transfer/map/map_config.hpp"

/// From finite elements to material points at the moment of transfer: seeding, fields, return to
/// the yield surface, audit. Theory: docs/theory/transfer.md
namespace flowslide {

struct MapResult {
  ParticleSet particles;
  TransferAudit audit;
};

/// The frame is that of the zone. Throws InputError for data that do not fit together, and
/// NumericsError listing the checks of the audit that exceed their limits, unless the config says
/// not to enforce them; Interrupted.
MapResult map_state(const FemHistory& history, const LiquefactionZone& zone,
                    const MapConfig& config, const Progress& progress = {});

/// The same from states in memory; `shaking` null transfers the state at rest.
MapResult map_state(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                    const FemFrame& gravity, const FemFrame* shaking, const LiquefactionZone& zone,
                    const MapConfig& config, const Progress& progress = {});

}  // namespace flowslide
