#include "importers/recorder_rows.hpp"

#include "core/check.hpp"

#include <cstdint>

namespace flowslide {

const std::vector<double>& RowCursor::seek(std::size_t row) {
  bool found = true;
  while (found && reader_.row() < static_cast<std::int64_t>(row)) found = reader_.skip();
  found = found && reader_.next(values_);
  if (!found || values_.size() != recorder_->layout.columns() ||
      values_[0] != recorder_->scan.first_column[row])
    throw FileError(fmt::format(
        "{}: changed while it was read (is the run still going?) start the import again",
        recorder_->scan.file));
  return values_;
}

void read_pressure(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                   std::vector<double>& out) {
  const Component p(layout, "p");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = factor * p.at(row, i);
}

void read_vectors(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                  std::vector<Vec2>& out) {
  const Component x(layout, "x");
  const Component y(layout, "y");
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {factor * x.at(row, i), factor * y.at(row, i)};
}

void read_stress(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                 const SigmaZz& rule, std::vector<Stress<2>>& out) {
  const Component xx(layout, "xx");
  const Component yy(layout, "yy");
  const Component zz(layout, "zz");
  const Component xy(layout, "xy");
  for (std::size_t e = 0; e < out.size(); ++e) {
    Stress<2>& s = out[e];
    s[0] = factor * xx.at(row, e);
    s[1] = factor * yy.at(row, e);
    s[3] = factor * xy.at(row, e);
    switch (rule.rule) {
      case SigmaZzRule::mean:
        s[2] = 0.5 * (s[0] + s[1]);
        break;
      case SigmaZzRule::elastic:
        s[2] = *rule.nu * (s[0] + s[1]);
        break;
      case SigmaZzRule::k0:
        s[2] = *rule.k0 * s[1];
        break;
      case SigmaZzRule::recorded:
        s[2] = factor * zz.at(row, e);
        break;
    }
  }
}

void read_strain(const ColumnLayout& layout, const std::vector<double>& row,
                 std::vector<StrainIncrement<2>>& out) {
  const Component xx(layout, "xx");
  const Component yy(layout, "yy");
  const Component xy(layout, "xy");
  for (std::size_t e = 0; e < out.size(); ++e)
    out[e].v = {xx.at(row, e), yy.at(row, e), 0.0, xy.at(row, e)};
}

}  // namespace flowslide
