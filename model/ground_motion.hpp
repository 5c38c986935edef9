#pragma once
#include "core/check.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace flowslide {

/// One component of ground acceleration at constant time step; sample i is at i dt.
struct GroundMotion {
  double dt = kUnset;                ///< [s]
  std::vector<double> acceleration;  ///< [m/s2]
  std::string origin;                ///< where it came from and what was done to it, for reports

  /// From the first to the last sample [s].
  [[nodiscard]] double duration() const {
    return acceleration.empty() ? 0.0 : dt * static_cast<double>(acceleration.size() - 1);
  }
};

/// A positive step, at least two samples, every sample finite, not all of them zero. Throws
/// InputError.
inline void check(const GroundMotion& motion) {
  validate(std::isfinite(motion.dt) && motion.dt > 0.0,
           "{}: the time step is {} s (it must be positive)", motion.origin, motion.dt);
  validate(motion.acceleration.size() >= 2, "{}: {} samples (a motion needs at least two)",
           motion.origin, motion.acceleration.size());
  bool moves = false;
  for (std::size_t i = 0; i < motion.acceleration.size(); ++i) {
    const double a = motion.acceleration[i];
    validate(std::isfinite(a), "{}: the acceleration of sample {} is {} (not a finite number)",
             motion.origin, i + 1, a);
    moves = moves || a != 0.0;
  }
  validate(moves, "{}: every acceleration is zero (nothing to measure or to scale)", motion.origin);
}

}  // namespace flowslide
