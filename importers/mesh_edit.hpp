#pragma once
#include "model/section_mesh.hpp"

/// What is done to an imported mesh before it is used.
namespace flowslide {

/// Leaves out the elements that do not lie between two values of x [m] with all their corners,
/// nodes and edges that only they have, and materials that nothing is left of; a note says how
/// many. Free-field columns of another program go that way. Throws InputError if nothing is left.
void keep_between(SectionMesh& section, double left, double right);

/// Leaves out nodes that no element has: nothing holds them, and the equations would have no
/// solution. Returns their tags, in order.
std::vector<std::int64_t> drop_loose_nodes(QuadMesh& mesh);

/// Divides each element in four through its centre and the middles of its edges. Nodes keep their
/// numbers and tags; the four of element i have the numbers 4 i to 4 i + 3, in the order of its
/// corners, and the tags after them. Throws InputError where more than two million would be made.
void divide_in_four(SectionMesh& section);

}  // namespace flowslide
