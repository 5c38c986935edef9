#include "mpm/walls/boundary.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {

double Ground::level(double at) const {
  if (at <= x.front()) return height.front();
  if (at >= x.back()) return height.back();
  const auto right = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const double t = (at - x[right - 1]) / (x[right] - x[right - 1]);
  return height[right - 1] + t * (height[right] - height[right - 1]);
}

Nearest Ground::nearest(double at, double elevation) const {
  double best = std::numeric_limits<double>::infinity();
  std::array<double, 2> normal{0.0, 1.0};
  const auto offer = [&](double dx, double dy, const std::array<double, 2>& n) {
    const double distance = hypot(dx, dy);
    // At a corner two pieces are equally near: the one that faces the point more squarely counts.
    const bool squarer =
        std::abs(dx * n[0] + dy * n[1]) > std::abs(dx * normal[0] + dy * normal[1]);
    if (distance < best - 1e-12 || (distance < best + 1e-12 && squarer)) {
      best = std::min(best, distance);
      normal = n;
    }
  };
  offer(std::max(at - x.front(), 0.0), elevation - height.front(), {0.0, 1.0});
  offer(std::min(at - x.back(), 0.0), elevation - height.back(), {0.0, 1.0});
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double dx = x[i + 1] - x[i], dy = height[i + 1] - height[i];
    const double length = hypot(dx, dy);
    if (!(length > 0.0)) continue;
    const double along = ((at - x[i]) * dx + (elevation - height[i]) * dy) / (length * length);
    const double t = std::clamp(along, 0.0, 1.0);
    offer(at - x[i] - t * dx, elevation - height[i] - t * dy, {-dy / length, dx / length});
  }
  return {elevation >= level(at) ? best : -best, normal};
}

}  // namespace flowslide::mpm
