#pragma once
#include "model/history.hpp"
#include "report/facts.hpp"
#include "report/settings_text.hpp"

#include <filesystem>

namespace flowslide {

/// Writes what plot.py reads into `folder`: plot.json, final.npy (x y x0 y0 displacement material
/// strength_ratio size strength, one row per point), elements.npy (four corners, r_u, liquefied,
/// strength, material, sigma_v0), outline.npy (segments), water.npy (x, surface of the water, level
/// of the ground). Throws FileError, InputError.
void write_plot_data(const std::filesystem::path& folder, const FemHistory& history,
                     const LiquefactionZone& zone, const MpmHistory& flow, const FinalState& end,
                     const ReportFacts& facts, const ReportConfig& config,
                     const std::vector<ToldStage>& stages = {});

}  // namespace flowslide
