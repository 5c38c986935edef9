#pragma once
#include "section/section_config.hpp"

#include <array>
#include <string>
#include <vector>

/// How the blocks of a section touch: points, and the segments between them that blocks share.
namespace flowslide {

/// Straight, from point a to point b; no point of any block or set lies between.
struct Segment {
  int a = 0, b = 0;
  int left = -1;          ///< block that has it on its outline in the direction a to b
  int right = -1;         ///< block that has it in the opposite direction, -1 on the boundary
  double length = 0.0;    ///< [m]
  double elements = 0.0;  ///< wanted: its length in target sizes, not rounded
};

struct DirectedSegment {
  int segment = 0;
  bool forward = true;  ///< walked from a to b
};

struct LayoutBlock {
  std::string name;
  std::vector<Vec2> outline;
  std::array<std::vector<DirectedSegment>, 4> sides;  ///< counter-clockwise from the first corner
  std::array<int, 4> corner{};                        ///< points
};

struct Layout {
  std::vector<Vec2> points;
  std::vector<Segment> segments;
  std::vector<LayoutBlock> blocks;  ///< in order of names
  double tolerance = 0.0;           ///< points nearer than this are one [m]
  std::vector<std::string> notes;   ///< what is odd about the boundary
};

/// Finds what blocks share; a point of one block on the side of another divides that side. Throws
/// InputError, with names and coordinates, for points or sides that nearly touch (gaps, slivers),
/// overlapping blocks, holes, and blocks that do not hang together. Expects a checked config whose
/// blocks have four corners.
Layout lay_out(const SectionConfig& config);

/// Target size of elements of a block at x [m].
double size_in(const SectionConfig& config, const SectionBlock& block, double x);

}  // namespace flowslide
