#include "motion/at2.hpp"

#include "core/check.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace flowslide {
namespace {

// A last line that is filled up is common; a whole line too many is another header or record.
void check_count(const RecordText& text, const At2Header& header, std::size_t found,
                 std::size_t full_after_line, const RecordFormat& format,
                 std::vector<std::string>& notes) {
  if (found == header.npts) return;
  const std::string both =
      fmt::format("{}: {} values, but NPTS is {}", text.name, found, header.npts);
  if (format.accept_count) {
    notes.push_back(both + "; the values of the file were used");
    return;
  }
  validate(found > header.npts,
           "{} (the file was cut, and what is missing changes duration and intensity) get it "
           "again, or accept the count of the file",
           both);
  validate(full_after_line != 0,
           "{} (whole lines too many: a second record, or a wrong header) correct NPTS, or accept "
           "the count of the file",
           both);
  notes.push_back(both + "; those that fill up the last line were dropped");
}

/// What the header or else the user says. Both may, if they agree: a wrong unit is a wrong size of
/// the whole motion.
std::string unit_of(const RecordText& text, const At2Header& header, const RecordFormat& format) {
  if (!header.unit) {
    validate(format.unit.has_value(),
             "{}: the header does not state the unit of acceleration (g or cm/s2?) give `unit`",
             text.name);
    return *format.unit;
  }
  if (format.unit) {
    const double ratio =
        unit_factor(*format.unit, Dim::acceleration) / unit_factor(*header.unit, Dim::acceleration);
    validate(std::abs(ratio - 1.0) < 1e-9,
             "{}:{}: the header says {}, but `unit` is {} (accelerations would be {:.4g} times "
             "those of the header) leave `unit` out, or correct the header in a copy of the file",
             text.name, header.unit_line + 1, *header.unit, *format.unit, ratio);
  }
  return *header.unit;
}

/// Whether the last word of a line has no exponent.
bool ends_bare(std::string_view line) {
  line = trimmed(line);
  const std::size_t blank = line.find_last_of(" \t,;");
  return line.substr(blank == std::string_view::npos ? 0 : blank + 1).find_first_of("eEdD") ==
         std::string_view::npos;
}

/// All values but the last have an exponent: the file ends within the last, which would be a
/// thousand times too large without it.
void check_last(const RecordText& text, std::size_t first_line, std::size_t last_line) {
  const auto exponents = [](std::string_view s) {
    return std::count_if(s.begin(), s.end(),
                         [](char c) { return std::strchr("eEdD", c) != nullptr; });
  };
  std::vector<double> values;
  std::ptrdiff_t found = 0;
  for (std::size_t i = first_line; i < last_line; ++i) {
    found += exponents(text.lines[i]);
    (void)take_row(text.lines[i], values);
  }
  validate(
      std::ssize(values) != found + 1 || found < 2 || !ends_bare(text.lines[last_line - 1]),
      "{}:{}: the last value has no exponent, and all others have (the file was cut within it) "
      "get it again",
      text.name, last_line);
}

}  // namespace

Record parse_at2(const RecordText& text, const RecordFormat& format) {
  const At2Header header = parse_at2_header(text);
  const double to_si = unit_factor(unit_of(text, header, format), Dim::acceleration);

  Record record{.motion = {.dt = header.dt, .acceleration = {}, .origin = text.name}, .notes = {}};
  if (!header.title.empty()) record.motion.origin += " (" + header.title + ")";
  std::vector<double>& values = record.motion.acceleration;
  std::size_t last_line = 0;    // of those that hold numbers, from 1
  std::size_t filled_line = 0;  // the one on which value NPTS stands
  for (std::size_t i = header.data_line; i < text.lines.size(); ++i) {
    const std::size_t before = values.size();
    const std::string problem = take_row(text.lines[i], values);
    validate(problem.empty(), "{}:{}: {}", text.name, i + 1, problem);
    if (values.size() == before) continue;
    last_line = i + 1;
    if (before < header.npts && values.size() >= header.npts) filled_line = i + 1;
  }
  if (last_line > 0) check_last(text, header.data_line, last_line);
  check_count(text, header, values.size(), filled_line == last_line ? filled_line : 0, format,
              record.notes);
  if (!format.accept_count && values.size() > header.npts) values.resize(header.npts);
  for (double& a : values) a *= to_si;
  return record;
}

}  // namespace flowslide
