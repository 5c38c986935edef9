#include "transfer/zone/strength.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

struct TableValue {
  double value;
  bool clamped;
};

TableValue look_up(const StrengthTable& table, double x) {
  if (x < table.front()[0]) return {table.front()[1], true};
  if (x > table.back()[0]) return {table.back()[1], true};
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double x0 = table[i - 1][0];
    const double x1 = table[i][0];
    if (x > x1) continue;
    const double share = (x - x0) / (x1 - x0);
    return {(1.0 - share) * table[i - 1][1] + share * table[i][1], false};
  }
  return {table.back()[1], false};
}

void check_table(const std::string& key, const StrengthTable& table) {
  validate(!table.empty(),
           "{} is empty (the liquefied soil has no strength) give rows of sigma'_v0 and S_r, e.g. "
           "[[50 kPa, 4.3 kPa], [100 kPa, 6.5 kPa]]",
           key);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::vector<double>& row = table[i];
    validate(row.size() == 2, "{} row {} has {} numbers (2 expected) write [sigma'_v0, S_r]", key,
             i + 1, row.size());
    validate(std::isfinite(row[0]) && row[0] >= 0.0,
             "{} row {}: sigma'_v0 is {} Pa (compression is positive) give zero or more", key,
             i + 1, row[0]);
    validate(std::isfinite(row[1]) && row[1] > 0.0,
             "{} row {}: S_r is {} Pa (strength must be positive) correct the row", key, i + 1,
             row[1]);
    validate(
        i == 0 || row[0] > table[i - 1][0],
        "{} row {}: sigma'_v0 {} Pa does not exceed the row before (the table is interpolated) "
        "sort the rows",
        key, i + 1, row[0]);
  }
}

void describe_table(FieldVisitor& v, StrengthTable& table, std::string_view doc) {
  static constexpr std::array<FieldVisitor::Column, 2> kColumns{
      {{"sigma_v0", Dim::stress}, {"strength", Dim::stress}}};
  v.rows("table", table, kColumns, doc);
}

}  // namespace

void check(const StrengthConfig& c) {
  check_table("strength.table", c.table);
  for (const auto& [name, own] : c.materials)
    check_table(fmt::format("strength.materials.{}.table", name), own.table);
  const double bins = c.last_bin / c.bin_width;
  validate(c.bin_width > 0.0 && std::isfinite(c.bin_width) && bins >= 1.0 && bins <= 10000.0 &&
               std::abs(bins - std::round(bins)) < 1e-9 * bins,
           "strength.last_bin {} Pa is not a multiple of strength.bin_width {} Pa (bins would "
           "overlap) e.g. 300 kPa with 50 kPa",
           c.last_bin, c.bin_width);
}

StrengthConfig strength_of(const StrengthConfig& config, const std::string& material) {
  StrengthConfig result = config;
  if (const auto own = config.materials.find(material); own != config.materials.end())
    result.table = own->second.table;
  return result;
}

LayerStrength strength_at(const StrengthConfig& c, double sigma_v0) {
  FLOWSLIDE_EXPECT(std::isfinite(sigma_v0));
  const double sigma = std::max(0.0, sigma_v0);
  const double last = std::round(c.last_bin / c.bin_width);
  const double bin =
      sigma < c.last_bin ? std::min(std::floor(sigma / c.bin_width), last - 1.0) : last;
  const bool binned = c.rule == StrengthRule::binned;
  const TableValue s = look_up(c.table, binned ? (bin + 0.5) * c.bin_width : sigma);
  return {s.value, static_cast<int>(bin), s.clamped || sigma_v0 < 0.0};
}

void Schema<MaterialStrength>::describe(FieldVisitor& v, MaterialStrength& c) {
  describe_table(v, c.table, "S_r of this material, in place of the common table");
}

void Schema<StrengthConfig>::describe(FieldVisitor& v, StrengthConfig& c) {
  describe_table(
      v, c.table,
      "residual strength S_r of the liquefied soil against initial vertical effective stress, "
      "stress rising; the end values hold beyond the ends");
  v.table("materials", c.materials, "liquefiable materials with a table of their own, by name");
  v.choice("rule", c.rule, kStrengthRules,
           "interpolated: S_r at the element's own stress; binned: S_r at the middle of its bin");
  v.quantity("bin_width", c.bin_width, Dim::stress, {.above = 0.0},
             "width of the stress bins that number the layers");
  v.quantity("last_bin", c.last_bin, Dim::stress, {.above = 0.0},
             "stress from which on everything belongs to the last bin");
}

}  // namespace flowslide
