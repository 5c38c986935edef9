#pragma once
#include "study/statistics/bootstrap.hpp"

#include <vector>

namespace flowslide::study {

/// Coefficients c of the sum over k of c[k] * columns[k] that is nearest to y in the sum of
/// squares; empty where the columns do not determine them. By rotations of Givens (1958), no normal
/// equations.
std::vector<double> least_squares(const std::vector<std::vector<double>>& columns,
                                  const std::vector<double>& y);

/// y = intercept + slope * x, each with its interval.
struct Line {
  Estimate intercept, slope;
  double r2 = kUnset;  ///< share of the variance of y that the line takes away
};
/// Rows with NaN are left out; no line for fewer than four, or where x does not vary.
Line fit_line(const std::vector<double>& x, const std::vector<double>& y, const Resampling& how);

/// 1 - (sum of squares about the fit) / (sum of squares about the mean).
double share_explained(const std::vector<double>& y, const std::vector<double>& fitted);

}  // namespace flowslide::study
