#pragma once
#include "model/section_mesh.hpp"

#include <string>

namespace flowslide {

/// What the stages that make a mesh report: counts and quality, as a JSON object.
std::string mesh_facts(const SectionMesh& section);

}  // namespace flowslide
