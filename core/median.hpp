#pragma once
#include <algorithm>
#include <limits>
#include <vector>

namespace flowslide {

/// The value in the middle, of an even number the upper of the two; NaN without any.
inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace flowslide
