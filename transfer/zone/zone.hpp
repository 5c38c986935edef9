#pragma once
#include "core/progress.hpp"
#include "model/history.hpp"
#include "model/zone.hpp"
#include "transfer/zone/zone_config.hpp"

namespace flowslide {

/// Finds the liquefied zone, its strengths and the transfer time
/// (docs/theory/liquefaction-zone.md). Reads the frames one at a time, those up to the transfer
/// twice. A history without frames leaves the vectors of ZoneHistory empty.
///
/// Throws InputError: settings that contradict each other or the mesh, state that is not finite
/// where it is needed, a transfer time outside the record. Throws Interrupted between frames.
LiquefactionZone find_zone(const FemHistory& history, const ZoneConfig& config,
                           const Progress& progress = {});

}  // namespace flowslide
