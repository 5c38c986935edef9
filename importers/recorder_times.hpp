#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Rows of different recorders of one run belong together by their time, never by their number:
/// a killed run cuts each file elsewhere, `-dT` thins them, and time goes back between stages.
namespace flowslide {

/// Rows [first, last) between two resets of time.
struct RowRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Splits where time goes back. Empty input gives no stage.
std::vector<RowRange> split_stages(std::span<const double> times);

/// Smallest and largest increase between rows; zero if there is none.
struct StepRange {
  double min = 0.0;
  double max = 0.0;
};
StepRange step_range(std::span<const double> times);

/// Which stage is taken where time goes back.
enum class StageChoice { only, first, last };

struct FileTimes {
  std::string file;
  std::vector<double> times;  ///< one per row, in the file's unit
};

/// Rows that belong to one instant.
struct AlignedRows {
  std::vector<double> times;                   ///< of the first file, increasing
  std::vector<std::vector<std::size_t>> rows;  ///< [file][instant], from 0
  std::vector<std::string> notes;              ///< what was left out, with counts
};

/// Common instants of all files within the chosen stage; of rows at equal times the last counts.
/// Two times are equal if they agree to the digits that recorders print (1e-5 of the time, at most
/// a quarter of the smallest step). Throws InputError if time goes back and the choice is `only`,
/// or if no time is common.
AlignedRows align_rows(std::span<const FileTimes> files, StageChoice choice);

}  // namespace flowslide
