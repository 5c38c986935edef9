#pragma once
#include "section/section_config.hpp"

namespace flowslide {

/// The same section with every block of three corners divided into three blocks of four, "NAME (1)"
/// to "(3)", which meet at a point inside; each has one corner of the triangle. With n_AB, n_BC,
/// n_CA elements wanted on the sides, (n_AB + n_BC - n_CA)/2 of side AB go to the block at A, and
/// so on around: then opposite sides are equal. Expects a checked config.
SectionConfig split_triangles(const SectionConfig& config);

/// Positions of the corners in the outline, from 0: those given, or all points.
std::vector<int> corners_of(const SectionBlock& block);

}  // namespace flowslide
