#include "config/yaml_data.hpp"
#include "core/files.hpp"
#include "core/unreadable.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include <fmt/format.h>

namespace flowslide::yaml {
namespace {

/// The tree of a text takes about 60 times its size in memory, and 4 s for each MiB.
constexpr std::size_t kMaxBytes = 2u << 20u;

/// Bytes of the UTF-8 character at the start of `s`; 0 if there is none (RFC 3629).
std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t i) {
    return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) > 0x9F;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool beyond = first == 0xF4 && byte(1) > 0x8F;
    return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

std::string problem_of(unsigned char byte) {
  switch (byte) {
    case 0:
      return "NUL byte (this is not a text file, or it is UTF-16) save it as UTF-8";
    case '\t':
      return "tab character (YAML forbids tabs in indentation, and they look like spaces) replace "
             "it by spaces";
    case '\r':
      return "carriage return without line feed (line end of an old text format) save the file "
             "with Unix or Windows line ends";
    default:
      return fmt::format("control character 0x{:02x} (not allowed in YAML) remove it", byte);
  }
}

constexpr std::string_view kNonBreaking = "\xC2\xA0";

/// Whether blanks at the end of `before` would be indentation, or part a key or a sign of a list
/// from what follows.
bool is_structure(std::string_view before) {
  const std::size_t last = before.find_last_not_of(' ');
  if (last == std::string_view::npos) return true;
  return std::string_view("\n:-,[{").find(before[last]) != std::string_view::npos;
}

}  // namespace

Place Source::at(int line, int column) const {
  return has_lines ? Place{name, line, column} : Place{name};
}

Place Source::at_byte(std::string_view text, std::size_t byte) const {
  const std::string_view before = text.substr(0, byte);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  return at(static_cast<int>(line), static_cast<int>(byte - start) + 1);
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw FileError(fmt::format("{}: is a folder (a YAML file is expected) name the file in it",
                                path.string()));
  if (const std::string why = why_unreadable(path); !why.empty())
    throw FileError(fmt::format("{}: {}", path.string(), why));
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw FileError(fmt::format("{}: cannot be opened ({})", path.string(), std::strerror(errno)));
  std::string bytes;
  std::array<char, 16384> block{};
  while (in && bytes.size() <= kMaxBytes) {
    in.read(block.data(), block.size());
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad())
    throw FileError(fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
  validate(bytes.size() <= kMaxBytes,
           "{}: is larger than {} MiB (a settings file has a few kB) is this a data file?",
           path.string(), kMaxBytes >> 20u);
  return bytes;
}

std::string clean_text(std::string_view bytes, const Source& source) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\xFE\xFF"sv) || bytes.starts_with("\xFF\xFE"sv) ||
      bytes.starts_with("\0\0\xFE\xFF"sv))
    throw InputError(fmt::format(
        "{}: is UTF-16 or UTF-32 text (UTF-8 is expected) save it as UTF-8 in your editor",
        source.at(1, 1).where().text()));
  if (bytes.starts_with("\xEF\xBB\xBF"sv)) bytes.remove_prefix(3);

  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size();) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    if (c == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n') {
      ++i;
      continue;
    }
    if ((c < 0x20 && c != '\n') || c == 0x7F)
      throw error_at(source.at_byte(bytes, i), "", problem_of(c));
    const std::size_t length = utf8_length(bytes.substr(i));
    if (length == 0)
      throw error_at(source.at_byte(bytes, i), "",
                     fmt::format("byte 0x{:02x} is not UTF-8 text (the file may be in Latin-1) "
                                 "save it as UTF-8",
                                 c));
    if (bytes.substr(i, length) == kNonBreaking && is_structure(text))
      throw error_at(source.at_byte(bytes, i), "",
                     "non-breaking space where YAML needs a blank (it comes from a word processor "
                     "or a web page, and looks like one) replace it by a blank");
    text.append(bytes.substr(i, length));
    i += length;
  }
  return text;
}

}  // namespace flowslide::yaml
