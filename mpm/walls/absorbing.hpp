#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/grid/points.hpp"
#include "mpm/kernels/basis.hpp"
#include "mpm/kernels/stress.hpp"

#include <array>
#include <limits>
#include <vector>

/// Planes along the grid beyond which the soil goes on: dashpots take what a wave would carry on
/// (Lysmer & Kuhlemeyer 1969), and the forces that held the soil at the start stay.
/// docs/theory/contact.md, section Absorbing planes
namespace flowslide::mpm {

/// What acts where a plane cuts a grid line of one of its own directions.
template <int Dim>
struct Dashpot {
  std::int32_t plane = 0;             ///< 2 axis, one more for that at the axis' high end
  Coordinate<Dim> line{};             ///< a node of the line, 0 along the axis
  double area = 0.0;                  ///< soil that stands against the plane at the line [m2]
  double area_start = 0.0;            ///< the same at the start [m2]
  double normal = 0.0;                ///< sum of area rho c_p [N s/m]
  double shear = 0.0;                 ///< sum of area rho c_s [N s/m]
  std::array<double, Dim> support{};  ///< force that held the soil at the start [N]
  /// Share of the support that the soil left at the plane still gets.
  [[nodiscard]] double kept() const {
    return area_start > area ? area / area_start : area_start > 0.0 ? 1.0 : 0.0;
  }
};

template <int Dim>
struct Absorbing {
  std::array<double, Dim> low, high;   ///< [m]; infinite: no plane
  std::vector<Dashpot<Dim>> dashpots;  ///< in order of plane and line
  bool supported = false;              ///< supports are known
  Absorbing() {
    low.fill(-std::numeric_limits<double>::infinity());
    high.fill(std::numeric_limits<double>::infinity());
  }
  [[nodiscard]] double plane(std::int32_t p) const { return p % 2 == 0 ? low[p / 2] : high[p / 2]; }
};

/// Brings areas and impedances up to date with the points that lie within a cell of a plane.
template <int Dim, class Basis>
void measure_dashpots(const Grid<Dim>& grid, const Points<Dim>& points,
                      const std::vector<SolverMaterial>& materials, Absorbing<Dim>& absorbing);

}  // namespace flowslide::mpm
