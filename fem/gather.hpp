#pragma once
#include <cstdint>
#include <vector>

namespace flowslide::fem {

/// Lists, for each unknown, the element entries that add to it. Sums over a list run in one order
/// whatever the number of threads, which scattering from elements would not.
struct Gather {
  std::vector<std::int32_t> start;  ///< unknowns + 1
  std::vector<std::int32_t> entry;

  [[nodiscard]] double sum(std::int32_t unknown, const double* values) const {
    double s = 0.0;
    for (std::int32_t i = start[unknown]; i < start[unknown + 1]; ++i) s += values[entry[i]];
    return s;
  }
};

/// `unknown[k]` is the unknown that entry k adds to; entries past the last unknown are dropped.
Gather make_gather(const std::vector<std::int32_t>& unknown, std::int32_t num_unknowns);

}  // namespace flowslide::fem
