#include "study/plan/amount.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::study {

std::optional<Amount> parse_amount(std::string_view text) {
  Amount amount;
  std::size_t length = 0;
  if (!parse_number(text, amount.value, length) || !std::isfinite(amount.value))
    return std::nullopt;
  std::string_view unit = text.substr(length);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  // "10 motions of 3 g" or "2.5e" are no amounts.
  const auto belongs = [](unsigned char c) {
    return std::isalnum(c) || c == '/' || c == '%' || c == '^' || c >= 0x80;
  };
  const auto in_unit = [&](std::string_view part) {
    return !part.empty() && std::all_of(part.begin(), part.end(), belongs) &&
           !std::isdigit(static_cast<unsigned char>(part[0]));
  };
  if (!unit.empty() && unit != "Pa s" && unit != "kPa s" && !in_unit(unit)) return std::nullopt;
  amount.unit = unit;
  return amount;
}

std::string to_text(const Amount& amount) {
  const std::string number = fmt::format("{:.12g}", amount.value);
  return amount.unit.empty() ? number : number + " " + amount.unit;
}

}  // namespace flowslide::study
