#pragma once
#include "model/section_mesh.hpp"

#include <filesystem>

namespace flowslide {

/// Reads a mesh of gmsh, formats 2.2 and 4.1, text, plain or gzip. Four-node quadrilaterals become
/// elements: their physical surface is the material, with its number as tag and its name, or
/// "surface N". Physical curves become edge sets. Other nodes, points and lines are left out.
/// Coordinates are multiplied by `length` (file unit to metres); z must be the same everywhere.
/// Clockwise elements are reversed, with a note. Throws InputError with file:line for what is
/// binary, malformed, triangular, of second order or without physical surface, for elements that
/// are there twice and for soil that is not joined; FileError.
SectionMesh read_gmsh(const std::filesystem::path& path, double length);

}  // namespace flowslide
