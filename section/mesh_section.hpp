#pragma once
#include "model/section_mesh.hpp"
#include "section/section_config.hpp"

namespace flowslide {

/// Meshes a section. Nodes and elements are numbered from 1 in order of x, then y. Throws
/// InputError that says which block, side or point is at fault, and what to do.
SectionMesh mesh_section(const SectionConfig& config);

}  // namespace flowslide
