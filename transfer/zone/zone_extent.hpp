#pragma once
#include "model/mesh.hpp"
#include "transfer/zone/zone_config.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Geometry of the liquefied zone in reference coordinates
/// (docs/theory/liquefaction-zone.md, section 2).
namespace flowslide {

/// A zone: the liquefiable soil above a line, or inside a polygon if there is one.
struct ZoneShape {
  std::vector<Vec2> lower_boundary;  ///< x rising [m]
  std::vector<Vec2> polygon;         ///< [m], may be empty
};

/// True above the lower boundary, or inside the polygon. Points on the boundary count as inside.
bool contains(const ZoneShape& shape, Vec2 point);

/// y of a polyline with rising x: level to the left of it, its last segment prolonged to the right.
double height_on(std::span<const Vec2> line, double x);

/// Bottom of the liquefied soil per column of the listed elements, as a polyline through the
/// columns; at the top of the soil in a column where nothing has liquefied. `r_u` per node, NaN
/// where undefined.
std::vector<Vec2> column_boundary(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                  std::span<const double> r_u, double threshold,
                                  const ColumnConfig& config);

/// The shape asked for; `r_u` is used by zone: automatic and liquefied only.
ZoneShape zone_shape(const ZoneConfig& config, const QuadMesh& mesh,
                     std::span<const std::int32_t> elements, std::span<const double> r_u);

}  // namespace flowslide
