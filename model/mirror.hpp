#pragma once
#include "model/history.hpp"
#include "model/section_mesh.hpp"

/// Sections that were drawn with their toe on the left: x changes its sign, and with it horizontal
/// displacement, velocity, shear stress and shear strain. Numbers and tags of nodes and elements
/// stay.
namespace flowslide {

/// Corners of elements stay counter-clockwise.
void mirror(QuadMesh& mesh);

/// Edges keep the soil on the left; what was called left is called right, and the reverse.
void mirror(SectionMesh& section);

void mirror(FemFrame& frame);

}  // namespace flowslide
