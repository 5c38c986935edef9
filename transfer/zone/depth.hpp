#pragma once
#include "config/schema.hpp"
#include "model/mesh.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

/// Depth of liquefaction below the pond surface in windows of x
/// (docs/theory/liquefaction-zone.md, section 2).
namespace flowslide {

/// Closed interval of x [m].
struct DepthWindow {
  double from = kUnset;
  double to = kUnset;
  [[nodiscard]] bool contains(double x) const { return x >= from && x <= to; }
};
using DepthWindows = std::map<std::string, DepthWindow>;

enum class DepthCoordinates { original, current };
inline constexpr std::array<std::string_view, 2> kDepthCoordinates{"original", "current"};

/// Pond surface minus the lowest y of the nodes in the window whose r_u exceeds the threshold [m];
/// 0 if there is none. A NaN in r_u leaves its node out, as does a zero in `counted`, unless that
/// is empty.
double depth_of_liquefaction(const DepthWindow& window, double pond_surface,
                             std::span<const Vec2> positions, std::span<const double> r_u,
                             double threshold, std::span<const std::uint8_t> counted = {});

template <>
struct Schema<DepthWindow> {
  static constexpr std::string_view doc = "Range of x in which the depth of liquefaction is read.";
  static void describe(FieldVisitor& v, DepthWindow& c);
};

}  // namespace flowslide
