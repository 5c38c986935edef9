#pragma once
#include "model/mesh.hpp"

#include <string>

namespace flowslide {

/// Where the mesh lies over itself: outer edges (of one element only) that cross, lie along one
/// another or end within one another, elements on the same side of an edge, and elements whose
/// corners at a common node lie over each other. Empty, or what is wrong and why, without what to
/// do: "2 pairs of outer edges ..., such as ... (...)".
///
/// A boundary of one loop that passes this test encloses every point once, so no soil is there
/// twice and no seam is open. Nodes at one place are find_joints()'s. The mesh is valid.
std::string overlap(const QuadMesh& mesh);

/// The same for models that may tie parts to each other: soil on soil only, and no seams. What lies
/// wholly within another part touches no edge of it and is a part that shares no node
/// (find_joints()).
std::string soil_on_soil(const QuadMesh& mesh);

}  // namespace flowslide
