#pragma once
#include "model/mesh.hpp"

#include <array>
#include <vector>

namespace flowslide {

/// Share of the length of a line at each of its points, 0 to 1.
std::vector<double> length_shares(const std::vector<Vec2>& line);

/// Points of a structured grid from those of its four sides, listed from corner to corner with both
/// ends: `bottom` and `top` with nx + 1 points from left to right, `left` and `right` with ny + 1
/// from bottom to top. Transfinite interpolation (Gordon & Hall, Int. J. Numer. Meth. Eng. 7, 1973)
/// with coordinates that blend the spacings of opposite sides. Returns (nx + 1)(ny + 1) points, x
/// fastest.
struct GridSides {
  std::vector<Vec2> bottom, right, top, left;
};
std::vector<Vec2> transfinite(const GridSides& sides);

}  // namespace flowslide
