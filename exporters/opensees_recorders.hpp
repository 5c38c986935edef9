#pragma once
#include "model/history.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// A history as the text files that scripts around OpenSees write and read.
namespace flowslide {

/// nodeinfo.dat (tag, x, y) and elementinfo.dat (tag, four nodes, material) in `folder`, which is
/// made if it is not there. Metres. Throws FileError.
void write_mesh_tables(const std::filesystem::path& folder, const QuadMesh& mesh);

/// The mesh tables, Gstress.out, Gstrain.out and GporePressure.out with the state at rest, and, if
/// the history has frames, displacement.out, velocity.out, porePressure.out, stress.out and
/// strain.out. First column time; then x y of each node, p of each node, xx yy xy of each element.
/// Units m, s, kPa; stress effective, tension positive; pore pressure compression positive.
/// Numbers have the shortest text that reads back to the same double. One frame is in memory at a
/// time. Returns what the format cannot carry, one line each. Throws FileError, and InputError for
/// NaN, which readers of the format do not expect.
std::vector<std::string> write_opensees_recorders(const std::filesystem::path& folder,
                                                  const FemHistory& history);

}  // namespace flowslide
