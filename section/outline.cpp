#include "section/outline.hpp"

#include "core/elementary.hpp"

#include <cmath>

namespace flowslide {
namespace {

double cross(Vec2 a, Vec2 b, Vec2 c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace

double distance(Vec2 a, Vec2 b) { return hypot(b[0] - a[0], b[1] - a[1]); }

double outline_area(std::span<const Vec2> outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

std::optional<Vec2> crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double c_side = cross(a, b, c), d_side = cross(a, b, d);
  const double a_side = cross(c, d, a), b_side = cross(c, d, b);
  // Ends that touch the other segment do not cross it; areas compare with the square of lengths.
  const double zero = 1e-9 * (distance(a, b) + distance(c, d)) * (distance(a, b) + distance(c, d));
  if (std::abs(c_side) <= zero || std::abs(d_side) <= zero || std::abs(a_side) <= zero ||
      std::abs(b_side) <= zero)
    return std::nullopt;
  if ((c_side > 0.0) == (d_side > 0.0) || (a_side > 0.0) == (b_side > 0.0)) return std::nullopt;
  const double t = a_side / (a_side - b_side);
  return Vec2{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

std::optional<Vec2> self_contact(std::span<const Vec2> outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = outline[i], b = outline[(i + 1) % n];
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i && k != (i + 1) % n) {
        const Projection p = project(a, b, outline[k]);
        if (p.parameter >= 0.0 && p.parameter <= 1.0 && p.distance <= 1e-9 * distance(a, b))
          return outline[k];
      }
      if (k > i)
        if (const auto where = crossing(a, b, outline[k], outline[(k + 1) % n])) return where;
    }
  }
  return std::nullopt;
}

Projection project(Vec2 a, Vec2 b, Vec2 p) {
  const double length = distance(a, b);
  const double along = (b[0] - a[0]) * (p[0] - a[0]) + (b[1] - a[1]) * (p[1] - a[1]);
  return {along / (length * length), std::abs(cross(a, b, p)) / length};
}

}  // namespace flowslide
