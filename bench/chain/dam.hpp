#pragma once
#include "core/benchmark.hpp"

/// Benchmarks that need several modules at once: docs/performance.md
namespace flowslide {

/// The dam of workflows/mochikoshi.yaml while it liquefies, finite elements only: error against
/// seconds over the size of elements, and what each saving costs. Cases "fem/dam/...".
std::vector<BenchCase> dam_benchmarks();

}  // namespace flowslide
