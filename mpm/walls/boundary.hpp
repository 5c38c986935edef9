#pragma once
#include "mpm/walls/height_field.hpp"

#include <array>
#include <limits>
#include <optional>
#include <vector>

/// Shapes of the ground and of walls.
namespace flowslide::mpm {

/// Signed distance to a surface and its unit normal, both positive on the soil's side.
struct Nearest {
  double distance;               ///< [m]
  std::array<double, 2> normal;  ///< horizontal, vertical
};

/// Ground surface as a polyline x -> height, level beyond its ends; in 3D it does not vary with y,
/// or is a height field. Everything below it is ground: it pushes but does not pull, with Coulomb
/// friction.
struct Ground {
  std::vector<double> x;       ///< [m], ascending; a repeated value is a vertical step
  std::vector<double> height;  ///< [m]
  double friction = 0.0;       ///< mu [-]
  std::optional<HeightField> field =
      std::nullopt;  ///< three dimensions only: in place of the polyline
  [[nodiscard]] double level(double at) const;
  [[nodiscard]] Nearest nearest(double at, double elevation) const;
};

/// Vertical walls that hold both ways without friction.
struct Rollers {
  double left = -std::numeric_limits<double>::infinity();  ///< x [m]
  double right = std::numeric_limits<double>::infinity();  ///< x [m]
  double near = -std::numeric_limits<double>::infinity();  ///< y [m], three dimensions only
  double far = std::numeric_limits<double>::infinity();    ///< y [m], likewise
  /// Above 0 those two push only, with Coulomb friction, as the ground does.
  double side_friction = 0.0;
};

}  // namespace flowslide::mpm
