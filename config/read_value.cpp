#include "config/read_value.hpp"

#include "config/range_text.hpp"
#include "core/conventions.hpp"
#include "core/odd_characters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

struct Bound {
  double value;
  bool exclusive;
};

std::string bound_text(double si_value, std::string_view unit, double factor) {
  const std::string number = fmt::format("{:.6g}", si_value / factor);
  return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

InputError out_of_range(const YamlNode& node, const Range& range, std::string_view unit,
                        double factor) {
  return node.error(fmt::format("'{}' is out of range (allowed: {})", node.scalar(),
                                range_text(range, unit, factor)));
}

/// What looks like a number to people, but is none here.
std::string number_problem(std::string_view text) {
  double unused = 0.0;
  std::size_t length = 0;
  if (!parse_number(text, unused, length) || length == text.size()) return {};
  if (text[length] == '_')
    return "has '_' between digits (only some YAML readers allow it) remove it";
  if (text.substr(0, length).ends_with('0') && std::string_view("xXoObB").find(text[length]) < 6)
    return "is a hexadecimal, octal or binary number (only decimal ones are read)";
  if (text[length] == ',')
    return "has ',' in a number (numbers have a decimal point) write '.' or a list '[a, b]'";
  return {};
}

/// Unit of a text that parse_quantity has read.
std::string_view unit_of(std::string_view text) {
  double unused = 0.0;
  std::size_t length = 0;
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  parse_number(text, unused, length);
  text.remove_prefix(length);
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

std::string character_hint(std::string_view text) {
  if (text.size() > 1 && (text.front() == '"' || text.front() == '\''))
    return " (it is in quotes twice) write the number with its unit, in one pair of quotes or none";
  if (const std::string odd = odd_characters(text); !odd.empty()) return " (it " + odd + ")";
  const bool ascii = std::all_of(text.begin(), text.end(),
                                 [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  return ascii ? ""
               : " (it holds a character beyond ASCII, perhaps a non-breaking space or a long "
                 "minus sign)";
}

}  // namespace

std::string range_text(const Range& range, std::string_view unit, double factor) {
  const Bound lower = range.above >= range.min ? Bound{range.above, true} : Bound{range.min, false};
  const Bound upper = range.below <= range.max ? Bound{range.below, true} : Bound{range.max, false};
  std::string text;
  if (std::isfinite(lower.value))
    text = fmt::format("{} {}", lower.exclusive ? "above" : "at least",
                       bound_text(lower.value, unit, factor));
  if (std::isfinite(upper.value))
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : " and ", upper.exclusive ? "below" : "at most",
                    bound_text(upper.value, unit, factor));
  return text;
}

std::string shown_range(const Range& range, Dim dim) {
  return dim == Dim::angle ? range_text(range, "deg", kPi / 180.0)
                           : range_text(range, si_unit(dim), 1.0);
}

std::string shown_value(double si_value, Dim dim) {
  return dim == Dim::angle ? fmt::format("{:.12g} deg", si_value * 180.0 / kPi)
                           : to_text(si_value, dim);
}

double read_quantity(const YamlNode& node, Dim dim, const Range& range) {
  const std::string& text = node.scalar();
  const std::string problem = number_problem(text);
  if (!problem.empty()) throw node.error(fmt::format("'{}' {}", text, problem));
  double value = kUnset;
  try {
    value = parse_quantity(text, dim);
  } catch (const InputError& e) {
    throw node.error(e.what() + character_hint(text));
  }
  if (range.contains(value)) return value;
  // The range is shown in the unit the user chose.
  const std::string_view unit = unit_of(text);
  const bool bare = dim == Dim::none;
  throw out_of_range(node, range, bare ? "" : unit, bare ? 1.0 : unit_factor(unit, dim));
}

int read_integer(const YamlNode& node, const Range& range) {
  const std::string& text = node.scalar();
  const bool negative = text.starts_with('-');
  const std::string_view digits = std::string_view(text).substr(negative ? 1 : 0);
  const bool all_digits = !digits.empty() && std::all_of(digits.begin(), digits.end(), [](char c) {
    return c >= '0' && c <= '9';
  });
  if (!all_digits)
    throw node.error(
        fmt::format("'{}' is not a whole number (only digits are read) write e.g. "
                    "'10'",
                    text));
  if (digits.size() > 1 && digits.front() == '0')
    throw node.error(
        fmt::format("'{}' starts with 0 (some YAML readers take that for an octal "
                    "number) write it without",
                    text));
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc())
    throw node.error(fmt::format("'{}' is too large (whole numbers up to {} are read)", text,
                                 std::numeric_limits<int>::max()));
  if (!range.contains(value)) throw out_of_range(node, range, "", 1.0);
  return value;
}

bool read_flag(const YamlNode& node) {
  const std::string& text = node.scalar();
  if (text == "true" || text == "false") return text == "true";
  throw node.error(
      fmt::format("'{}' is neither true nor false (yes, no, on, off are not read: YAML "
                  "versions differ on them) write true or false",
                  text));
}

std::string read_text(const YamlNode& node) {
  if (node.scalar().empty())
    throw node.error("is an empty text (a text is expected) remove the key to leave it out");
  return node.scalar();
}

InputFile read_file(const YamlNode& node) {
  if (node.scalar().empty())
    throw node.error("is an empty file name (a file is expected) remove the key to leave it out");
  const std::filesystem::path path(node.scalar());
  return {(path.is_absolute() ? path : node.folder() / path).lexically_normal()};
}

int read_choice(const YamlNode& node, std::span<const std::string_view> names) {
  const std::string& text = node.scalar();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == text) return static_cast<int>(i);
  const std::vector<std::string> known(names.begin(), names.end());
  const auto near = nearest(text, known);
  throw node.error(fmt::format("'{}' is not a choice here (one of: {}){}", text,
                               fmt::join(known, ", "),
                               near ? fmt::format(" did you mean '{}'?", *near) : ""));
}

void expect_list(const YamlNode& node) {
  if (node.kind() == YamlNode::Kind::list) return;
  throw node.error(fmt::format("is {} (a list is expected) write '[a, b]' or '- a' lines",
                               node.kind() == YamlNode::Kind::map ? "a map" : "a single value"));
}

std::vector<double> read_row(const YamlNode& row, std::span<const FieldVisitor::Column> columns) {
  expect_list(row);
  if (row.size() != columns.size()) {
    std::vector<std::string> names;
    for (const auto& column : columns)
      names.push_back(column.dim == Dim::none
                          ? std::string(column.name)
                          : fmt::format("{} [{}]", column.name, si_unit(column.dim)));
    throw row.error(fmt::format("has {} values ({} are expected: {})", row.size(), columns.size(),
                                fmt::join(names, ", ")));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < columns.size(); ++i)
    values.push_back(read_quantity(row.item(i), columns[i].dim, {}));
  return values;
}

}  // namespace flowslide
