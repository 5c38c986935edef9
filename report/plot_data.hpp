#pragma once
#include "model/history.hpp"
#include "report/facts.hpp"

#include <filesystem>

namespace flowslide {

/// Writes what plot.py reads into `folder`: plot.json, final.npy (x y x0 y0 displacement material
/// strength_ratio size, one row per point), elements.npy (four corners, r_u, liquefied, strength,
/// material, sigma_v0), outline.npy and water.npy (segments). Throws FileError, InputError.
void write_plot_data(const std::filesystem::path& folder, const FemHistory& history,
                     const LiquefactionZone& zone, const MpmHistory& flow, const FinalState& end,
                     const ReportFacts& facts, const ReportConfig& config);

}  // namespace flowslide
