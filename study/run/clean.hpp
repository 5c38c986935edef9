#pragma once
#include "study/run/study_state.hpp"

namespace flowslide::study {

struct Cleaned {
  std::size_t results = 0;  ///< keys of which something was taken away
  double bytes = 0.0;
  std::size_t in_use = 0;  ///< left, because another process uses them
};

/// Takes away what no row of the plan needs: results, what is known of them, work that was begun.
Cleaned clean(const Plan& plan, const Store& store, const StudyState& progress, bool dry_run);

}  // namespace flowslide::study
