#include "transfer/zone/zone_config.hpp"

#include "core/check.hpp"
#include "model/zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace flowslide {

template <>
struct Schema<RuConfig> {
  static constexpr std::string_view doc = "Excess pore-pressure ratio.";
  static void describe(FieldVisitor& v, RuConfig& c) {
    v.quantity("threshold", c.threshold, Dim::none, {.above = 0.0},
               "soil has liquefied where r_u exceeds this");
    v.choice(
        "sigma_v0", c.sigma_v0, kSigmaSources,
        "initial vertical effective stress at a node: mean of its elements, or element by element");
    v.quantity("floor", c.floor, Dim::stress, {.min = 0.0},
               "no r_u below this initial vertical effective stress");
    v.choice("over_time", c.over_time, kRuOverTimes,
             "the zone follows the largest r_u up to the transfer, or that of the moment");
  }
};

template <>
struct Schema<ColumnConfig> {
  static constexpr std::string_view doc =
      "Columns in which depths and the automatic zone are found.";
  static void describe(FieldVisitor& v, ColumnConfig& c) {
    v.quantity("width", c.width, Dim::length, {.above = 0.0},
               "width; the median width of the liquefiable elements if left out");
    v.integer("neighbours", c.neighbours, {.min = 0, .max = 8},
              "a liquefied node counts if at least so many of its mesh neighbours have liquefied");
    v.flag("interpolate", c.interpolate,
           "the zone ends where r_u falls through the threshold between two nodes of a column; "
           "false: at the lowest liquefied node");
  }
};

void Schema<TransferRuleConfig>::describe(FieldVisitor& v, TransferRuleConfig& c) {
  v.texts("liquefiable", c.liquefiable, "materials that can liquefy, by name");
  v.quantity("pond_surface", c.pond_surface, Dim::length, {},
             "y of the original pond surface, the datum of depths");
  v.choice("when", c.transfer.when, kTransferWhens, "what decides the transfer time");
  v.quantity("at", c.transfer.at, Dim::time, {}, "transfer time, with when: at");
  v.moved("densities",
          "(the shaking brings the densities of its materials) remove it; they are those of "
          "fem.run, or of import.opensees with 'materials: {tailings: {tag: 168, density: 1870 "
          "kg/m3}}'");
  v.group("box", c.box, "part of the section that counts");
  v.table(
      "windows", c.windows,
      "ranges of x in which the depth of liquefaction is read; left out: one, `all`, that holds "
      "the whole liquefiable soil");
  v.choice("depth_coordinates", c.depth_coordinates, kDepthCoordinates,
           "depth of a node where it was, or where it is");
  v.group("r_u", c.r_u, "excess pore-pressure ratio");
  v.group("columns", c.columns, "columns in which depths and the automatic zone are found");
  v.integers("base_nodes", c.base_nodes,
             "node tags whose mean velocity is that of the base; the lowest nodes if left out");
  v.group("automatic", c.transfer.automatic, "criteria of the automatic transfer time");
}

void Schema<ZoneConfig>::describe(FieldVisitor& v, ZoneConfig& c) {
  static constexpr std::array<FieldVisitor::Column, 2> kPoint{
      {{"x", Dim::length}, {"y", Dim::length}}};
  Schema<TransferRuleConfig>::describe(v, c);
  v.choice("zone", c.zone, kZoneExtents,
           "found from r_u, all of the liquefiable soil, above a line, inside a polygon, or of "
           "what is found from r_u only the elements that have liquefied themselves");
  v.rows("line", c.line, kPoint,
         "lower boundary for zone: line, x rising; level to the left, its last segment goes on");
  v.rows("polygon", c.polygon, kPoint, "corners for zone: polygon, in order");
  v.group("strength", c.strength, "residual strength of the liquefied soil");
}

namespace {

void check_points(std::string_view key, const std::vector<std::vector<double>>& points,
                  std::size_t least, bool used) {
  validate(used || points.empty(),
           "{0} is given but zone is another (it would be ignored) write zone: {0}, or remove {0}",
           key);
  if (!used) return;
  validate(points.size() >= least,
           "zone: {0} needs at least {1} points in {0} (it has {2}) add them", key, least,
           points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    validate(points[i].size() == 2 && std::isfinite(points[i][0]) && std::isfinite(points[i][1]),
             "{} point {} is not a pair of numbers (x and y are needed) write [x, y]", key, i + 1);
  }
}

}  // namespace

DepthWindows windows_or_all(const TransferRuleConfig& c) {
  constexpr double far = std::numeric_limits<double>::infinity();
  return c.windows.empty() ? DepthWindows{{std::string(kWholeSoil), {-far, far}}} : c.windows;
}

void check(const TransferRuleConfig& c) {
  validate(!c.liquefiable.empty(),
           "liquefiable is empty (no material can liquefy) give materials by name, e.g. "
           "[tailings]");
  validate(std::isfinite(c.pond_surface),
           "pond_surface is not set (depths have no datum) give it, e.g. 30 m");
  for (const auto& [name, window] : c.windows) {
    validate(window.from < window.to,
             "windows.{}: from {} m is not less than to {} m (the window is empty) exchange them?",
             name, window.from, window.to);
  }
  check(c.transfer);
}

void check(const ZoneConfig& c) {
  check(static_cast<const TransferRuleConfig&>(c));
  check_points("line", c.line, 2, c.zone == ZoneExtent::line);
  for (std::size_t i = 1; i < c.line.size(); ++i) {
    validate(
        c.line[i][0] > c.line[i - 1][0],
        "line point {}: x = {} m does not exceed the point before (the line must have one y for "
        "each x) sort the points",
        i + 1, c.line[i][0]);
  }
  check_points("polygon", c.polygon, 3, c.zone == ZoneExtent::polygon);
  validate(!(found_from_r_u(c.zone) && c.transfer.when == TransferWhen::gravity),
           "zone: automatic with when: gravity (r_u is zero in the gravity state, nothing would be "
           "liquefied) write zone: all, or choose a later time");
  check(c.strength);
  for (const auto& [name, own] : c.strength.materials)
    validate(
        std::ranges::find(c.liquefiable, name) != c.liquefiable.end(),
        "strength.materials.{0}: {0} is not among liquefiable ({1}) (its table would not be used) "
        "correct the name, or add it there",
        name, fmt::join(c.liquefiable, ", "));
}

}  // namespace flowslide
