#pragma once
#include "study/run/locks.hpp"
#include "study/run/study_state.hpp"

namespace flowslide::study {

/// Takes the files away that the plan does not keep and that no stage still to run reads; above
/// plan.disk_bytes also others, first those that are made again most cheaply for their size. What
/// another process uses stays. Returns the bytes that the store takes afterwards.
double tidy(const Plan& plan, const Store& store, const StudyState& progress, Locks& locks);

}  // namespace flowslide::study
