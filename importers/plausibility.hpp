#pragma once
#include "model/history.hpp"

#include <string>
#include <vector>

/// Looks for wrong signs, units and recorder responses in a state in SI. They are warnings: a model
/// may be unusual, and nothing is corrected by guessing.
namespace flowslide {

/// Sign of the vertical effective stress; apparent unit weight
///   gamma = (u - sigma'_yy) / (y_surface - y)
/// of the deeper elements (soil: 10 to 30 kN/m3); pore pressure that is nowhere noticeable.
std::vector<std::string> gravity_warnings(const QuadMesh& mesh, const FemFrame& gravity);

/// Stress and pore pressure must start from the gravity state: a pore pressure recorded as `disp`
/// or `accel` of its degree of freedom, or a gravity row of another stage, does not.
std::vector<std::string> start_warnings(const FemFrame& gravity, const FemFrame& first);

}  // namespace flowslide
