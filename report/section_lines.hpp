#pragma once
#include "model/history.hpp"
#include "report/npy.hpp"

/// Lines of the undeformed section for the figures, as segments x1 y1 x2 y2 [m].
namespace flowslide {

/// Edges on the boundary of the mesh and between elements of different material; a fifth column is
/// 1 on the boundary and 0 inside.
Table outline_segments(const QuadMesh& mesh);

/// Surface of water at rest as rows x, y, level of the ground [m], from left to right: where a
/// column of still water above the highest wet point of a vertical line ends, which is above the
/// ground where there is a pond. Pore pressures below 1 kPa count as dry. Rows are as dense as the
/// elements; where nothing is wet, y is unset.
Table water_surface(const QuadMesh& mesh, const std::vector<double>& pore_pressure);

}  // namespace flowslide
