#pragma once
#include "model/ground_motion.hpp"
#include "motion/record_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Readers of earthquake records: PEER AT2, and text or CSV columns. Plain or gzip.
namespace flowslide {

/// What a file may not say by itself.
struct RecordFormat {
  std::optional<std::string> unit = {};  ///< "g", "cm/s2", ... if the file states none
  std::optional<double> dt = {};         ///< [s], if the file has no time column and no header
  /// Columns from 1, of files that are columns; 0 and 0: a single column is acceleration, and of
  /// two the first is time [s]. With the acceleration named, 0 for time says that there is none.
  int time_column = 0;
  int acceleration_column = 0;
  /// Use the values that an AT2 file holds, where their number is not the NPTS of its header.
  bool accept_count = false;
};

struct Record {
  GroundMotion motion;
  std::vector<std::string> notes;          ///< what the reader corrected or left out
  std::vector<std::string> warnings = {};  ///< what cannot be right, such as a peak of 200 g
};

/// Recognises AT2 by the word NPTS in the first lines, and takes other files for columns.
/// Throws FileError, InputError with file:line.
Record read_record(const std::filesystem::path& path, const RecordFormat& format = {});

/// Whether first lines are those of a record of acceleration: of AT2, of a format that is known and
/// not read, or a heading that names accelerations or their unit.
bool is_record(const RecordText& head);

/// The unit of acceleration that the header or the headings give; empty if none does. Throws
/// InputError for a wrong AT2 header.
std::optional<std::string> stated_unit(const RecordText& text);

/// read_record() for text that is in memory; `name` is for messages.
Record parse_record(std::string_view text, std::string name, const RecordFormat& format = {});

}  // namespace flowslide
