#pragma once
#include "model/section_mesh.hpp"

#include <span>
#include <string>

namespace flowslide {

/// Element edges with an element on one side only, in walking order, counter-clockwise around the
/// mesh. Throws InputError for a mesh with holes or in several parts.
std::vector<std::array<std::int32_t, 2>> outer_edges(const QuadMesh& mesh);

/// Adds the sets base, right, surface and left: the ends are the outer edges at the smallest and
/// the largest x; base and surface are what lies below and above between them. A set of one of
/// these names that the section has already is kept, soil on the left. A section without vertical
/// ends gets none of them, and a note. Throws InputError for one with inner edges or with no edge
/// of the side that is found; one that is only partly that side gets a note.
void add_outer_sets(SectionMesh& section);

/// Edges along a line of straight legs, in its direction. Throws InputError where the legs do not
/// follow edges; `name` is for the message.
EdgeSet edges_along(const QuadMesh& mesh, const std::string& name, std::span<const Vec2> line,
                    double tolerance);

}  // namespace flowslide
