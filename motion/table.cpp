#include "motion/table.hpp"

#include "core/conventions.hpp"
#include "motion/foreign.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

namespace {

/// Digits after the point where they fit, else three in all.
std::string number(double value, int digits) {
  constexpr double kLong = 1e7;
  return std::abs(value) < kLong ? fmt::format("{:.{}f}", value, digits)
                                 : fmt::format("{:.3g}", value);
}

struct Column {
  const char *name, *unit;
  int width;
};
constexpr std::array<Column, 8> kMeasured{{{"npts", "", 7},
                                           {"dt", "s", 7},
                                           {"PGA", "g", 8},
                                           {"Arias", "m/s", 10},
                                           {"D5-95", "s", 8},
                                           {"Tm", "s", 7},
                                           {"PGV", "cm/s", 9},
                                           {"MASI", "m/s", 9}}};

/// In the order of the columns.
std::array<std::string, kMeasured.size()> cells(const MotionRow& row) {
  const MotionMeasures& m = row.measures;
  return {fmt::format("{}", row.npts), fmt::format("{:.5g}", row.dt),
          number(m.pga / kGravity, 4), fmt::format("{:.4g}", m.arias),
          number(m.d5_95, 2),          number(m.tm, 3),
          number(100.0 * m.pgv, 2),    number(m.masi, 3)};
}

std::string scaling(std::optional<double> scale_to) {
  return scale_to ? fmt::format("PGV and MASI after scaling to {:.4g} g\n", *scale_to / kGravity)
                  : "";
}

}  // namespace

std::string motion_table(std::span<const MotionRow> rows, std::optional<double> scale_to) {
  std::size_t width = 4;
  for (const MotionRow& row : rows) width = std::max(width, row.file.size());
  std::string text = fmt::format("{:<{}}", "file", width);
  for (const Column& c : kMeasured) text += fmt::format(" {:>{}}", c.name, c.width);
  text += fmt::format("\n{:<{}}", "", width);
  for (const Column& c : kMeasured) text += fmt::format(" {:>{}}", c.unit, c.width);
  text += '\n';
  for (const MotionRow& row : rows) {
    text += fmt::format("{:<{}}", row.file, width);
    const auto values = cells(row);
    for (std::size_t i = 0; i < kMeasured.size(); ++i)
      text += fmt::format(" {:>{}}", values[i], kMeasured[i].width);
    text += '\n';
  }
  return text + scaling(scale_to);
}

std::string motion_list(std::span<const MotionRow> rows, std::optional<double> scale_to) {
  std::string text;
  for (const MotionRow& row : rows) {
    text += row.file + '\n';
    const auto values = cells(row);
    for (std::size_t i = 0; i < kMeasured.size(); ++i)
      text += fmt::format("  {:<6} {:>10} {}\n", kMeasured[i].name, values[i], kMeasured[i].unit);
  }
  return text + scaling(scale_to);
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
