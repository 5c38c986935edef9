#pragma once
#include <cstdint>
#include <string>

/// Runs with settings drawn at random over twenty decades: each has to end by itself, as a run or
/// with an error that says why.
namespace flowslide::mpm {

struct Extreme {
  int code = 0;         ///< what the program would end with: 0, 2 or 3
  std::string message;  ///< of the error
  std::string scene;    ///< the numbers drawn
};

/// The run that belongs to a seed: the same on every machine.
Extreme run_extreme(std::uint64_t seed);

}  // namespace flowslide::mpm
