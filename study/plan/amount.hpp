#pragma once
#include "core/check.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace flowslide::study {

/// A number with the unit in which it was written: "0.3 g".
struct Amount {
  double value = kUnset;
  std::string unit;
};

/// Nothing if the text is no finite number with at most a unit behind it.
std::optional<Amount> parse_amount(std::string_view text);

/// With so many significant digits that a decimal number that was added up is written as meant.
std::string to_text(const Amount& amount);

}  // namespace flowslide::study
