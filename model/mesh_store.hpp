#pragma once
#include "model/field_store.hpp"
#include "model/mesh.hpp"

/// The group `mesh` that every file with a mesh has.
namespace flowslide {

void write_mesh(FieldWriter& out, const QuadMesh& mesh);

/// Checked as by check(const QuadMesh&). Throws InputError, FileError.
QuadMesh read_mesh(const FieldReader& in);

}  // namespace flowslide
