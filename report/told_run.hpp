#pragma once
#include "report/npy.hpp"
#include "report/report.hpp"

#include <string>
#include <utility>
#include <vector>

/// What a reader needs to judge a run without its workflow file, as Markdown and numbers.
namespace flowslide {

/// Surface of the rigid ground as rows x, y [m], from mpm.run; empty if it is not told.
Table ground_line(const std::vector<ToldStage>& stages);

/// Tags of the mesh with the names of their soils, from transfer.map or mesh.section.
std::vector<std::pair<int, std::string>> soil_names(const std::vector<ToldStage>& stages);

/// "How sure, why, and what would change it": what the run itself says about each.
std::string told_judgement(const ReportInputs& in, const ReportConfig& config,
                           const ReportFacts& facts, const FinalState& end);

/// Motion, mesh, soils of shaking and flow, residual strength, grid.
std::string told_inputs(const ReportInputs& in);

/// Every setting of every stage, one table each.
std::string told_settings(const ToldStage& stage);

}  // namespace flowslide
