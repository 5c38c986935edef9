#pragma once
#include "model/mesh.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// What can be wrong with a mesh although every line of its file is right.
namespace flowslide {

/// Pairs of elements with the same four nodes, in any order: soil that would be there twice.
std::vector<std::array<std::size_t, 2>> repeated_elements(const QuadMesh& mesh);

struct MeshJoints {
  std::size_t parts = 0;                                ///< that share no node with each other
  std::vector<std::array<std::int32_t, 2>> coincident;  ///< used nodes that lie on another one
};
MeshJoints find_joints(const QuadMesh& mesh);

/// "5 nodes lie on another node, such as 9 and 17 at (0, 2) m, and the section falls into 2 parts
/// ..." with what to do; empty for a section of one piece.
std::string unjoined(const QuadMesh& mesh);

}  // namespace flowslide
