#pragma once
#include "core/check.hpp"

/// What a stage has to do, as far as its settings tell before anything runs.
namespace flowslide {

/// In the units of a usual machine, from the rates in docs/adr/0016-expected-cost.md: what a stage
/// really takes is compared with it, and the ratio is what a machine learns.
struct Work {
  double seconds = kUnset;  ///< on one thread [s]
  double parallel = 0.0;    ///< share of them that threads divide among themselves [-]
  double memory = kUnset;   ///< at most, the program itself included [bytes]

  /// Wall time [s].
  [[nodiscard]] double on(int threads) const {
    return seconds * (1.0 - parallel + parallel / threads);
  }
};

}  // namespace flowslide
