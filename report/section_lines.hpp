#pragma once
#include "model/history.hpp"
#include "report/npy.hpp"

/// Lines of the undeformed section for the figures, as segments x1 y1 x2 y2 [m].
namespace flowslide {

/// Edges on the boundary of the mesh and between elements of different material; a fifth column is
/// 1 on the boundary and 0 inside.
Table outline_segments(const QuadMesh& mesh);

/// Where the pore pressure equals `level` [Pa], by linear interpolation along element edges.
Table pressure_contour(const QuadMesh& mesh, const std::vector<double>& pore_pressure,
                       double level);

}  // namespace flowslide
