#pragma once
#include "study/numbers/correlation.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

/// Where in the space of the inputs the rows of a study lie.
namespace flowslide::study {

enum class Sampling { latin_hypercube, sobol, random };
inline constexpr std::array<std::string_view, 3> kSamplings{"latin_hypercube", "sobol", "random"};

/// `count` points with `inputs` coordinates in (0, 1), the first index counts points. Equal
/// arguments give equal bits everywhere. docs/theory/study-statistics.md
std::vector<std::vector<double>> sample_points(Sampling method, std::size_t count,
                                               std::size_t inputs, std::uint64_t seed,
                                               const std::vector<Correlated>& pairs);

}  // namespace flowslide::study
