#include "transfer/zone/depth.hpp"

#include "core/check.hpp"

#include <algorithm>

namespace flowslide {

double depth_of_liquefaction(const DepthWindow& window, double pond_surface,
                             std::span<const Vec2> positions, std::span<const double> r_u,
                             double threshold, std::span<const std::uint8_t> counted) {
  FLOWSLIDE_EXPECT(positions.size() == r_u.size());
  FLOWSLIDE_EXPECT(counted.empty() || counted.size() == r_u.size());
  double depth = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!counted.empty() && counted[i] == 0) continue;
    if (!(r_u[i] > threshold) || !window.contains(positions[i][0])) continue;
    depth = std::max(depth, pond_surface - positions[i][1]);
  }
  return depth;
}

void Schema<DepthWindow>::describe(FieldVisitor& v, DepthWindow& c) {
  v.quantity("from", c.from, Dim::length, {}, "upstream end");
  v.quantity("to", c.to, Dim::length, {}, "downstream end");
}

}  // namespace flowslide
