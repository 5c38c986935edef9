#pragma once
#include "study/run/study_state.hpp"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide::study {

enum class Role { row, input, disturbance, state, found, key };

/// One column of the table of all rows.
struct Column {
  std::string name;
  Role role = Role::found;
  std::string unit;    ///< empty for words and plain numbers
  std::string source;  ///< settings that it sets, or stage and type that found it
  bool is_number = false;
  std::vector<std::string> text;  ///< as in the CSV; empty where a row has none
  std::vector<double> number;     ///< NaN where a row has none
  std::vector<std::size_t> node;  ///< found: the stage of each row; kNoNode where none
};
inline constexpr std::size_t kNoNode = std::numeric_limits<std::size_t>::max();

/// What stages of that name warned of, in rows so many. Texts that differ only in their numbers are
/// one, with the first one's.
struct TableWarning {
  std::string stage, text;
  std::size_t rows = 0;
  std::vector<std::size_t> in;  ///< those rows, from 0
};

struct Table {
  std::vector<Column> columns;
  std::vector<TableWarning> warnings;
  std::size_t rows = 0;
  [[nodiscard]] const Column* find(std::string_view name) const;
};

/// Every row of the plan, with what its finished stages have found: the same bits whenever and in
/// whatever order they were computed. Times of computing are left out for that.
Table make_table(const Plan& plan, const StudyState& progress);

/// Comma-separated, one header line; units in brackets where the name does not say them.
std::string to_csv(const Table& table);
/// What each column is: name, unit, role, settings or stage.
std::string columns_csv(const Table& table);
/// HDF5, kind "study_table": a dataset per column.
void write_hdf5(const std::filesystem::path& path, const Table& table);

/// "m" of "runout_m"; empty if the name ends in no unit.
std::string unit_in_name(std::string_view name);
/// "runout" of "runout_m"; the name itself if it ends in no unit.
std::string without_unit(std::string_view name);

}  // namespace flowslide::study
