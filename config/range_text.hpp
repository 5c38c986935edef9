#pragma once
#include "config/schema.hpp"
#include "core/units.hpp"

#include <string>
#include <string_view>

namespace flowslide {

/// "above 0 m and at most 5 m"; empty if everything is allowed. Bounds are in SI and shown divided
/// by `factor`, followed by `unit`.
std::string range_text(const Range& range, std::string_view unit, double factor);

/// The same in the unit in which pages and schemas show the dimension: degrees for angles, else SI.
std::string shown_range(const Range& range, Dim dim);

/// A value in that unit; degrees to 12 digits, the rest as to_text().
std::string shown_value(double si_value, Dim dim);

}  // namespace flowslide
