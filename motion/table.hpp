#pragma once
#include "motion/measures.hpp"
#include "motion/record.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What `flowslide motion` prints.
namespace flowslide {

struct MotionRow {
  std::string file;  ///< as the user wrote it
  std::size_t npts = 0;
  double dt = kUnset;       ///< [s]
  MotionMeasures measures;  ///< pgv and masi of the motion scaled to the wanted pga, if any
  std::vector<std::string> notes, warnings;
};

/// Reads and measures a record. `scale_to` is a peak acceleration [m/s2] for pgv and masi alone;
/// period and durations do not change with it, and pga and arias stay those of the record. Throws
/// FileError, InputError.
MotionRow measure_record(const std::filesystem::path& path, std::optional<double> scale_to = {},
                         const RecordFormat& format = {});

/// Aligned columns with their units, for people.
std::string motion_table(std::span<const MotionRow> rows, std::optional<double> scale_to = {});
/// The same with a line for each measure, for narrow terminals.
std::string motion_list(std::span<const MotionRow> rows, std::optional<double> scale_to = {});

/// [{"file", "npts", "dt_s", "pga_g", "arias_m_s", "d5_95_s", "tm_s", "pgv_cm_s", "masi_m_s"}]
std::string motion_json(std::span<const MotionRow> rows);

}  // namespace flowslide
