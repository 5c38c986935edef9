#pragma once
#include "model/history.hpp"
#include "transfer/zone/zone_config.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Excess pore-pressure ratio r_u = (u - u_0) / sigma'_v0 at the nodes of the liquefiable soil
/// (docs/theory/liquefaction-zone.md, section 1).
namespace flowslide {

/// What the gravity state contributes to r_u.
struct RuReference {
  std::vector<double> sigma_v0;    ///< elements, compression positive [Pa]
  std::vector<double> per_stress;  ///< nodes, 1/sigma'_v0 [1/Pa]; NaN where r_u is not defined
  std::vector<double> u_0;         ///< nodes [Pa]
  std::vector<std::string> notes;  ///< how many nodes lie below the floor
};

/// `liquefiable` flags elements. Nodes that touch no such element, or whose sigma'_v0 is below the
/// floor, have no r_u. Throws InputError for a gravity state with unset numbers there.
RuReference r_u_reference(const QuadMesh& mesh, const FemFrame& gravity,
                          std::span<const std::uint8_t> liquefiable, const RuConfig& config);

/// r_u of all nodes, NaN where it is not defined. Throws InputError for a pore pressure that is not
/// finite at a node where it is, naming the node and `time`.
std::vector<double> r_u_at_nodes(const QuadMesh& mesh, const RuReference& reference,
                                 std::span<const double> pore_pressure, double time);

/// Mean of those nodal values of each element that are set; NaN if none is.
std::vector<double> element_means(const QuadMesh& mesh, std::span<const double> nodal);

}  // namespace flowslide
