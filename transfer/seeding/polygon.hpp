#pragma once
#include "model/mesh.hpp"

#include <array>
#include <cstddef>

/// Exact intersection of finite elements with lattice cells: convex polygons and axis-aligned
/// boxes.
namespace flowslide {

/// Axis-aligned rectangle [m].
struct Box {
  double xmin = 0.0, xmax = 0.0, ymin = 0.0, ymax = 0.0;
  [[nodiscard]] bool contains(Vec2 p) const {
    return p[0] >= xmin && p[0] <= xmax && p[1] >= ymin && p[1] <= ymax;
  }
};

/// Convex polygon, counter-clockwise. A quadrilateral cut by two boxes has at most 12 corners; the
/// rest is room for rounding.
struct Polygon {
  static constexpr std::size_t kCapacity = 16;
  std::array<Vec2, kCapacity> corner{};
  std::size_t size = 0;
  void push(Vec2 p) { corner.at(size++) = p; }
};

/// Area [m2] and centroid [m]; the centroid of an empty or flat polygon is its first corner.
struct AreaMoment {
  double area = 0.0;
  Vec2 centroid{};
};
AreaMoment area_moment(const Polygon& polygon);

enum class Side { below, above };

/// The part of `polygon` whose coordinate `axis` lies on `side` of `bound` (Sutherland and Hodgman,
/// Comm. ACM 17, 1974). Both sides of one bound compute bitwise the same cut points, so that the
/// parts tile the whole.
Polygon clip(const Polygon& polygon, int axis, double bound, Side side);
Polygon clip(const Polygon& polygon, const Box& box);

/// Bounding box of a polygon with at least one corner.
Box bounds(const Polygon& polygon);

/// A quadrilateral as convex polygons: itself, or two triangles if one corner is re-entrant.
struct ConvexParts {
  std::array<Polygon, 2> part;
  int count = 0;  ///< 0 if the quadrilateral is folded: self-crossing, or not of positive area
};
ConvexParts convex_parts(const std::array<Vec2, 4>& quad);

}  // namespace flowslide
