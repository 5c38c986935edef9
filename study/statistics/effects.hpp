#pragma once
#include "study/statistics/bootstrap.hpp"

#include <string>
#include <vector>

namespace flowslide::study {

/// How far a result moves when an input goes from its low to its high end and all others keep what
/// they have in the study.
struct Effect {
  std::string low_label, high_label;
  double low = kUnset, high = kUnset;  ///< mean result at each end
  Estimate swing;                      ///< high - low
};

/// Of a number: its ends are the rows with the lowest and the highest third of its values (the
/// lowest and highest value where it has three or fewer). Rows with NaN are left out.
Effect effect_of_number(const std::vector<double>& input, const std::vector<double>& result,
                        const Resampling& how);

/// Of a choice: its ends are the values with the smallest and the largest mean result.
Effect effect_of_choice(const std::vector<std::string>& input, const std::vector<double>& result,
                        const Resampling& how);

/// Mean of the first over mean of the second, neither with gaps, with an interval that resamples
/// each by itself.
Estimate ratio_of_means(const std::vector<double>& over, const Resampling& of_over,
                        const std::vector<double>& under, const Resampling& of_under);

}  // namespace flowslide::study
