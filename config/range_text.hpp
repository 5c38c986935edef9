#pragma once
#include "config/schema.hpp"

#include <string>
#include <string_view>

namespace flowslide {

/// "above 0 m and at most 5 m"; empty if everything is allowed. Bounds are in SI and shown divided
/// by `factor`, followed by `unit`.
std::string range_text(const Range& range, std::string_view unit, double factor);

}  // namespace flowslide
