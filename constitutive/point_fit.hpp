#pragma once
#include "constitutive/point_config.hpp"

#include <functional>

/// A parameter of a law from the cyclic strength that its soil is to have.
namespace flowslide {

/// The shear strain is first reached after so many cycles.
struct CyclicTarget {
  double cycles = kUnset;
  double strain = 0.03;
};

struct PointFit {
  double value;   ///< four digits
  double cycles;  ///< with it: `target` or, where they jump, more
  int tests;      ///< that it took
};

/// The value at which `cycles(value)` passes `target`, on the side where it is not below; within
/// two thousandths. Searched from `start` (> 0) by factors of two to both sides, up to a
/// thousandfold or until `cycles` throws InputError or NumericsError; cycles may rise or fall with
/// the value. Throws what `cycles` throws at the start, and InputError if the target is not passed.
PointFit fit_to_cycles(double start, double target, const std::function<double(double)>& cycles);

}  // namespace flowslide
