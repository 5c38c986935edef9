#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flowslide::study {

inline constexpr std::size_t kSobolInputs = 21;

/// Points `index` 0, 1, ... of the sequence of Sobol (1967) with the directions of Joe and Kuo
/// (2008), as integers of 32 bits: coordinate = value / 2^32.
std::vector<std::uint32_t> sobol_point(std::size_t index, std::size_t inputs);

}  // namespace flowslide::study
