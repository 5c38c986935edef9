#pragma once
#include "report/figures.hpp"
#include "report/report.hpp"

#include <string>
#include <vector>

namespace flowslide {

/// A heading of the report and the Markdown below it.
struct ReportSection {
  std::string title;
  std::string text;
};

/// The result in words: what stands under the title.
std::string report_summary(const ReportFacts& facts, const ReportConfig& config);

/// Warnings of all stages before it and of the report.
std::vector<std::string> all_warnings(const ReportInputs& inputs, const ReportFacts& facts);

/// What stands below summary and warnings, without figures.
std::vector<ReportSection> report_sections(const ReportInputs& inputs, const ReportConfig& config,
                                           const ReportFacts& facts, const FinalState& end);

/// The text of report.md.
std::string report_markdown(const ReportInputs& inputs, const ReportConfig& config,
                            const ReportFacts& facts, const FinalState& end,
                            const DrawnFigures& drawn);

}  // namespace flowslide
