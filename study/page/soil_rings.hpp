#pragma once
#include "report/page_read.hpp"

#include <array>
#include <string>
#include <vector>

namespace flowslide::study {

using Ring = std::vector<std::array<double, 2>>;  ///< closed; the last point is not the first [m]

/// Where a soil lies: all rings together, even and odd, so that one inside another is a hole.
struct SoilArea {
  std::string name;
  std::vector<Ring> rings;
};

/// Outlines of the soils of a section, from the elements of its mesh, in the order of their tags.
/// Empty where the page has no mesh. Throws InputError for elements whose nodes are not there.
std::vector<SoilArea> soil_areas(const PageRun& run);

/// Without the points that lie on the line between their neighbours, to a centimetre.
Ring without_straight(const Ring& ring);

}  // namespace flowslide::study
