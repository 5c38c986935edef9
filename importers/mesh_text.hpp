#pragma once
#include "config/schema.hpp"
#include "model/mesh.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// Order of the columns of node recorders and element recorders.
enum class RecorderOrder {
  file,  ///< the order of the rows in the mesh files
  tag,   ///< ascending tags, what `-nodeRange`, `-eleRange` and recorders without a list write
};
inline constexpr std::array<std::string_view, 2> kRecorderOrders = {"file", "tag"};

/// Mesh as two text tables, as written by the scripts around OpenSees (nodeinfo, elementinfo).
struct MeshTextConfig {
  InputFile nodes;
  InputFile elements;
  std::vector<std::string> node_columns = {"tag", "x", "y"};
  std::vector<std::string> element_columns = {"tag", "n1", "n2", "n3", "n4", "material"};
  RecorderOrder recorder_order = RecorderOrder::file;
  bool reverse_clockwise = false;
};

template <>
struct Schema<MeshTextConfig> {
  static constexpr std::string_view doc = "Nodes and elements as text tables.";
  static void describe(FieldVisitor& v, MeshTextConfig& c);
};

struct MeshText {
  QuadMesh mesh;  ///< in recorder order, coordinates in SI
  std::vector<std::string> notes;
};

/// Reads both tables, blanks or commas between the columns, plain or gzip. Coordinates are
/// multiplied by `length` (file unit to metres). Numbers of nodes and elements may be written as
/// `12`, `12.0` or `1.2e1`; fractions are refused. Throws InputError with file:line for rows, and
/// with the list of tags for duplicates, missing nodes, degenerate, clockwise and non-convex
/// elements; FileError.
MeshText read_mesh_text(const MeshTextConfig& config, double length);

}  // namespace flowslide
