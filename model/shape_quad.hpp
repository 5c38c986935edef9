#pragma once
#include "model/mesh.hpp"

#include <array>
#include <optional>

namespace flowslide {

/// Bilinear shape functions at (xi, eta) in [-1,1]^2, node order (-,-) (+,-) (+,+) (-,+).
std::array<double, 4> shape(double xi, double eta);

/// Position, or any nodal vector, interpolated to (xi, eta).
Vec2 interpolate(const std::array<Vec2, 4>& nodal, double xi, double eta);
double interpolate(const std::array<double, 4>& nodal, double xi, double eta);

/// Determinant of d(x,y)/d(xi,eta) [m2].
double jacobian(const std::array<Vec2, 4>& quad, double xi, double eta);

/// Natural coordinates of a point (Newton); empty if the point lies outside by more than
/// `tolerance` in natural coordinates or the iteration fails.
std::optional<Vec2> natural_coordinates(const std::array<Vec2, 4>& quad, Vec2 point,
                                        double tolerance = 1e-9);

}  // namespace flowslide
