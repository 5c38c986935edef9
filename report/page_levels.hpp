#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Rows of whole numbers of 1 or 2 bytes as a page stores them: of each the difference from last
/// row's value plus what the neighbour before has moved by, small ones of either sign as small
/// numbers; low bytes of all, then high bytes, as each compresses better among its like.
/// page/arrays.js is the inverse, too.
namespace flowslide {

/// `width`: bytes of a number. Columns divide the number of levels.
std::string coded_levels(const std::vector<std::uint32_t>& levels, std::size_t columns,
                         std::size_t width);
/// Its inverse.
std::vector<std::uint32_t> decoded_levels(std::string_view bytes, std::size_t columns,
                                          std::size_t width);

}  // namespace flowslide
