#pragma once
#include "core/check.hpp"

#include <vector>

/// docs/theory/study-statistics.md. Sums run from the first number to the last.
namespace flowslide::study {

double mean(const std::vector<double>& values);
/// With n - 1; NaN for fewer than two.
double deviation(const std::vector<double>& values);
/// Linear between the sorted values, share 0 to 1 (type 7 of Hyndman and Fan 1996). NaN for none.
double quantile_of(std::vector<double> values, double share);

/// Shares of rows that lie above a value.
struct Exceedance {
  std::vector<double> value;  ///< sorted, smallest first
  std::vector<double> share;  ///< of a new row above value[i]
  double band = kUnset;       ///< half the width of the band that holds the whole curve in 95 %
};
Exceedance exceedance(std::vector<double> values);

}  // namespace flowslide::study
