#pragma once
#include "section/slope.hpp"

#include <optional>
#include <vector>

/// Factors of safety of one slip surface by the method of slices. Theory and sign conventions:
/// docs/theory/limit-equilibrium.md
namespace flowslide {

/// A slice of the sliding mass, per metre of width.
struct Slice {
  Vec2 base{};                 ///< middle of its base [m]
  double width = 0.0;          ///< [m]
  double angle = 0.0;          ///< of the base, positive where it falls in the direction of x [rad]
  double weight = 0.0;         ///< [N/m]
  double pore_pressure = 0.0;  ///< at the base [Pa]
  double cohesion = 0.0;       ///< at the base [Pa]
  double tan_friction = 0.0;
};

/// Slices between the points of a slip surface, x rising, which starts and ends on the ground: each
/// leg is divided into slices of at most `width`. Empty if the surface leaves the soil or rises
/// above the ground.
std::vector<Slice> cut_slices(const SlopeModel& model, const std::vector<Vec2>& surface,
                              double width);

/// A circle below its centre, from its left to its right crossing of the ground.
std::vector<Vec2> arc(Vec2 centre, double radius, double x_left, double x_right, int legs);

/// Moment equilibrium with forces between slices neglected (Fellenius 1936). Circles only.
std::optional<double> ordinary(const std::vector<Slice>& slices);

/// Moment equilibrium with horizontal forces between slices (Bishop 1955, simplified). Circles
/// only. Empty if it does not converge or a slice has no admissible normal force.
std::optional<double> bishop(const std::vector<Slice>& slices);

struct SpencerResult {
  double factor = 0.0;
  double inclination =
      0.0;  ///< of all forces between slices, downwards in the direction of x [rad]
};

/// Force and moment equilibrium with parallel forces between slices (Spencer 1967), surfaces of any
/// shape. Empty if no inclination balances both, or a slice has no admissible normal force.
std::optional<SpencerResult> spencer(const std::vector<Slice>& slices);

}  // namespace flowslide
