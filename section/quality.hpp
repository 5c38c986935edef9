#pragma once
#include "model/section_mesh.hpp"

#include <string>

namespace flowslide {

/// Worst value of a measure and the element that has it.
struct WorstElement {
  double value = 0.0;
  std::size_t element = 0;
};

/// Measures of element shape; a rectangle has ratio 1 and angles of 90 degrees.
struct MeshQuality {
  WorstElement jacobian_ratio;  ///< smallest over largest Jacobian of the corners, smallest
  WorstElement aspect;          ///< ratio of the lengths of the two mid-lines, largest
  WorstElement angle;           ///< corner angle farthest from 90 degrees: the distance [deg]
  WorstElement shortest_edge;   ///< [m]
  /// Smallest area over longest edge, the distance a wave crosses in an explicit step [m].
  WorstElement thickness;
  double median_thickness = 0.0;  ///< [m]
};

MeshQuality measure_quality(const QuadMesh& mesh);

/// A line for each measure beyond 0.2 (Jacobian ratio), 10 (aspect), 75 degrees (angle) and a
/// quarter of the median (thickness), with element and place.
std::vector<std::string> quality_notes(const QuadMesh& mesh, const MeshQuality& quality);

}  // namespace flowslide
