#pragma once
#include "report/report.hpp"

#include <string>
#include <string_view>

namespace flowslide {

/// report.html: one file that holds text, numbers, scripts and style, and loads nothing else. Text
/// is there without scripts; charts and the player need them. Every text of a workflow is escaped,
/// and the page allows no script but its own, by hash.
/// Throws FileError, InputError, NumericsError.
std::string report_page(const ReportInputs& inputs, const ReportConfig& config,
                        const ReportFacts& facts, const FinalState& end);

/// Its style sheet, for other pages of the same look.
std::string_view page_style();

/// JSON that no browser takes for the end of the element it stands in.
std::string in_script(const std::string& json);

/// Source expression of a content security policy that allows a script or a style, by its text.
std::string policy_hash(std::string_view text);

}  // namespace flowslide
