#pragma once
#include "report/figures.hpp"
#include "report/report.hpp"

#include <string>

namespace flowslide {

/// The text of report.md.
std::string report_markdown(const ReportInputs& inputs, const ReportConfig& config,
                            const ReportFacts& facts, const DrawnFigures& drawn);

}  // namespace flowslide
