#include "motion/at2.hpp"

#include "core/check.hpp"
#include "core/units.hpp"

#include <cmath>

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
  check_count(text, header, values.size(), filled_line == last_line ? filled_line : 0, format,
              record.notes);
  if (!format.accept_count && values.size() > header.npts) values.resize(header.npts);
  for (double& a : values) a *= to_si;
  return record;
}

}  // namespace flowslide
