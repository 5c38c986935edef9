#pragma once
#include "core/benchmark.hpp"

/// Benchmarks of the material-point method: docs/performance.md
namespace flowslide {

/// All cases of the group "mpm".
std::vector<BenchCase> mpm_benchmarks();

}  // namespace flowslide
