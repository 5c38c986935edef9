#pragma once
#include "section/section_config.hpp"

namespace flowslide {

/// The same section with every block of three corners divided into three blocks of four, "NAME (1)"
/// to "(3)", which meet at a point inside. Each of them has one corner of the triangle and reaches
/// along both sides there as far as the wanted numbers of elements make opposite sides equal:
/// with n_AB, n_BC, n_CA elements on the sides the first has (n_AB + n_CA - n_BC)/2 opposite to
/// those of its neighbours. Expects a checked config.
SectionConfig split_triangles(const SectionConfig& config);

/// Positions of the corners in the outline, from 0: those given, or all points.
std::vector<int> corners_of(const SectionBlock& block);

}  // namespace flowslide
