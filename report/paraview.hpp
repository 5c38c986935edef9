#pragma once
#include "model/history.hpp"
#include "model/mpm_history.hpp"
#include "model/zone.hpp"

#include <filesystem>

namespace flowslide {

/// Writes flow.pvd with flow/*.vtp, the material points over time, and zone.pvd with zone.vtu, the
/// section with r_u, the liquefied zone and its strength, into `out`. Throws FileError.
void write_paraview(const std::filesystem::path& out, const FemHistory& history,
                    const LiquefactionZone& zone, const MpmHistory& flow);

}  // namespace flowslide
