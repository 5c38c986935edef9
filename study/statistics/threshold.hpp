#pragma once
#include "study/statistics/bootstrap.hpp"

#include <vector>

namespace flowslide::study {

/// Where a response begins and where it stops to grow: the ramp
///   y = plateau * clamp((x - breach) / (saturation - breach), 0, 1)
/// that is nearest to the rows in the sum of squares. docs/theory/study-statistics.md
struct Ramp {
  Estimate breach;      ///< x below which there is no response
  Estimate saturation;  ///< x above which it does not grow
  Estimate plateau;     ///< y beyond that
  /// Share of resamples in which the ramp begins at the smallest x, or ends at the largest: there
  /// the rows show no such threshold.
  double no_breach = kUnset, no_saturation = kUnset;
  double r2 = kUnset;       ///< of the ramp
  double line_r2 = kUnset;  ///< of a straight line through the same rows
  /// Are the thresholds seen?
  [[nodiscard]] bool begins() const;
  [[nodiscard]] bool ends() const;
};

/// Largest share of resamples without a threshold for which it still counts as seen.
inline constexpr double kMostWithout = 0.05;
inline bool Ramp::begins() const { return no_breach <= kMostWithout; }
inline bool Ramp::ends() const { return no_saturation <= kMostWithout; }

inline constexpr std::size_t kFewestForRamp = 8;

/// Rows with NaN are left out; nothing for fewer than kFewestForRamp rows.
Ramp fit_ramp(const std::vector<double>& x, const std::vector<double>& y, const Resampling& how);

}  // namespace flowslide::study
