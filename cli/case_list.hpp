#pragma once
#include "core/benchmark.hpp"
#include "core/verification.hpp"

/// The one list of what `flowslide verify` and `flowslide bench` know. A module adds its cases with
/// a line in case_list.cpp.
namespace flowslide::cli {

std::vector<VerificationCase> all_verification_cases();
std::vector<BenchCase> all_benchmarks();

}  // namespace flowslide::cli
