#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// What a file for ParaView holds, in the terms of VTK's XML formats, and its two writers. Both
/// give the whole file: appended raw data, compressed by zlib.
namespace flowslide {

struct VtkArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>> values;
};

struct VtkData {
  enum class Kind {
    vertices,
    quads
  };  ///< PolyData of vertices, UnstructuredGrid of quadrilaterals
  Kind kind = Kind::vertices;
  std::vector<double> points;       ///< three per point
  std::vector<std::int64_t> cells;  ///< one point per vertex, four per quadrilateral
  std::vector<VtkArray> at_points, at_cells;
  std::vector<std::pair<std::string, std::vector<std::string>>> texts;
};

/// ParaView names the components after these: "XX", "YY", "ZZ", "XY", "YZ", "ZX" for tensors of 4
/// or 6 components, nullptr for all else.
const char* vtk_component_name(int components, int component);

/// Needs zlib only.
std::string vtk_xml(const VtkData& data);

/// By VTK's own writers; built where VTK is found (FLOWSLIDE_VTK).
std::string vtk_xml_of_library(const VtkData& data);

}  // namespace flowslide
