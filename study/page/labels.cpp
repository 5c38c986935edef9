#include "study/page/labels.hpp"

#include "study/page/meanings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide::study {

std::string short_number(double v) {
  if (!is_set(v)) return "-";
  // Three digits of it, as 1150 and not as 1.15e+03.
  if (std::abs(v) < 1e3 || std::abs(v) >= 1e6) return fmt::format("{:.3g}", v);
  const double unit = std::abs(v) < 1e4 ? 10.0 : std::abs(v) < 1e5 ? 100.0 : 1000.0;
  return fmt::format("{:.0f}", unit * std::round(v / unit));
}

std::string interval(const Estimate& e) {
  if (!is_set(e.value)) return "-";
  if (!is_set(e.low)) return short_number(e.value);
  return fmt::format("{} ({} to {})", short_number(e.value), short_number(e.low),
                     short_number(e.high));
}

std::string readable(const Table& table, const std::string& name) {
  std::string text = name;
  const Column* c = table.find(name);
  const std::string unit = c ? c->unit : unit_in_name(name);
  if (c && c->role == Role::found) {
    const auto known = meaning_of(name);
    text = known ? known->words : without_unit(name);
    std::replace(text.begin(), text.end(), '_', ' ');
  }
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

std::string row_title(const Row& row) { return fmt::format("row {}: {}", row.number, row.label()); }

std::string spans_of(const std::vector<std::size_t>& rows) {
  constexpr std::size_t kMost = 12;
  std::string text;
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t end = i + 1;
    while (end < rows.size() && rows[end] == rows[end - 1] + 1) ++end;
    if (pieces++ == kMost) return text + fmt::format(" and {} more", rows.size() - i);
    text += fmt::format("{}{}", text.empty() ? "" : ", ", rows[i] + 1);
    if (end - i > 1) text += fmt::format(" to {}", rows[end - 1] + 1);
    i = end;
  }
  return text;
}

}  // namespace flowslide::study
