#pragma once
#include "config/schema.hpp"
#include "transfer/zone/depth.hpp"
#include "transfer/zone/section_box.hpp"
#include "transfer/zone/strength.hpp"
#include "transfer/zone/transfer_time.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Settings of the stage transfer.zone; reasons of the defaults in
/// docs/theory/liquefaction-zone.md.
namespace flowslide {

enum class ZoneExtent { automatic, all, line, polygon, liquefied };
inline constexpr std::array<std::string_view, 5> kZoneExtents{"automatic", "all", "line", "polygon",
                                                              "liquefied"};
/// Whether the extent is found from r_u, and not given.
constexpr bool found_from_r_u(ZoneExtent z) {
  return z == ZoneExtent::automatic || z == ZoneExtent::liquefied;
}

/// sigma'_v0 that divides the excess pore pressure of a node: mean of the adjacent elements, or
/// each element's own value as in the published script, the node taking the mean of the ratios.
enum class SigmaSource { nodal, element };
inline constexpr std::array<std::string_view, 2> kSigmaSources{"nodal", "element"};

/// r_u from which the zone is found: the largest up to the transfer, or that of the moment.
enum class RuOverTime { maximum, instantaneous };
inline constexpr std::array<std::string_view, 2> kRuOverTimes{"maximum", "instantaneous"};

struct RuConfig {
  double threshold = 0.7;
  SigmaSource sigma_v0 = SigmaSource::nodal;
  double floor = 8e3;  ///< nodes with less initial vertical effective stress have no r_u [Pa]
  RuOverTime over_time = RuOverTime::maximum;
};

struct ColumnConfig {
  std::optional<double> width;  ///< [m]; median width of the liquefiable elements if left out
  int neighbours = 1;           ///< liquefied mesh neighbours that a liquefied node needs to count
  bool interpolate = true;      ///< bottom of the zone where r_u passes the threshold, or at nodes
};

/// What decides the transfer time.
struct TransferRuleConfig {
  std::vector<std::string> liquefiable;  ///< materials by name
  double pond_surface = kUnset;          ///< y of the pond surface, datum of depths [m]
  SectionBox box;
  DepthWindows windows;  ///< see windows_or_all
  DepthCoordinates depth_coordinates = DepthCoordinates::original;
  RuConfig r_u;
  ColumnConfig columns;
  std::vector<int> base_nodes;  ///< node tags; the lowest nodes if empty
  TransferTimeConfig transfer;
};

/// The windows; without any, one named "all" that holds every x.
DepthWindows windows_or_all(const TransferRuleConfig& config);

struct ZoneConfig : TransferRuleConfig {
  ZoneExtent zone = ZoneExtent::automatic;
  std::vector<std::vector<double>> line;     ///< points [x, y] for zone: line [m]
  std::vector<std::vector<double>> polygon;  ///< corners [x, y] for zone: polygon [m]
  StrengthConfig strength;
};

/// Relations between settings that the ranges of the schema cannot express. Throws InputError.
void check(const TransferRuleConfig& config);
void check(const ZoneConfig& config);

template <>
struct Schema<TransferRuleConfig> {
  static constexpr std::string_view doc = "What decides the time of transfer.";
  static void describe(FieldVisitor& v, TransferRuleConfig& c);
};

template <>
struct Schema<ZoneConfig> {
  static constexpr std::string_view doc =
      "Where the section has liquefied, how strong it remains, and when it is transferred.";
  static void describe(FieldVisitor& v, ZoneConfig& c);
};

}  // namespace flowslide
