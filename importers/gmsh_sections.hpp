#pragma once
#include "core/check.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// What a .msh file says, whichever its format.
namespace flowslide {

struct GmshNode {
  std::int64_t tag;
  double x, y, z;
  std::int64_t line;
};

struct GmshElement {
  std::int64_t tag;
  int type;      ///< of gmsh: 1 line, 2 triangle, 3 quadrilateral, 15 point
  int physical;  ///< group, 0 for none
  std::vector<std::int64_t> nodes;
  std::int64_t line;
};

struct GmshFile {
  std::string name;  ///< without folder, for messages
  std::vector<GmshNode> nodes;
  std::vector<GmshElement> elements;
  std::map<std::pair<int, int>, std::string> physical_names;  ///< (dimension, tag)
  std::vector<std::string> notes;                             ///< what is odd, with file:line
};

/// Throws InputError with file:line, FileError.
GmshFile read_gmsh_file(const std::filesystem::path& path);

}  // namespace flowslide
