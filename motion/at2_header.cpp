#include "core/check.hpp"
#include "motion/at2.hpp"
#include "motion/unit_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace flowslide {
namespace {

constexpr std::size_t kHeaderLines = 20;

/// Position of a whole word in upper-case text, or npos. A digit may touch its end ("DT.005").
std::size_t find_word(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; ++at) {
    const std::size_t end = at + word.size();
    const bool starts = at == 0 || !is_letter(text[at - 1]);
    if (starts && (end == text.size() || !is_letter(text[end]))) return at;
  }
  return std::string_view::npos;
}

std::optional<double> number_after(const std::string& place, std::string_view text,
                                   std::string_view word) {
  text.remove_prefix(find_word(text, word) + word.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t=:"), text.size()));
  double value = 0.0;
  const std::string_view number = text;
  if (!take_number(text, value)) return std::nullopt;
  const bool goes_on = text.size() > 1 && (text[0] == '.' || text[0] == ',') && is_digit(text[1]);
  validate(!goes_on, "{}: '{}' after {} is no number (one decimal point is expected)", place,
           number.substr(0, number.find_first_of(" \t")), word);
  return value;
}

/// Numbers that stand by themselves, outside of words, in order.
std::vector<double> free_numbers(std::string_view text) {
  std::vector<double> numbers;
  bool in_word = false;
  while (!text.empty()) {
    double value = 0.0;
    const bool may_start =
        is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1]));
    if (may_start && !in_word && take_number(text, value)) {
      numbers.push_back(value);
      continue;
    }
    in_word = is_letter(text[0]) || (in_word && is_digit(text[0]));
    text.remove_prefix(1);
  }
  return numbers;
}

/// The unit that a header line states: after the word UNITS, or in words such as CM/SEC/SEC.
std::optional<std::string> stated_unit(const std::string& name, std::size_t line,
                                       std::string_view upper) {
  const std::string text = closed_up(upper);
  const bool plural = find_word(text, "UNITS") != std::string::npos;
  const std::size_t at = find_word(text, plural ? "UNITS" : "UNIT");
  if (at != std::string::npos) {
    std::string_view rest = trimmed(std::string_view(text).substr(at + (plural ? 5 : 4)));
    for (const std::string_view filler : {"OF ", "ARE ", "IN ", ": ", "= "})
      if (rest.starts_with(filler)) rest = trimmed(rest.substr(filler.size()));
    const auto unit = unit_at_start(rest);
    validate(unit.has_value(),
             "{}:{}: '{}' is no unit of acceleration that is known (g, cm/s2 and m/s2 are) is "
             "this a record of velocity or displacement? Take the acceleration (.AT2)",
             name, line + 1, rest.substr(0, std::min<std::size_t>(rest.find(','), 24)));
    return unit;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_word = i == 0 || !(is_letter(text[i - 1]) || text[i - 1] == '/');
    // A bare G in a title is a name; in brackets, or written as more letters, it is the unit.
    const bool bare_g = text[i] == 'G' && text.compare(i, 3, "GAL") != 0;
    if (!starts_word || (bare_g && (i == 0 || text[i - 1] != '('))) continue;
    if (auto unit = unit_at_start(std::string_view(text).substr(i))) return unit;
  }
  return std::nullopt;
}

void refuse_other_series(const std::string& name, std::size_t line, std::string_view upper) {
  const bool series = upper.find("TIME SERIES") != std::string_view::npos ||
                      upper.find("TIME HISTORY") != std::string_view::npos;
  const bool other = find_word(upper, "VELOCITY") != std::string_view::npos ||
                     find_word(upper, "DISPLACEMENT") != std::string_view::npos;
  validate(!series || !other || find_word(upper, "ACCELERATION") != std::string_view::npos,
           "{}:{}: is a record of velocity or displacement (acceleration is needed) take the "
           "acceleration (.AT2) of the same station",
           name, line + 1);
}

}  // namespace

bool is_at2(const RecordText& text) {
  for (std::size_t i = 0; i < std::min(kHeaderLines, text.lines.size()); ++i)
    if (find_word(upper_case(text.lines[i]), "NPTS") != std::string::npos) return true;
  return false;
}

At2Header parse_at2_header(const RecordText& text) {
  std::vector<std::string> upper;
  for (std::size_t i = 0; i < std::min(kHeaderLines, text.lines.size()); ++i)
    upper.push_back(upper_case(text.lines[i]));
  const auto has = [&](std::size_t i, std::string_view word) {
    return i < upper.size() && find_word(upper[i], word) != std::string::npos;
  };
  std::size_t n_line = 0;
  while (n_line < upper.size() && !has(n_line, "NPTS")) ++n_line;
  validate(n_line < upper.size(),
           "{}: no NPTS in the first {} lines (an AT2 header gives the number of values there)",
           text.name, kHeaderLines);
  std::size_t dt_line = n_line;
  if (!has(n_line, "DT")) {
    const bool above = n_line > 0 && has(n_line - 1, "DT");
    dt_line = above ? n_line - 1 : n_line + 1;
    validate(has(dt_line, "DT"),
             "{}:{}: NPTS without DT (the time step must stand with the number of values) write "
             "'NPTS= ..., DT= ... SEC'",
             text.name, n_line + 1);
  }

  const auto [first, last] = std::minmax(n_line, dt_line);
  const std::string counts = first == last ? upper[first] : upper[first] + " " + upper[last];
  const std::string place = fmt::format("{}:{}", text.name, first + 1);
  std::optional<double> npts = number_after(place, counts, "NPTS");
  std::optional<double> dt = number_after(place, counts, "DT");
  if (!npts || !dt) {
    const std::vector<double> numbers = free_numbers(counts);
    validate(numbers.size() >= 2, "{}:{}: '{}' does not give both NPTS and DT", text.name,
             n_line + 1, trimmed(text.lines[n_line]));
    const bool npts_first = find_word(counts, "NPTS") < find_word(counts, "DT");
    npts = numbers[npts_first ? 0 : 1];
    dt = numbers[npts_first ? 1 : 0];
  }
  validate(*npts >= 2.0 && *npts <= 1e9 && std::floor(*npts) == *npts,
           "{}:{}: NPTS is {} (a number of values is expected)", text.name, n_line + 1, *npts);
  validate(*dt > 0.0 && *dt <= 1.0,
           "{}:{}: DT is {} s (between 0 and 1 s is expected; a sampling rate?)", text.name,
           dt_line + 1, *dt);

  At2Header header{.npts = static_cast<std::size_t>(*npts),
                   .dt = *dt,
                   .unit = {},
                   .unit_line = 0,
                   .title = {},
                   .data_line = last + 1};
  if (first >= 2) header.title = std::string(trimmed(text.lines[1]));
  for (std::size_t i = 0; i <= last; ++i) {
    refuse_other_series(text.name, i, upper[i]);
    // The title may hold any word, a unit's name too.
    if (i == 1 && first > 2) continue;
    if (header.unit) continue;
    header.unit = stated_unit(text.name, i, upper[i]);
    header.unit_line = i;
  }
  return header;
}

}  // namespace flowslide
