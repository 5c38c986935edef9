#pragma once
#include "model/mesh.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// Columns of the liquefiable soil, and how deep they have liquefied
/// (docs/theory/liquefaction-zone.md, section 2).
namespace flowslide {

/// Nodes of the listed elements, ascending.
std::vector<std::int32_t> nodes_of(const QuadMesh& mesh, std::span<const std::int32_t> elements);

/// Per node the nodes that share one of the listed elements with it, ascending.
using NodeNeighbours = std::vector<std::vector<std::int32_t>>;
NodeNeighbours soil_neighbours(const QuadMesh& mesh, std::span<const std::int32_t> elements);

/// Flags the nodes above the threshold of which at least `neighbours` others are above it too.
std::vector<std::uint8_t> confirmed_nodes(const NodeNeighbours& adjacent,
                                          std::span<const double> r_u, double threshold,
                                          int neighbours);

/// Nodes whose x lies in one strip.
struct SoilColumn {
  double x = 0.0;                   ///< middle of the strip [m]
  std::vector<std::int32_t> nodes;  ///< from the bottom to the top
};

/// Strips of `width`, the median width of the elements if unset, the first one centred on the
/// leftmost node; strips without nodes are left out. Throws InputError for a width that cuts the
/// soil into more than 1e6 columns.
std::vector<SoilColumn> soil_columns(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                     std::optional<double> width);

/// Where r_u falls through the threshold below the lowest of the `counted` nodes: y on the straight
/// line to the next node below, that of the node itself where nothing lies below or the node below
/// has no r_u or more than the threshold. Nothing without a counted node.
std::optional<double> liquefied_bottom(const SoilColumn& column, std::span<const Vec2> positions,
                                       std::span<const double> r_u,
                                       std::span<const std::uint8_t> counted, double threshold);

}  // namespace flowslide
