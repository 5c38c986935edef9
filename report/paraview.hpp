#pragma once
#include "core/progress.hpp"
#include "model/history.hpp"
#include "model/mpm_history.hpp"
#include "model/zone.hpp"

#include <filesystem>

namespace flowslide {

/// Writes flow.pvd with flow/*.vtp, the material points over time, and zone.pvd with zone.vtu, the
/// section with r_u, the liquefied zone and its strength, into `out`. Throws FileError,
/// Interrupted.
void write_paraview(const std::filesystem::path& out, const FemHistory& history,
                    const LiquefactionZone& zone, const MpmHistory& flow,
                    const Progress& progress = {});

}  // namespace flowslide
