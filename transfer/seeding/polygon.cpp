#include "transfer/seeding/polygon.hpp"

#include <algorithm>

namespace flowslide {
namespace {

double cross(Vec2 a, Vec2 b, Vec2 c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Polygon triangle(Vec2 a, Vec2 b, Vec2 c) {
  Polygon p;
  for (const Vec2& v : {a, b, c}) p.push(v);
  return p;
}

}  // namespace

AreaMoment area_moment(const Polygon& polygon) {
  AreaMoment result;
  if (polygon.size == 0) return result;
  // Relative to the first corner: coordinates of a section are hundreds of metres, pieces
  // millimetres.
  const Vec2 o = polygon.corner[0];
  double twice = 0.0, mx = 0.0, my = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    const double ax = polygon.corner[i][0] - o[0], ay = polygon.corner[i][1] - o[1];
    const double bx = polygon.corner[i + 1][0] - o[0], by = polygon.corner[i + 1][1] - o[1];
    const double c = ax * by - ay * bx;
    twice += c;
    mx += c * (ax + bx);
    my += c * (ay + by);
  }
  result.area = 0.5 * twice;
  result.centroid = twice > 0.0 ? Vec2{o[0] + mx / (3.0 * twice), o[1] + my / (3.0 * twice)} : o;
  return result;
}

Polygon clip(const Polygon& polygon, int axis, double bound, Side side) {
  Polygon out;
  const int other = 1 - axis;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Vec2& a = polygon.corner[i];
    const Vec2& b = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    const double da = a[axis] - bound, db = b[axis] - bound;
    if (side == Side::below ? da <= 0.0 : da >= 0.0) out.push(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
      Vec2 cut;
      cut[axis] = bound;
      cut[other] = a[other] + (b[other] - a[other]) * (da / (da - db));
      out.push(cut);
    }
  }
  if (out.size < 3) out.size = 0;
  return out;
}

Polygon clip(const Polygon& polygon, const Box& box) {
  Polygon p = clip(polygon, 0, box.xmin, Side::above);
  if (p.size) p = clip(p, 0, box.xmax, Side::below);
  if (p.size) p = clip(p, 1, box.ymin, Side::above);
  if (p.size) p = clip(p, 1, box.ymax, Side::below);
  return p;
}

Box bounds(const Polygon& polygon) {
  Box b{polygon.corner[0][0], polygon.corner[0][0], polygon.corner[0][1], polygon.corner[0][1]};
  for (std::size_t i = 1; i < polygon.size; ++i) {
    b.xmin = std::min(b.xmin, polygon.corner[i][0]);
    b.xmax = std::max(b.xmax, polygon.corner[i][0]);
    b.ymin = std::min(b.ymin, polygon.corner[i][1]);
    b.ymax = std::max(b.ymax, polygon.corner[i][1]);
  }
  return b;
}

ConvexParts convex_parts(const std::array<Vec2, 4>& quad) {
  ConvexParts parts;
  int reentrant = -1, num_reentrant = 0;
  for (int i = 0; i < 4; ++i) {
    if (!(cross(quad[(i + 3) % 4], quad[i], quad[(i + 1) % 4]) > 0.0)) {
      reentrant = i;
      ++num_reentrant;
    }
  }
  if (num_reentrant == 0) {
    for (const Vec2& v : quad) parts.part[0].push(v);
    parts.count = 1;
  } else if (num_reentrant == 1) {
    // The diagonal from the re-entrant corner lies inside; both halves must be upright.
    const int r = reentrant;
    parts.part[0] = triangle(quad[r], quad[(r + 1) % 4], quad[(r + 2) % 4]);
    parts.part[1] = triangle(quad[r], quad[(r + 2) % 4], quad[(r + 3) % 4]);
    if (area_moment(parts.part[0]).area > 0.0 && area_moment(parts.part[1]).area > 0.0)
      parts.count = 2;
  }
  return parts;
}

}  // namespace flowslide
