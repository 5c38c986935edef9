#pragma once
#include "importers/text_lines.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

/// Text and CSV recorders: rows of numbers, one row per recorded instant, no header, no units.
namespace flowslide {

/// Splits lines into numbers at blanks or commas. The first line decides which; a file that mixes
/// both is refused, for its commas may be decimal ones.
class NumberLine {
 public:
  /// Replaces `values`; returns an empty text, or the problem with the token and its column.
  /// IEEE words (`nan`, `-inf`) and their old Windows spellings (`1.#QNAN`) are numbers here.
  std::string parse(std::string_view line, std::vector<double>& values);

  /// Whether the line is a header: a `#` or `//` comment, or only words that no number starts.
  static bool is_header(std::string_view line);

 private:
  char separator_ = 0;  // 0 until the first line was seen
};

/// Streams the complete rows of a recorder. The last line counts only if it ends in a newline, for
/// its last number may have lost digits otherwise.
class RecorderReader {
 public:
  /// Throws FileError, InputError.
  explicit RecorderReader(const std::filesystem::path& path);

  /// Next row, all columns. Throws InputError with file:line for a row that is no row of numbers or
  /// has another length than the first; the reader then stands after that row. False at the end.
  bool next(std::vector<double>& values);
  /// Passes over a row without reading its numbers.
  bool skip();

  [[nodiscard]] std::int64_t row() const { return row_; }  ///< of the last row, from 1
  [[nodiscard]] std::int64_t line() const { return lines_.line_number(); }
  [[nodiscard]] std::size_t columns() const { return columns_; }  ///< 0 before the first row
  [[nodiscard]] double fraction() const { return lines_.fraction(); }
  [[nodiscard]] const std::string& name() const { return lines_.name(); }
  /// Header lines that were skipped, a torn last line that was dropped; complete at the end.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  bool next_line(std::string_view& line);

  LineReader lines_;
  NumberLine numbers_;
  std::int64_t row_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::string> notes_;
};

/// What one pass over a recorder finds. Times are the first column, in the file's own unit.
struct RecorderScan {
  std::string file;                                             ///< name without the folder
  std::size_t columns = 0;                                      ///< of the first row
  std::int64_t rows = 0;                                        ///< complete rows, good or bad
  std::int64_t good_rows = 0;                                   ///< rows before the first problem
  std::vector<double> first_column;                             ///< of the good rows
  double value_min = std::numeric_limits<double>::infinity();   ///< finite values, columns 2 and on
  double value_max = -std::numeric_limits<double>::infinity();  ///< the same
  std::int64_t non_finite = 0;        ///< number of NaN and infinite values
  std::vector<std::string> problems;  ///< at most ten, each with file:line
  std::vector<std::string> notes;     ///< header skipped, torn line dropped
};

/// Names the entity and component of a column (from 1), e.g. "node 17 y"; may be empty.
using ColumnLabel = std::function<std::string(std::size_t)>;

/// Reads the whole file once. Malformed rows and non-finite values are collected, not thrown, and
/// so is what is not text at all. `tick` is called between rows with the share that was read.
/// Throws FileError.
RecorderScan scan_recorder(const std::filesystem::path& path, const ColumnLabel& label = {},
                           const std::function<void(double)>& tick = {});

/// For `inspect`: a scan in words and numbers.
struct RecorderSummary {
  std::size_t columns = 0;
  std::int64_t rows = 0;
  bool has_time = false;    ///< the first column increases, apart from resets
  double time_first = 0.0;  ///< meaningful with has_time, in the file's unit
  double time_last = 0.0;
  double step_min = 0.0;  ///< smallest and largest increase of time
  double step_max = 0.0;
  int stages = 0;          ///< 1 + number of times that time goes back
  double value_min = 0.0;  ///< over all columns but time
  double value_max = 0.0;
  std::vector<std::string> problems;
  std::vector<std::string> notes;
};

/// `tick` learns after every row what share of the file has been read. Throws FileError.
RecorderSummary summarize_recorder(const std::filesystem::path& path,
                                   const std::function<void(double)>& tick = {});

}  // namespace flowslide
