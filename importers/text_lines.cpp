#include "importers/text_lines.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/unreadable.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>
#include <zlib.h>

namespace flowslide {
namespace {

namespace fs = std::filesystem;

struct Magic {
  std::string_view bytes;
  std::string_view what;
};

using namespace std::string_view_literals;

constexpr std::array kForeign = {
    Magic{"\x89HDF"sv, "an HDF5 file such as MPCO or VTKHDF (this reader takes text recorders)"},
    Magic{"\xFD"
          "7zXZ"sv,
          "an xz archive (plain text and gzip are read) unpack it with `unxz`"},
    Magic{"\x28\xB5\x2F\xFD"sv,
          "a zstd archive (plain text and gzip are read) unpack it with `unzstd`"},
    Magic{"BZh"sv, "a bzip2 archive (plain text and gzip are read) unpack it with `bunzip2`"},
    Magic{"PK\x03\x04"sv, "a zip archive (plain text and gzip are read) unpack it with `unzip`"},
    Magic{"\xFF\xFE"sv, "UTF-16 text (plain ASCII is read) save it as UTF-8"},
    Magic{"\xFE\xFF"sv, "UTF-16 text (plain ASCII is read) save it as UTF-8"},
    Magic{"version https://git-lfs"sv,
          "a Git LFS pointer, not the data (the file was never downloaded) run `git lfs pull`"},
    Magic{"<?xml"sv,
          "an XML recorder (text and CSV recorders are read) record with -file or -fileCSV"},
    Magic{"<OpenSees"sv,
          "an XML recorder (text and CSV recorders are read) record with -file or -fileCSV"},
};

enum class Byte : std::uint8_t { text, line_end, nul, control };

constexpr auto kByteClass = [] {
  std::array<Byte, 256> table{};
  for (int c = 0; c < 0x20; ++c) table[static_cast<std::size_t>(c)] = Byte::control;
  for (const char c : {'\t', '\v', '\f'}) table[static_cast<unsigned char>(c)] = Byte::text;
  for (const char c : {'\n', '\r'}) table[static_cast<unsigned char>(c)] = Byte::line_end;
  table[0x7F] = Byte::control;
  table[0] = Byte::nul;
  return table;
}();

Byte byte_class(char c) { return kByteClass[static_cast<unsigned char>(c)]; }

constexpr std::size_t kBlock = 1 << 18;
/// Two million numbers; a compressed line without an end would fill the memory.
constexpr std::size_t kLongestLine = std::size_t{64} << 20;

void check_is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw FileError(fmt::format("{}: {}", path.string(), why_unreadable(path)));
  if (status.type() == fs::file_type::none)
    throw FileError(fmt::format("{}: cannot be opened ({})", path.string(), error.message()));
  if (status.type() == fs::file_type::directory)
    throw FileError(fmt::format("{}: is a folder (a file is expected)", path.string()));
  expect_regular_file(path);
}

}  // namespace

struct LineReader::Impl {
  fs::path path;
  std::string name;
  gzFile file = nullptr;
  std::uintmax_t bytes_on_disk = 0;
  std::vector<char> block = std::vector<char>(kBlock);
  std::size_t used = 0;    // bytes of the block that were consumed
  std::size_t filled = 0;  // bytes of the block that hold data
  bool at_start = true;
  bool after_cr = false;  // a LF that comes now belongs to the CR before it
  std::string line;
  bool terminated = true;
  std::int64_t line_number = 0;

  explicit Impl(const fs::path& p) : path(p), name(p.filename().string()) {
    check_is_file(path);
    file = gzopen(path.c_str(), "rb");
    if (!file)
      throw FileError(
          fmt::format("{}: cannot be opened ({})", path.string(), std::strerror(errno)));
    gzbuffer(file, kBlock);
    std::error_code ignored;
    bytes_on_disk = fs::file_size(path, ignored);
  }
  ~Impl() {
    if (file) gzclose(file);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] std::string place() const { return fmt::format("{}:{}", name, line_number + 1); }

  bool fill() {
    const int got = gzread(file, block.data(), static_cast<unsigned>(block.size()));
    int code = Z_OK;
    const char* text = gzerror(file, &code);
    if (code == Z_ERRNO)
      throw FileError(fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
    if (code == Z_BUF_ERROR && got <= 0)
      throw InputError(
          fmt::format("{}: gzip data end too early (the file was cut) copy it again", name));
    if (code != Z_OK && code != Z_BUF_ERROR && code != Z_STREAM_END)
      throw InputError(fmt::format("{}: gzip data are damaged ({}) copy it again", name, text));
    used = 0;
    filled = got > 0 ? static_cast<std::size_t>(got) : 0;
    if (at_start && filled > 0) sniff();
    return filled > 0;
  }

  void sniff() {
    at_start = false;
    const std::string_view start(block.data(), filled);
    for (const Magic& magic : kForeign)
      if (start.starts_with(magic.bytes))
        throw InputError(fmt::format("{}: is {}", name, magic.what));
    if (start.starts_with("\xEF\xBB\xBF")) used = 3;
  }

  [[noreturn]] void refuse(Byte kind) const {
    if (kind == Byte::nul && line_number > 0)
      throw InputError(
          fmt::format("{}: NUL bytes in a text file (a crash or a full disk left a hole) keep the "
                      "lines before it, e.g. `head -n {}`",
                      place(), line_number));
    throw InputError(
        fmt::format("{}: {} in a text file (binary recorder or UTF-16?) record with -file or "
                    "-fileCSV, or save as UTF-8",
                    place(), kind == Byte::nul ? "NUL bytes" : "control characters"));
  }

  bool next(std::string_view& out) {
    line.clear();
    while (used < filled || fill()) {
      if (after_cr) {
        after_cr = false;
        if (block[used] == '\n') {
          ++used;
          continue;
        }
      }
      const auto first = block.begin() + static_cast<std::ptrdiff_t>(used);
      const auto last = block.begin() + static_cast<std::ptrdiff_t>(filled);
      const auto stop =
          std::find_if(first, last, [](char c) { return byte_class(c) != Byte::text; });
      line.append(first, stop);
      if (line.size() > kLongestLine)
        throw InputError(
            fmt::format("{}: the line has more than {} MiB (no recorder has so many columns) is "
                        "this a text file?",
                        place(), kLongestLine >> 20u));
      used = static_cast<std::size_t>(stop - block.begin());
      if (stop == last) continue;
      if (byte_class(*stop) != Byte::line_end) refuse(byte_class(*stop));
      after_cr = *stop == '\r';
      ++used;
      return finish_line(true, out);
    }
    return !line.empty() && finish_line(false, out);
  }

  bool finish_line(bool with_end, std::string_view& out) {
    terminated = with_end;
    ++line_number;
    out = line;
    return true;
  }
};

LineReader::LineReader(const fs::path& path) : impl_(std::make_unique<Impl>(path)) {}
LineReader::~LineReader() = default;
LineReader::LineReader(LineReader&&) noexcept = default;
LineReader& LineReader::operator=(LineReader&&) noexcept = default;

bool LineReader::next(std::string_view& line) { return impl_->next(line); }
bool LineReader::terminated() const { return impl_->terminated; }
std::int64_t LineReader::line_number() const { return impl_->line_number; }
const std::string& LineReader::name() const { return impl_->name; }

double LineReader::fraction() const {
  if (impl_->bytes_on_disk == 0) return 1.0;
  const double read = static_cast<double>(gzoffset(impl_->file));
  return std::clamp(read / static_cast<double>(impl_->bytes_on_disk), 0.0, 1.0);
}

}  // namespace flowslide
