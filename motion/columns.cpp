#include "motion/columns.hpp"

#include "core/check.hpp"
#include "core/median.hpp"
#include "core/units.hpp"
#include "motion/unit_words.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

// Share of the step by which a written time may miss its place on the uniform grid: rounding to
// the last digit misses by less than half of a step that is not itself lost in rounding.
constexpr double kTimeTolerance = 0.25;

bool is_comment(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line[0] == '#' || line[0] == '%' || line[0] == '!' ||
         line.starts_with("//");
}

/// A line whose first word starts no number, such as "time,acc".
bool is_heading(std::string_view line) {
  line = trimmed(line);
  double ignored = 0.0;
  return !take_number(line, ignored) && line.find_first_of("0123456789*+-.,;") != 0;
}

struct Choice {
  std::size_t time = 0;  ///< from 1; 0: there is none
  std::size_t acceleration = 0;
};

Choice choose_columns(const std::string& name, std::size_t columns, const RecordFormat& format) {
  Choice choice;
  if (columns == 1) choice = {.time = 0, .acceleration = 1};
  if (columns == 2) choice = {.time = 1, .acceleration = 2};
  validate(format.time_column >= 0 && format.acceleration_column >= 0,
           "{}: columns are counted from 1", name);
  if (format.acceleration_column > 0)
    choice = {.time = 0, .acceleration = static_cast<std::size_t>(format.acceleration_column)};
  if (format.time_column > 0) choice.time = static_cast<std::size_t>(format.time_column);
  validate(choice.acceleration > 0,
           "{}: {} columns (time and acceleration are expected, or acceleration alone) name the "
           "column of acceleration and, if there is one, of time; of values that stand several to "
           "a line, write one to a line",
           name, columns);
  validate(choice.acceleration <= columns && choice.time <= columns &&
               choice.acceleration != choice.time,
           "{}: no columns {} for time and {} for acceleration (the file has {})", name,
           choice.time, choice.acceleration, columns);
  return choice;
}

struct Heading {
  std::size_t line;
  std::string_view text;
};

/// A wrong unit is a wrong size of the whole motion, so a heading that says another one counts.
void compare_units(const std::string& name, const std::vector<Heading>& headings,
                   std::size_t column, std::size_t columns,
                   const std::optional<std::string>& declared) {
  for (const Heading& h : headings) {
    const auto unit = unit_in_heading(h.text, column, columns);
    if (!unit) continue;
    validate(
        declared.has_value(),
        "{}:{}: the unit of acceleration is not known (headings may be wrong, and are not taken "
        "at their word) give `unit: {}` if that is what it says",
        name, h.line, *unit);
    const double ratio =
        unit_factor(*declared, Dim::acceleration) / unit_factor(*unit, Dim::acceleration);
    validate(std::abs(ratio - 1.0) < 1e-9,
             "{}:{}: the heading says {}, but `unit` is {} (accelerations would be {:.4g} times "
             "those of the heading) correct `unit`, or the heading in a copy of the file",
             name, h.line, *unit, *declared, ratio);
  }
}

struct TimedValue {
  std::size_t line;
  double time;
};

double uniform_step(const std::string& name, const std::vector<TimedValue>& times) {
  const double n = static_cast<double>(times.size() - 1);
  const double dt = (times.back().time - times.front().time) / n;
  validate(dt > 0.0,
           "{}: time does not increase (first {} s, last {} s) is the order of the columns right, "
           "and are its commas separators, not decimal ones?",
           name, times.front().time, times.back().time);
  std::vector<double> steps;
  bool uniform = true;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps.push_back(times[i].time - times[i - 1].time);
    const double expected = times.front().time + static_cast<double>(i) * dt;
    uniform =
        uniform && steps.back() > 0.0 && std::abs(times[i].time - expected) <= kTimeTolerance * dt;
  }
  if (uniform) return dt;
  const double usual = median(steps);
  const auto odd = std::max_element(steps.begin(), steps.end(), [usual](double a, double b) {
    return std::abs(a - usual) < std::abs(b - usual);
  });
  throw InputError(fmt::format(
      "{}:{}: a step of {:.4g} s, but most are {:.4g} s (rows are missing or doubled, the step "
      "changes, or times have too few digits) resample to a uniform step first",
      name, times[static_cast<std::size_t>(odd - steps.begin()) + 1].line, *odd, usual));
}

double factor_to_si(const std::string& name, const RecordFormat& format) {
  validate(
      format.unit.has_value(),
      "{}: the unit of acceleration is not known (columns do not say it) give `unit`: g, cm/s2 "
      "or m/s2",
      name);
  return unit_factor(*format.unit, Dim::acceleration);
}

}  // namespace

bool is_heading_line(std::string_view line) { return is_comment(line) || is_heading(line); }

Record parse_columns(const RecordText& text, const RecordFormat& format) {
  double to_si = kUnset;
  Record record{.motion = {.dt = kUnset, .acceleration = {}, .origin = text.name}, .notes = {}};
  std::size_t columns = 0;
  Choice choice;
  std::vector<TimedValue> times;
  std::vector<Heading> headings;
  std::vector<double> row;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const std::string& line = text.lines[i];
    if (trimmed(line).empty()) continue;
    if (columns == 0 && is_heading_line(line)) {
      record.notes.push_back(fmt::format("{}:{}: heading skipped", text.name, i + 1));
      headings.push_back({i + 1, line});
      continue;
    }
    row.clear();
    const std::string problem = take_row(line, row);
    validate(problem.empty(), "{}:{}: {}", text.name, i + 1, problem);
    if (columns == 0) {
      columns = row.size();
      choice = choose_columns(text.name, columns, format);
      compare_units(text.name, headings, choice.acceleration, columns, format.unit);
      to_si = factor_to_si(text.name, format);
    }
    validate(row.size() == columns, "{}:{}: {} columns, but the first row has {}", text.name, i + 1,
             row.size(), columns);
    record.motion.acceleration.push_back(row[choice.acceleration - 1] * to_si);
    if (choice.time > 0) times.push_back({i + 1, row[choice.time - 1]});
  }
  validate(record.motion.acceleration.size() >= 2, "{}: {} rows (a record has at least two)",
           text.name, record.motion.acceleration.size());

  if (choice.time == 0) {
    validate(format.dt.has_value(),
             "{}: the time step is not known (there is no time column) give `dt`", text.name);
    record.motion.dt = *format.dt;
    return record;
  }
  record.motion.dt = uniform_step(text.name, times);
  validate(!format.dt || std::abs(*format.dt / record.motion.dt - 1.0) < 0.01,
           "{}: the time column has a step of {:.6g} s, but {} s was declared", text.name,
           record.motion.dt, format.dt.value_or(kUnset));
  if (format.dt) record.motion.dt = *format.dt;
  return record;
}

}  // namespace flowslide
