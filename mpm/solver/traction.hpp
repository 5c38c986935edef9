#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/grid/points.hpp"

#include <array>
#include <cstdint>
#include <vector>

/// Tractions on stretches of the surface, carried by the points below it. A traction t on a surface
/// with outward normal n is a force on the nodes, int w t dA. With phi falling from 1 at the
/// surface to 0 at some depth it equals int t (w n.grad phi + phi n.grad w) dV, which the points
/// sum up like their own stress, so that soil in equilibrium with t has exactly that stress up to
/// its surface. docs/theory/mpm.md, section Tractions
namespace flowslide::mpm {

/// What one point carries: f_i = share (w_i force + above force n.grad w_i).
template <int Dim>
struct Load {
  std::int32_t index = 0;              ///< Points::index of the point
  double begin = 0.0, ramp = 0.0;      ///< share rises from 0 at begin to 1 after `ramp` > 0 [s]
  std::array<double, Dim> force{};     ///< t V n.grad phi [N]
  std::array<double, Dim> normal{};    ///< n, as at the start
  double above = 0.0;                  ///< phi / n.grad phi: how far above the depth of phi = 0 [m]
  std::int32_t point = -1, tile = -1;  ///< where it is now; -1: it has left
};

/// Finds the points of loads after they were sorted.
template <int Dim>
void find_points(std::vector<Load<Dim>>& loads, const Points<Dim>& points,
                 const Tiling<Dim>& tiling);

/// A stretch of the surface, soil on the right of the way from `from` to `to`.
struct Traction {
  std::array<double, 2> from{}, to{};  ///< [m]
  double pressure = 0.0;               ///< into the soil [Pa]
  double shear = 0.0;                  ///< along the way [Pa]
  double begin = 0.0, ramp = 0.0;      ///< [s]
};

/// Appends the loads of a traction, on points down to `depth` below it. Their forces add up to
/// traction times length. Returns how many points carry it.
std::size_t add_traction(const Traction& traction, double depth, const Points<2>& points,
                         std::vector<Load<2>>& loads);

}  // namespace flowslide::mpm
