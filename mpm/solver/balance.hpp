#pragma once
#include "model/front.hpp"
#include "model/mpm_history.hpp"
#include "mpm/solver/simulation.hpp"

#include <span>

/// Conserved quantities and the fifth-farthest point: the rows of the time series.
namespace flowslide::mpm {

/// Energies and momentum of the points.
template <int Dim>
struct PointSums {
  double mass = 0.0;                   ///< [kg]
  double kinetic = 0.0;                ///< with the affine field: m/2 (|v|^2 + D C:C) [J]
  double potential = 0.0;              ///< -sum m g.x [J]
  double recoverable = 0.0;            ///< sum V (p^2 / 2K + J2 / 2G), total stress [J]
  std::array<double, Dim> momentum{};  ///< [N s]
  bool finite = true;                  ///< no NaN or infinity in any of them
  std::int32_t first_bad = -1;         ///< ParticleSet index of a point that is not finite
};

/// Sums over some points of a simulation in storage order: the same bits for any number of threads.
template <int Dim>
PointSums<Dim> sum_points(const Simulation<Dim>& s, const Points<Dim>& points);
template <int Dim>
PointSums<Dim> sum_points(const Simulation<Dim>& s) {
  return sum_points(s, s.points);
}

/// Sums at the start of the run that the balances refer to.
template <int Dim>
struct Reference {
  PointSums<Dim> start;
  double toe = 0.0;  ///< [m]
};

/// A row of the time series; `counts` tells per material whether it counts for the runout and
/// `scratch` is reused. Throws NumericsError if a point is not finite.
template <int Dim>
MpmSample sample(const Simulation<Dim>& s, const Reference<Dim>& reference,
                 const std::vector<bool>& counts, std::vector<Place>& scratch);

}  // namespace flowslide::mpm
