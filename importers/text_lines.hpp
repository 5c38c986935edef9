#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace flowslide {

/// Up to which every whole number is a double: 2^53.
inline constexpr double kLargestExactInteger = 9007199254740992.0;

/// Reads a text file line by line, plain or gzip, in constant memory; lines have up to 64 MiB and
/// end in LF, CRLF or CR; a UTF-8 byte order mark is skipped. What is not
/// text (HDF5, XML, archives, UTF-16, binary recorders, NUL bytes) is refused with an explanation.
class LineReader {
 public:
  /// Throws FileError if the file cannot be opened, InputError if it is not text.
  explicit LineReader(const std::filesystem::path& path);
  ~LineReader();
  LineReader(LineReader&&) noexcept;
  LineReader& operator=(LineReader&&) noexcept;

  /// Next line without its end, valid until the next call; false at the end of the file.
  /// Throws InputError with file:line, FileError.
  bool next(std::string_view& line);

  /// Whether the last line returned had a line end; only the last line of a file may lack it.
  [[nodiscard]] bool terminated() const;
  [[nodiscard]] std::int64_t line_number() const;  ///< of the last line returned, from 1
  [[nodiscard]] double fraction() const;           ///< share of the file that was read, 0 to 1
  [[nodiscard]] const std::string& name() const;   ///< file name for messages, without the folder

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flowslide
