#pragma once
#include "study/plan/plan.hpp"

namespace flowslide::study {

/// Refuses columns of `analysis` that no stage of the rows can give: the night would pass before
/// their lack was seen. Silent where a row has a problem, or a stage of which it is not known what
/// it gives.
void check_results(const StudyFile& study, const Plan& plan);

}  // namespace flowslide::study
