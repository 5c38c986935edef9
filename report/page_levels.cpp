#include "report/page_levels.hpp"

namespace flowslide {
namespace {

std::uint32_t mask_of(std::size_t width) { return width == 2 ? 0xffffu : 0xffu; }

/// What a level would be if it moved as its neighbour does.
std::uint32_t predicted(const std::vector<std::uint32_t>& levels, std::size_t columns,
                        std::size_t i) {
  const bool above = i >= columns, left = i % columns > 0;
  return (above ? levels[i - columns] : 0) + (left ? levels[i - 1] : 0) -
         (above && left ? levels[i - columns - 1] : 0);
}

}  // namespace

std::string coded_levels(const std::vector<std::uint32_t>& levels, std::size_t columns,
                         std::size_t width) {
  const std::size_t n = levels.size();
  const std::uint32_t mask = mask_of(width), sign = (mask >> 1) + 1;
  std::string bytes(n * width, '\0');
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t difference = (levels[i] - predicted(levels, columns, i)) & mask;
    const std::uint32_t small = ((difference << 1) ^ (difference & sign ? mask : 0u)) & mask;
    for (std::size_t k = 0; k < width; ++k)
      bytes[i + k * n] = static_cast<char>((small >> (8 * k)) & 0xff);
  }
  return bytes;
}

std::vector<std::uint32_t> decoded_levels(std::string_view bytes, std::size_t columns,
                                          std::size_t width) {
  const std::size_t n = bytes.size() / width;
  std::vector<std::uint32_t> levels(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t small = 0;
    for (std::size_t k = 0; k < width; ++k)
      small |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k * n])) << (8 * k);
    const std::uint32_t difference = small & 1 ? ~(small >> 1) : small >> 1;
    levels[i] = (predicted(levels, columns, i) + difference) & mask_of(width);
  }
  return levels;
}

}  // namespace flowslide
