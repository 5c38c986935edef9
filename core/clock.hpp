#pragma once
#include <chrono>

namespace flowslide {

/// Goes on evenly, whatever becomes of the date of the machine.
using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace flowslide
