#include "importers/recorder_text.hpp"

#include "core/check.hpp"
#include "core/odd_characters.hpp"
#include "core/units.hpp"
#include "importers/recorder_times.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::size_t kMaxProblems = 10;

/// Of every character of files of gigabytes: a search in kBlanks costs a call.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trim(std::string_view s) {
  while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
  return s;
}

// Windows libraries before 2015 print 1.#QNAN, -1.#IND, 1.#INF.
bool parse_windows_word(std::string_view token, double& value) {
  const bool negative = token.starts_with('-');
  if (negative) token.remove_prefix(1);
  if (!token.starts_with("1.#")) return false;
  token.remove_prefix(3);
  const bool infinite = token.starts_with("INF");
  if (!infinite && !token.starts_with("QNAN") && !token.starts_with("SNAN") &&
      !token.starts_with("IND"))
    return false;
  value = infinite ? std::numeric_limits<double>::infinity() : kUnset;
  if (negative) value = -value;
  return true;
}

bool parse_token(std::string_view token, double& value) {
  std::size_t used = 0;
  if (parse_number(token, value, used) && used == token.size()) return true;
  return parse_windows_word(token, value);
}

std::string explain_token(std::string_view token, std::size_t column) {
  constexpr std::size_t kShown = 24;
  const std::string shown(token.substr(0, kShown));
  std::string why = "is not a number";
  const bool ascii = std::all_of(token.begin(), token.end(),
                                 [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (const std::string odd = odd_characters(token); !ascii && !odd.empty()) {
    why = odd;
  } else if (token.empty()) {
    why = "is empty (two separators in a row)";
  } else if (token.find_first_not_of('*') == std::string_view::npos) {
    why = "is a Fortran overflow (the number did not fit its field) record with more digits";
  } else if (token.find(';') != std::string_view::npos) {
    why = "holds ';' (columns are separated by blanks or commas) replace it";
  } else if (token.find(',') != std::string_view::npos ||
             token.find_first_of(kBlanks) != std::string_view::npos) {
    why = "mixes commas and blanks (a decimal or thousands comma?) write decimal points";
  } else if (token.find_first_of("\"'") != std::string_view::npos) {
    why = "is quoted (numbers are expected bare) export without quotes";
  } else if (const auto d = token.find_first_of("dD");
             d != std::string_view::npos && d > 0 &&
             (is_digit(token[d - 1]) || token[d - 1] == '.')) {
    why = "has a Fortran exponent (C spelling is expected) replace 'd' by 'e'";
  }
  return fmt::format("column {} '{}' {}", column, shown, why);
}

}  // namespace

std::string NumberLine::parse(std::string_view line, std::vector<double>& values) {
  values.clear();
  line = trim(line);
  if (separator_ == 0) separator_ = line.find(',') == std::string_view::npos ? ' ' : ',';
  double value = 0.0;
  while (!line.empty()) {
    std::size_t end = 0;
    if (separator_ == ',') {
      end = std::min(line.find(','), line.size());
    } else {
      while (end < line.size() && !is_blank(line[end])) ++end;
    }
    const std::string_view token = trim(line.substr(0, end));
    if (!parse_token(token, value)) return explain_token(token, values.size() + 1);
    values.push_back(value);
    line.remove_prefix(std::min(end + 1, line.size()));
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  }
  return {};
}

bool NumberLine::is_header(std::string_view line) {
  line = trim(line);
  if (line.starts_with('#') || line.starts_with("//")) return true;
  while (!line.empty()) {
    const auto end = std::min(line.find_first_of(" \t\v\f,;"), line.size());
    double value = 0.0;
    const std::string_view token = line.substr(0, end);
    if (parse_token(token, value)) return false;
    if (!token.empty() && (is_digit(token[0]) || token.find_first_of("+-.*") == 0)) return false;
    line = trim(line.substr(std::min(end + 1, line.size())));
  }
  return true;
}

RecorderReader::RecorderReader(const std::filesystem::path& path) : lines_(path) {}

bool RecorderReader::next_line(std::string_view& line) {
  while (lines_.next(line)) {
    if (trim(line).empty()) continue;
    if (!lines_.terminated()) {
      notes_.push_back(fmt::format("{}: last line (row {}) is torn, dropped", name(), row_ + 1));
      return false;
    }
    if (row_ == 0 && NumberLine::is_header(line)) {
      notes_.push_back(fmt::format("{}:{}: header line skipped", name(), lines_.line_number()));
      continue;
    }
    ++row_;
    return true;
  }
  return false;
}

bool RecorderReader::skip() {
  std::string_view line;
  return next_line(line);
}

bool RecorderReader::next(std::vector<double>& values) {
  std::string_view line;
  if (!next_line(line)) return false;
  const std::string problem = numbers_.parse(line, values);
  validate(problem.empty(), "{}:{}: {}", name(), this->line(), problem);
  if (columns_ == 0) columns_ = values.size();
  validate(values.size() == columns_,
           "{}:{}: {} columns, but the first row has {} (a row was cut or two rows were joined) "
           "repair the line, or import the rows before it with `bad_rows: stop`",
           name(), this->line(), values.size(), columns_);
  return true;
}

RecorderScan scan_recorder(const std::filesystem::path& path, const ColumnLabel& label,
                           const std::function<void(double)>& tick) {
  RecorderScan scan;
  scan.file = path.filename().string();
  const auto add_problem = [&](std::string text) {
    if (scan.problems.size() < kMaxProblems) scan.problems.push_back(std::move(text));
  };
  bool good = true;
  try {
    RecorderReader reader(path);
    std::vector<double> values;
    for (bool more = true; more;) {
      try {
        more = reader.next(values);
        if (!more) break;
      } catch (const InputError& error) {
        // A reader that stands on the same row did not pass a bad row: the file itself is bad.
        if (reader.row() == scan.rows) throw;
        scan.rows = reader.row();
        add_problem(error.what());
        good = false;
        continue;
      }
      scan.rows = reader.row();
      for (std::size_t c = 0; c < values.size(); ++c) {
        if (std::isfinite(values[c])) {
          if (c == 0) continue;
          scan.value_min = std::min(scan.value_min, values[c]);
          scan.value_max = std::max(scan.value_max, values[c]);
          continue;
        }
        ++scan.non_finite;
        good = false;
        const std::string what = label ? label(c + 1) : std::string();
        add_problem(fmt::format("{}:{}: column {}{} is {}", reader.name(), reader.line(), c + 1,
                                what.empty() ? "" : " (" + what + ")", values[c]));
      }
      if (good) {
        ++scan.good_rows;
        scan.first_column.push_back(values[0]);
      }
      if (tick) tick(reader.fraction());
    }
    scan.columns = reader.columns();
    scan.notes = reader.notes();
  } catch (const InputError& error) {
    add_problem(error.what());
  }
  if (scan.rows == 0 && scan.problems.empty()) {
    add_problem(
        scan.notes.empty()
            ? fmt::format("{}: is empty (the recorder wrote nothing: its elements do not know the "
                          "response, its list names nothing that exists, or the run stopped "
                          "before the first step) check the recorder line",
                          scan.file)
            : fmt::format("{}: has no complete row ({})", scan.file, scan.notes.back()));
  }
  return scan;
}

RecorderSummary summarize_recorder(const std::filesystem::path& path,
                                   const std::function<void(double)>& tick) {
  const RecorderScan scan = scan_recorder(path, {}, tick);
  RecorderSummary summary{
      .columns = scan.columns, .rows = scan.rows, .problems = scan.problems, .notes = scan.notes};
  if (scan.value_min <= scan.value_max) {
    summary.value_min = scan.value_min;
    summary.value_max = scan.value_max;
  }
  if (scan.columns == 1 && scan.problems.empty())
    summary.notes.push_back(fmt::format("{}: one column only (time without values?)", scan.file));
  const std::vector<double>& t = scan.first_column;
  if (t.empty()) return summary;
  const auto stages = split_stages(t);
  // More than one reset in ten rows is not how time behaves.
  summary.has_time = stages.size() == 1 || stages.size() * 10 <= t.size();
  summary.stages = static_cast<int>(stages.size());
  summary.time_first = t.front();
  summary.time_last = t.back();
  const StepRange steps = step_range(t);
  summary.step_min = steps.min;
  summary.step_max = steps.max;
  return summary;
}

}  // namespace flowslide
