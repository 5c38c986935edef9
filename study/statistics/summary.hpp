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

struct Weighted {
  double value = 0.0, weight = 1.0;
};

/// Shares of rows that lie above a value.
struct Exceedance {
  std::vector<double> value;  ///< sorted, smallest first
  std::vector<double> share;  ///< of a new row above value[i]
  std::vector<double> weight;
  double band = kUnset;  ///< half the width of the band that holds the whole curve in 95 %
};
/// The sum of the weights is the number of rows; repeats of a row share its weight.
Exceedance exceedance(std::vector<Weighted> values);
/// The same as of values where all weights are equal.
double weighted_quantile(const Exceedance& values, double share);

}  // namespace flowslide::study
