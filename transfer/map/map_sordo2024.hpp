#pragma once
#include "transfer/map/map_state.hpp"

namespace flowslide {

/// compat: sordo2024: the points of the published script with the audit of this program. The
/// defects of the script exceed the limits of the audit by design, so they are reported and never
/// enforced.
MapResult map_sordo2024_audited(const FemHistory& history, const MapConfig& config);

}  // namespace flowslide
