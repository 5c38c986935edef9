#pragma once
#include "core/conventions.hpp"
#include "model/ground_motion.hpp"
#include "tests/support/data_folder.hpp"

#include <cmath>
#include <functional>

namespace flowslide::test {

/// f(t) at 0, dt, ... up to and with `end`.
inline GroundMotion sampled(double dt, double end, const std::function<double(double)>& f) {
  GroundMotion motion{.dt = dt, .acceleration = {}, .origin = "signal"};
  const int n = static_cast<int>(std::lround(end / dt));
  for (int i = 0; i <= n; ++i) motion.acceleration.push_back(f(i * dt));
  return motion;
}

inline GroundMotion harmonic(double amplitude, double frequency, double dt, double end) {
  return sampled(dt, end,
                 [=](double t) { return amplitude * std::sin(2.0 * kPi * frequency * t); });
}

}  // namespace flowslide::test
