#pragma once
#include "config/schema.hpp"
#include "model/mesh.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// A section as users write it: blocks with three or four corners, meshed with quadrilaterals.
namespace flowslide {

using PointRows = std::vector<std::vector<double>>;  ///< rows [x, y] [m]

struct SectionMaterial {
  int tag = 0;  ///< number of the material in the mesh
};

/// Outline counter-clockwise. Sides run from corner to corner, over the points between.
struct SectionBlock {
  PointRows outline;
  std::vector<int> corners;  ///< positions in the outline, from 1; empty: all its points
  std::string material;
  std::optional<double> size;  ///< [m]
  std::vector<int>
      divisions;  ///< elements along the first and the second side; 0 or empty: by size
};

/// Elements whose centre lies inside get this material, whatever block they are in.
struct SectionZone {
  PointRows outline;
  std::string material;
};

/// Element edges along a line, inside or on the boundary.
struct SectionSet {
  PointRows line;
};

struct SectionConfig {
  double size = kUnset;    ///< of elements [m]
  PointRows size_along_x;  ///< rows [x, size] [m], instead of `size` between its ends
  std::map<std::string, SectionMaterial> materials;
  std::map<std::string, SectionBlock> blocks;
  std::map<std::string, SectionZone> zones;
  std::map<std::string, SectionSet> sets;
};

/// Names, counts, orientation and shape of the outlines, one by one. Throws InputError.
void check(const SectionConfig& config);

/// Target size of elements at x, before the sizes of blocks [m].
double size_at(const SectionConfig& config, double x);

Vec2 to_point(const std::vector<double>& row);
std::vector<Vec2> to_points(const PointRows& rows);

template <>
struct Schema<SectionConfig> {
  static constexpr std::string_view doc =
      "A section of blocks, meshed with quadrilaterals whose edges match.";
  static void describe(FieldVisitor& v, SectionConfig& c);
};

}  // namespace flowslide
