#include "motion/unit_words.hpp"

#include "motion/record_text.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace flowslide {
namespace {

struct Spelling {
  std::string_view text;
  std::string_view unit;
};

// Blanks are gone and ** is ^ before these are compared; longer spellings of a start come first.
constexpr std::array kSpellings = {
    Spelling{"CM/SEC/SEC", "cm/s2"},
    Spelling{"CM/S/S", "cm/s2"},
    Spelling{"CM/SEC^2", "cm/s2"},
    Spelling{"CM/SEC2", "cm/s2"},
    Spelling{"CM/S^2", "cm/s2"},
    Spelling{"CM/S2", "cm/s2"},
    Spelling{"CM/SQ.SEC", "cm/s2"},
    Spelling{"CM/SQSEC", "cm/s2"},
    Spelling{"GALS", "cm/s2"},
    Spelling{"GAL", "cm/s2"},
    Spelling{"M/SEC/SEC", "m/s2"},
    Spelling{"M/S/S", "m/s2"},
    Spelling{"M/SEC^2", "m/s2"},
    Spelling{"M/SEC2", "m/s2"},
    Spelling{"M/S^2", "m/s2"},
    Spelling{"M/S2", "m/s2"},
    Spelling{"G'S", "g"},
    Spelling{"GS", "g"},
    Spelling{"G", "g"},
};

void replace(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

std::vector<std::string_view> parts_of(std::string_view heading) {
  const std::size_t first = heading.find_first_of(",;\t");
  if (first == std::string_view::npos) return {heading};
  const char separator = heading[first];
  std::vector<std::string_view> parts;
  for (std::size_t start = 0;;) {
    const std::size_t end = heading.find(separator, start);
    parts.push_back(heading.substr(start, end - start));
    if (end == std::string_view::npos) return parts;
    start = end + 1;
  }
}

/// A G is a unit in brackets, at the end of a name such as acc_g, and behind a word that says so.
bool is_bare_unit(std::string_view before, std::string_view after) {
  const char next = after.empty() ? ' ' : after[0];
  if (before.ends_with('(') || before.ends_with('[')) return next == ')' || next == ']';
  if (before.ends_with('_')) return next == ' ' || next == '"';
  return std::ranges::any_of(std::array{"IN ", "UNIT ", "UNITS ", "UNITS OF ", "UNIT: ", "UNITS: "},
                             [before](std::string_view word) { return before.ends_with(word); });
}

}  // namespace

/// "CM / SEC ** 2, ..." -> "CM/SEC^2, ...".
std::string closed_up(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool joins = !out.empty() && (out.back() == '/' || out.back() == '^');
    if (text[i] == ' ' || text[i] == '\t') {
      if (!joins && !out.empty() && out.back() != ' ') out += ' ';
      continue;
    }
    const bool power = text[i] == '^' || text.substr(i, 2) == "**";
    if ((power || text[i] == '/') && !out.empty() && out.back() == ' ') out.pop_back();
    out += power ? '^' : text[i];
    if (power && text[i] == '*') ++i;
  }
  return out;
}

std::optional<std::string> unit_at_start(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" ([:="), text.size()));
  for (const Spelling& s : kSpellings) {
    if (!text.starts_with(s.text)) continue;
    const char next = text.size() > s.text.size() ? text[s.text.size()] : ' ';
    if (!is_letter(next) && !is_digit(next) && next != '/' && next != '^')
      return std::string(s.unit);
  }
  return std::nullopt;
}

std::optional<std::string> unit_in_heading(std::string_view heading, std::size_t column,
                                           std::size_t columns) {
  const std::vector<std::string_view> parts = parts_of(heading);
  std::string text = upper_case(trimmed(parts.size() == columns ? parts[column - 1] : heading));
  replace(text, "\u00b2", "2");
  replace(text, "_S2", "/S2");
  text = closed_up(text);
  std::optional<std::string> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view before(text.data(), i);
    if (!is_letter(text[i])) continue;
    if (i > 0 && (is_letter(text[i - 1]) || text[i - 1] == '/')) continue;
    const std::string_view word = trimmed(before);
    if (!word.empty() && (is_digit(word.back()) || word.back() == '.')) continue;
    const std::string_view rest = std::string_view(text).substr(i);
    const auto unit = unit_at_start(rest);
    if (!unit) continue;
    const std::size_t length = rest.starts_with("G'S") ? 3 : rest.starts_with("GS") ? 2 : 1;
    if (*unit == "g" && !is_bare_unit(before, rest.substr(length))) continue;
    if (found && *found != *unit) return std::nullopt;
    found = unit;
  }
  return found;
}

}  // namespace flowslide
