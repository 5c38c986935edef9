#pragma once
#include <string_view>

namespace flowslide::mpm {

/// Whether the first bytes of a file are those of an ESRI ASCII grid: it begins with a word of the
/// header.
bool is_height_field(std::string_view head);

}  // namespace flowslide::mpm
