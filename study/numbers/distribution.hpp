#pragma once
#include "core/check.hpp"

#include <limits>

namespace flowslide::study {

enum class Shape { uniform, triangular, normal, lognormal };

/// A distribution of a number, in the unit in which the user gave it. docs/theory/study-statistics.md
struct Distribution {
  Shape shape = Shape::uniform;
  double from = kUnset, mode = kUnset, to = kUnset;  ///< uniform, triangular
  double mean = kUnset, deviation = kUnset;          ///< normal, lognormal: of the number itself
  /// Normal and lognormal: what lies outside is cut off, the rest keeps its shape.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// InputError "problem (why) what to do" if there is no such distribution.
void check(const Distribution& d);

/// The value with the probability u in (0, 1) below it.
double quantile(const Distribution& d, double u);

}  // namespace flowslide::study
