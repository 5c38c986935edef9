#pragma once
#include "model/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Kinetic energy of a section per metre of width (docs/theory/liquefaction-zone.md, section 3).
namespace flowslide {

/// Mass of each listed element [kg/m]: its density times its initial area. `density` of all
/// elements [kg/m3].
std::vector<double> element_masses(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                   std::span<const double> density);

/// Nodes of the listed elements that lie at their lowest y.
std::vector<std::int32_t> lowest_nodes(const QuadMesh& mesh,
                                       std::span<const std::int32_t> elements);

struct KineticEnergy {
  double absolute = 0.0;  ///< sum of 0.5 m_e |vbar_e|^2 [J/m]
  double relative = 0.0;  ///< the same with vbar_e - v_base [J/m]
  double base = 0.0;      ///< 0.5 (sum of m_e) |v_base|^2 [J/m]: the section riding on its base
};

/// `mass` as long as `elements`; vbar_e is the mean of the four nodal velocities, v_base the mean
/// over base_nodes, which must not be empty.
KineticEnergy kinetic_energy(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                             std::span<const double> mass, std::span<const Vec2> velocity,
                             std::span<const std::int32_t> base_nodes);

}  // namespace flowslide
