#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// Lines of a record file, plain or gzip, with LF, CRLF or CR ends; line i is number i + 1.
struct RecordText {
  std::string name;  ///< of the file, without the folder, for messages
  std::vector<std::string> lines;
};

/// Splits bytes into lines. Throws InputError for what is not text.
RecordText record_text(std::string_view bytes, std::string name);

/// Throws FileError for a file that cannot be read, InputError for one that is no text.
RecordText read_record_text(const std::filesystem::path& path);

std::string_view trimmed(std::string_view text);
std::string upper_case(std::string_view text);

/// Takes the first number off `text`, with blanks before it. Knows C and Fortran spellings (.5,
/// 1.E+01, 1D-3). False if what comes next is no number.
bool take_number(std::string_view& text, double& value);

/// Appends the numbers of a line, separated by blanks, a comma, a semicolon or only by the sign of
/// the next one. Returns an empty text, or what is wrong.
std::string take_row(std::string_view line, std::vector<double>& values);

}  // namespace flowslide
