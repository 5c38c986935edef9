#pragma once
#include "section/layout.hpp"

#include <vector>

namespace flowslide {

/// Number of elements on each segment: opposite sides of every block have equal sums, and the
/// numbers are as near as possible to those wanted. Throws InputError naming the block where that
/// cannot be.
std::vector<int> divide(const Layout& layout, const SectionConfig& config);

}  // namespace flowslide
