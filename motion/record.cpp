#include "motion/record.hpp"

#include "motion/at2.hpp"
#include "motion/columns.hpp"
#include "motion/foreign.hpp"
#include "motion/measures.hpp"
#include "motion/unit_words.hpp"

#include <algorithm>

namespace flowslide {
namespace {

Record parse(const RecordText& text, const RecordFormat& format) {
  if (!is_at2(text)) refuse_foreign_format(text);
  Record record = is_at2(text) ? parse_at2(text, format) : parse_columns(text, format);
  check(record.motion);
  for (std::string& odd : implausible(text.name, pga(record.motion), record.motion.dt))
    record.warnings.push_back(std::move(odd));
  return record;
}

/// Lines before the first row of numbers.
std::vector<std::string_view> headings(const RecordText& text) {
  std::vector<std::string_view> lines;
  for (const std::string& line : text.lines) {
    if (!is_heading_line(line)) break;
    lines.emplace_back(line);
  }
  return lines;
}

std::optional<std::string> heading_unit(std::string_view heading) {
  return unit_in_heading(heading, 1, std::string::npos);  // of any column
}

bool names_acceleration(std::string_view heading) {
  const std::string text = upper_case(heading);
  for (std::size_t at = 0; (at = text.find("ACC", at)) != std::string::npos; ++at)
    if (at == 0 || !is_letter(text[at - 1])) return true;
  return false;
}

}  // namespace

bool is_record(const RecordText& head) {
  if (is_at2(head)) return true;
  try {
    refuse_foreign_format(head);
  } catch (const InputError&) {
    return true;
  }
  return std::ranges::any_of(headings(head), [](std::string_view line) {
    return names_acceleration(line) || heading_unit(line);
  });
}

std::optional<std::string> stated_unit(const RecordText& text) {
  if (is_at2(text)) return parse_at2_header(text).unit;
  for (const std::string_view line : headings(text))
    if (auto unit = heading_unit(line)) return unit;
  return std::nullopt;
}

Record read_record(const std::filesystem::path& path, const RecordFormat& format) {
  return parse(read_record_text(path), format);
}

Record parse_record(std::string_view text, std::string name, const RecordFormat& format) {
  return parse(record_text(text, std::move(name)), format);
}

}  // namespace flowslide
