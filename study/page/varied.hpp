#pragma once
#include "study/table/analysis.hpp"

#include <string>

namespace flowslide::study {

/// ": 120 of base, 4 of static, and 10 repeats of them"; empty where there is one kind of row.
std::string counted_rows(const Plan& plan);

/// Section: inputs with their values and the settings that they set, what repeats disturb, what the
/// study sets for all rows, and what the numbers mean. For whoever does not have the study file.
std::string what_was_varied(const Plan& plan, const Table& table, const StudyFindings& f);

/// The first result over the two inputs of few values that move it most: median, least and largest
/// of the means of repeats. Empty without such inputs.
std::string levels_table(const Table& table, const StudyFindings& f);

}  // namespace flowslide::study
