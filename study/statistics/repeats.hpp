#pragma once
#include "core/check.hpp"

#include <vector>

namespace flowslide::study {

/// Rows that are the same but for a numerical disturbance.
struct Repeats {
  std::vector<std::vector<std::size_t>> groups;  ///< rows of each, in the order of the rows
};

/// What repeating does to one number.
struct Scatter {
  std::vector<double> mean, deviation;  ///< of each group; deviation NaN for a single row
  std::size_t repeated = 0;             ///< groups of two rows or more
  double numerical = kUnset;            ///< pooled deviation within groups
  double of_inputs = kUnset;            ///< deviation of the groups' means
};

/// `group[row]` tells which rows belong together, by any numbers.
Repeats group_rows(const std::vector<std::size_t>& group);

/// Rows with NaN are left out.
Scatter scatter(const Repeats& repeats, const std::vector<double>& values);

}  // namespace flowslide::study
