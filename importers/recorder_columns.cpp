#include "importers/recorder_columns.hpp"

#include "core/check.hpp"

#include <fmt/format.h>

namespace flowslide {
namespace {

// "4007 = 1 + 2*2003", or that the division leaves a rest.
std::string factorise(std::size_t columns, std::size_t offset, std::size_t width) {
  const std::size_t values = columns - offset;
  const std::string start = offset == 1 ? "1 + " : "";
  if (values % width == 0) return fmt::format("{}{}*{}", start, width, values / width);
  return fmt::format("{}{}*{:.4g}", start, width,
                     static_cast<double>(values) / static_cast<double>(width));
}

/// Increases by equal steps, but for rounding: time does, values of a shaken section do not.
bool is_time(std::span<const double> column) {
  if (column.size() < 3) return false;
  const double step = (column.back() - column.front()) / static_cast<double>(column.size() - 1);
  for (std::size_t i = 1; i < column.size(); ++i)
    if (!(column[i] - column[i - 1] > 0.5 * step && column[i] - column[i - 1] < 2.0 * step))
      return false;
  return step > 0.0;
}

std::string likely_cause(std::size_t columns, const ColumnLayout& layout,
                         std::span<const double> first_column) {
  const std::size_t n = layout.tags->size();
  const std::size_t width = layout.width();
  if (layout.time && columns == width * n) {
    const std::string missing = fmt::format(
        "one {} is missing: the recorder left it out, and the "
        "table must list exactly the recorded ones",
        layout.noun);
    if (width == 1 && is_time(first_column))
      return fmt::format("The first column is time, so {}", missing);
    const std::string no_time =
        "There is no time column: record with -time, or set `columns.time: false`";
    return width == 1 && first_column.size() < 3 ? fmt::format("{}. Or {}", no_time, missing)
                                                 : no_time;
  }
  if (!layout.time && columns == 1 + width * n)
    return "There is a time column: set `columns.time: true`";
  if (columns == 2 * layout.columns())
    return "Twice the columns: decimal commas read as separators?";
  const std::size_t values = columns - layout.offset();
  if (values % n == 0)
    return fmt::format("It fits {} components per {} instead of [{}]: name them under `columns`",
                       values / n, layout.noun, fmt::join(layout.components, ", "));
  return fmt::format(
      "A recorder leaves out {}s that do not exist or do not know the response, and the table must "
      "list exactly the recorded ones",
      layout.noun);
}

}  // namespace

ColumnLabel column_label(const ColumnLayout& layout) {
  return [layout](std::size_t column) -> std::string {
    if (column <= layout.offset()) return "time";
    const std::size_t value = column - 1 - layout.offset();
    const std::size_t entity = value / layout.width();
    if (entity >= layout.tags->size()) return {};
    return fmt::format("{} {} {}", layout.noun, (*layout.tags)[entity],
                       layout.components[value % layout.width()]);
  };
}

void check_columns(const std::string& file, std::size_t columns, const ColumnLayout& layout,
                   std::span<const double> first_column) {
  if (columns == layout.columns()) return;
  const std::size_t n = layout.tags->size();
  validate(!(layout.time && columns == 1),
           "{}: has a time column only (no {} of the recorder knows the response: SSPquadUP wants "
           "`stress`, quadUP `material 1 stress`; or its list names nothing that exists) check the "
           "recorder line",
           file, layout.noun);
  const std::string with_time = factorise(columns, 1, layout.width());
  const std::string without = factorise(columns, 0, layout.width());
  throw InputError(fmt::format(
      "{}: {} columns = {} (or {} {} time), but {} has {} {}s, which makes {} columns. {}", file,
      columns, layout.time ? with_time : without, layout.time ? without : with_time,
      layout.time ? "without" : "with", layout.mesh_file, n, layout.noun, layout.columns(),
      likely_cause(columns, layout, first_column)));
}

Component::Component(const ColumnLayout& layout, std::string_view name)
    : offset_(layout.offset()), width_(layout.width()) {
  for (std::size_t c = 0; c < width_; ++c)
    if (layout.components[c] == name) positions_.push_back(c);
}

double Component::at(const std::vector<double>& row, std::size_t entity) const {
  const std::size_t first = offset_ + width_ * entity;
  if (positions_.size() == 1) return row[first + positions_[0]];
  double sum = 0.0;
  for (const std::size_t c : positions_) sum += row[first + c];
  return sum / static_cast<double>(positions_.size());
}

}  // namespace flowslide
