#include "motion/table.hpp"

#include "core/conventions.hpp"
#include "motion/foreign.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace flowslide {

MotionRow measure_record(const std::filesystem::path& path, std::optional<double> scale_to,
                         const RecordFormat& format) {
  validate(!scale_to || (*scale_to > 0.0 && std::isfinite(*scale_to)),
           "a peak acceleration of {} m/s2 cannot be scaled to (it must be positive)",
           scale_to.value_or(0.0));
  Record record = read_record(path, format);
  MotionRow row{.file = path.string(),
                .npts = record.motion.acceleration.size(),
                .dt = record.motion.dt,
                .measures = measure(record.motion),
                .notes = std::move(record.notes),
                .warnings = std::move(record.warnings)};
  if (std::string odd = implausible_velocity(path.filename().string(), record.motion); !odd.empty())
    row.warnings.push_back(std::move(odd));
  if (scale_to) {
    const double factor = *scale_to / row.measures.pga;
    row.measures.pgv *= factor;
    row.measures.masi *= factor;
  }
  return row;
}

std::string motion_table(std::span<const MotionRow> rows, std::optional<double> scale_to) {
  std::size_t width = 4;
  for (const MotionRow& row : rows) width = std::max(width, row.file.size());
  std::string text =
      fmt::format("{:<{}} {:>7} {:>7} {:>8} {:>10} {:>8} {:>7} {:>9} {:>9}\n", "file", width,
                  "npts", "dt", "PGA", "Arias", "D5-95", "Tm", "PGV", "MASI");
  text += fmt::format("{:<{}} {:>7} {:>7} {:>8} {:>10} {:>8} {:>7} {:>9} {:>9}\n", "", width, "",
                      "s", "g", "m/s", "s", "s", "cm/s", "m/s");
  for (const MotionRow& row : rows) {
    const MotionMeasures& m = row.measures;
    text += fmt::format(
        "{:<{}} {:>7} {:>7.5g} {:>8.4f} {:>10.4g} {:>8.2f} {:>7.3f} {:>9.2f} {:>9.3f}\n", row.file,
        width, row.npts, row.dt, m.pga / kGravity, m.arias, m.d5_95, m.tm, 100.0 * m.pgv, m.masi);
  }
  if (scale_to)
    text += fmt::format("PGV and MASI after scaling to {:.4g} g\n", *scale_to / kGravity);
  return text;
}

std::string motion_json(std::span<const MotionRow> rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MotionRow& row : rows) {
    const MotionMeasures& m = row.measures;
    list.push_back({{"file", row.file},
                    {"npts", row.npts},
                    {"dt_s", row.dt},
                    {"pga_g", m.pga / kGravity},
                    {"arias_m_s", m.arias},
                    {"d5_95_s", m.d5_95},
                    {"tm_s", m.tm},
                    {"pgv_cm_s", 100.0 * m.pgv},
                    {"masi_m_s", m.masi}});
  }
  // A file name need not be UTF-8.
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace flowslide
