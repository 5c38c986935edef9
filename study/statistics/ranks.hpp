#pragma once
#include "study/statistics/bootstrap.hpp"

#include <string>
#include <vector>

namespace flowslide::study {

/// 1 for the smallest; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values);

/// Product-moment correlation; NaN where one of the two does not vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y);

/// Rank correlation of Spearman (1904): the correlation of the ranks. Rows with NaN are left out;
/// no value for fewer than four.
Estimate spearman(const std::vector<double>& x, const std::vector<double>& y,
                  const Resampling& how);

/// The same among the rows of equal `level`, and its mean over levels by their rows: what goes with
/// y where levels have curves of their own. Levels of fewer than four rows do not count.
Estimate spearman_within(const std::vector<std::string>& level, const std::vector<double>& x,
                         const std::vector<double>& y, const Resampling& how);

/// The rows in which neither is NaN, as two columns.
struct Pairs {
  std::vector<double> x, y;
};
Pairs without_gaps(const std::vector<double>& x, const std::vector<double>& y);
/// How to resample these rows.
Resampling without_gaps(const Resampling& how, const std::vector<double>& x,
                        const std::vector<double>& y);

}  // namespace flowslide::study
