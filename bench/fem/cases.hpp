#pragma once
#include "core/benchmark.hpp"

/// Benchmarks of the finite elements: docs/performance.md
namespace flowslide {

/// All cases of the group "fem".
std::vector<BenchCase> fem_benchmarks();

}  // namespace flowslide
