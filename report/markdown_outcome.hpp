#pragma once
#include "report/facts.hpp"

#include <string>
#include <string_view>

/// The parts of the report that say what became of the section.
namespace flowslide {

/// "-" for an unset number.
std::string number(double value, int decimals, std::string_view unit);
/// Place x as runout past the toe [m]; unset without a toe.
double past_toe(const ReportFacts& facts, double x);

std::string summary_markdown(const ReportFacts& facts, const ReportConfig& config);
std::string outcome_markdown(const ReportFacts& facts, const ReportConfig& config);
std::string foremost_markdown(const ReportFacts& facts);
std::string zone_shares_markdown(const ReportFacts& facts);

}  // namespace flowslide
