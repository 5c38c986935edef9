#pragma once
#include "model/mesh.hpp"

#include <string>

namespace flowslide {

/// Where the mesh lies over itself: outer edges (of one element only) that cross, lie along one
/// another or end within one another, and elements on the same side of an edge. Empty, or what is
/// wrong and why, without what to do: "2 pairs of outer edges ..., such as ... (...)".
///
/// A boundary of one loop that passes this test encloses every point once, so no soil is there
/// twice and no seam is open. Nodes at one place are find_joints()'s. The mesh is valid.
std::string overlap(const QuadMesh& mesh);

}  // namespace flowslide
