#include "motion/record_text.hpp"

#include "core/check.hpp"
#include "core/odd_characters.hpp"
#include "core/units.hpp"
#include "core/unreadable.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <zlib.h>

namespace flowslide {
namespace {

namespace fs = std::filesystem;

// An hour at 1 kHz in 15 characters a sample is 54 MB; more is no record of an earthquake.
constexpr std::size_t kLargest = std::size_t{256} << 20;
constexpr std::string_view kBlanks = " \t\v\f";
// A sign too: the fields of a Fortran format may touch.
constexpr std::string_view kEndsNumber = " \t\v\f,;+-";

std::string read_bytes(const fs::path& path) {
  if (const std::string why = why_unreadable(path); !why.empty())
    throw FileError(fmt::format("{}: {}", path.string(), why));
  const std::unique_ptr<gzFile_s, decltype(&gzclose)> file(gzopen(path.c_str(), "rb"), &gzclose);
  if (!file)
    throw FileError(fmt::format("{}: cannot be opened ({})", path.string(), std::strerror(errno)));
  std::string bytes;
  std::vector<char> block(1 << 18);
  while (true) {
    const int got = gzread(file.get(), block.data(), static_cast<unsigned>(block.size()));
    int code = Z_OK;
    const char* text = gzerror(file.get(), &code);
    if (code == Z_ERRNO)
      throw FileError(fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
    validate(code != Z_BUF_ERROR || got > 0,
             "{}: gzip data end too early (the file was cut) copy it again", path.string());
    validate(code == Z_OK || code == Z_STREAM_END || code == Z_BUF_ERROR,
             "{}: gzip data are damaged ({}) copy it again", path.string(), text);
    if (got <= 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(got));
    validate(bytes.size() <= kLargest, "{}: more than {} MB of text (no record is so long)",
             path.string(), kLargest >> 20);
  }
}

/// Commas between digits and nothing else about them, other separators beside them, no points: the
/// commas do not separate.
bool has_decimal_commas(std::string_view line) {
  bool commas = false, others = false;
  const auto digit = [&](std::size_t i) {
    return i < line.size() && line[i] >= '0' && line[i] <= '9';
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '.') return false;
    if (line[i] == ',' && (i == 0 || !digit(i - 1) || !digit(i + 1))) return false;
    commas = commas || line[i] == ',';
    others = others || line[i] == ';' || kBlanks.find(line[i]) != std::string_view::npos;
  }
  return commas && others;
}

}  // namespace

RecordText record_text(std::string_view bytes, std::string name) {
  RecordText text{.name = std::move(name), .lines = {}};
  validate(!bytes.empty(), "{}: is empty", text.name);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto foreign = std::find_if(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && std::strchr("\t\v\f\r\n\x1A", c) == nullptr;
  });
  // strchr finds the terminating zero, too.
  const bool is_text = foreign == bytes.end() && bytes.find('\0') == std::string_view::npos;
  validate(is_text,
           "{}: holds control characters (a binary file, an archive or UTF-16 text) records are "
           "read from plain text or gzip",
           text.name);
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end);
    if (bytes.starts_with("\r\n"))
      bytes.remove_prefix(2);
    else if (!bytes.empty())
      bytes.remove_prefix(1);
    // MS-DOS editors end a file with Ctrl-Z.
    if (bytes.empty() && line == "\x1A") break;
    text.lines.emplace_back(line);
  }
  return text;
}

RecordText read_record_text(const fs::path& path) {
  return record_text(read_bytes(path), path.filename().string());
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

bool take_number(std::string_view& text, double& value) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const auto digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  const auto one_of = [&](std::size_t i, std::string_view set) {
    return i < text.size() && set.find(text[i]) != std::string_view::npos;
  };
  std::size_t end = one_of(0, "+-") ? 1 : 0;
  bool any = false;
  for (; digit(end); ++end) any = true;
  if (one_of(end, ".")) ++end;
  for (; digit(end); ++end) any = true;
  if (!any) return false;
  std::string number(text.substr(0, end));
  if (one_of(end, "eEdD")) {
    const std::size_t exponent = one_of(end + 1, "+-") ? end + 2 : end + 1;
    if (digit(exponent)) {
      std::size_t tail = exponent;
      while (digit(tail)) ++tail;
      number += 'e';
      number += text.substr(end + 1, tail - end - 1);
      end = tail;
    }
  }
  std::size_t used = 0;
  if (!parse_number(number, value, used) || used != number.size()) return false;
  text.remove_prefix(end);
  return true;
}

std::string take_row(std::string_view line, std::vector<double>& values) {
  line = trimmed(line);
  if (has_decimal_commas(line))
    return fmt::format("'{}' has decimal commas (numbers have a decimal point) write '.'",
                       line.substr(0, 40));
  std::size_t column = 0;
  while (!line.empty()) {
    ++column;
    const std::string_view before = line;
    double value = 0.0;
    const bool is_number =
        take_number(line, value) && (line.empty() || kEndsNumber.find(line[0]) != line.npos);
    if (!is_number || !std::isfinite(value)) {
      const std::string_view token = before.substr(0, before.find_first_of(" \t\v\f;"));
      const std::string odd = odd_characters(token);
      return fmt::format("value {} '{}' {}", column, token.substr(0, 24),
                         odd.empty() ? "is not a finite number" : odd);
    }
    values.push_back(value);
    line = trimmed(line);
    if (!line.empty() && (line[0] == ',' || line[0] == ';')) line = trimmed(line.substr(1));
  }
  return {};
}

}  // namespace flowslide
