#pragma once
#include "mpm/grid.hpp"

#include <limits>
#include <vector>

/// Ground and walls as constraints on nodes.
namespace flowslide::mpm {

/// Ground surface as a polyline x -> height, level beyond its ends; in 3D it does not vary with y.
/// Everything at or below it is ground: it pushes but does not pull, with Coulomb friction.
struct Ground {
  std::vector<double> x;       ///< [m], ascending; a repeated value is a vertical step
  std::vector<double> height;  ///< [m]
  double friction = 0.0;       ///< mu [-]
  [[nodiscard]] double level(double at) const;
  /// Slope dy/dx where the polyline is continuous, 0 at steps and beyond the ends.
  [[nodiscard]] double slope(double at) const;
};

/// Vertical frictionless walls that hold both ways (rollers).
struct Rollers {
  double left = -std::numeric_limits<double>::infinity();  ///< x [m]
  double right = std::numeric_limits<double>::infinity();  ///< x [m]
};

/// Lists the constrained nodes of all active blocks, in block order.
template <int Dim>
void list_boundary_nodes(Grid<Dim>& grid, const Ground& ground, const Rollers& rollers);

}  // namespace flowslide::mpm
