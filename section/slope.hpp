#pragma once
#include "model/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

/// A slope for limit equilibrium: soils in zones, water. Slides move in the direction of x.
/// Theory: docs/theory/limit-equilibrium.md
namespace flowslide {

/// A row [sigma'_v, strength] of a table [Pa].
struct StrengthPoint {
  double stress = 0.0, strength = 0.0;
};

struct SlopeSoil {
  std::string name;
  double unit_weight = 0.0;   ///< [N/m3]
  double cohesion = 0.0;      ///< [Pa]; with friction 0 the undrained strength
  double friction = 0.0;      ///< [rad]
  std::optional<double> r_u;  ///< u = r_u sigma_v instead of the water table
  /// Residual strength against sigma'_v before liquefaction, straight between the rows, in place of
  /// cohesion and friction; stress rising.
  std::vector<StrengthPoint> residual;
};

/// Part of the section that has one soil. Where zones overlap, the later one counts.
struct SlopeZone {
  std::size_t soil = 0;  ///< index into SlopeModel::soils
  std::vector<Vec2> outline;
};

struct SlopeModel {
  std::vector<SlopeSoil> soils;
  std::vector<SlopeZone> zones;
  std::vector<Vec2> ground;           ///< surface, x rising
  std::vector<Vec2> water_table;      ///< x rising, level beyond its ends; empty: no water
  double unit_weight_water = 9810.0;  ///< [N/m3]
};

/// Throws InputError: x rising in ground and water table, soils in range, weights positive, no
/// water above the ground (free water would need its own loads).
void check(const SlopeModel& model);

/// y of a line at x; beyond its ends that of the end.
double height_at(const std::vector<Vec2>& line, double x);

/// The part of an outline above a level.
std::vector<Vec2> above_level(const std::vector<Vec2>& outline, double y);

/// What lies above a point of a slip surface.
struct Column {
  double weight = 0.0;         ///< sigma_v at the point [Pa]
  double pore_pressure = 0.0;  ///< [Pa]
  double cohesion = 0.0;       ///< [Pa]
  double tan_friction = 0.0;
  bool inside = false;  ///< the point and the ground above it belong to zones
};
Column column_above(const SlopeModel& model, Vec2 point);

}  // namespace flowslide
