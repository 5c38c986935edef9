#pragma once
#include "study/table/analysis.hpp"
#include "study/table/observations.hpp"

namespace flowslide::study {

/// Adds the ratios of each result to that of every other variant, where rows agree in all inputs
/// that both have and together, or why there are none.
void add_comparisons(const Plan& plan, const Table& table, const Observations& observed,
                     const Resampling& resampling, StudyFindings& findings);

}  // namespace flowslide::study
