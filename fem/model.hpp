#pragma once
#include "constitutive/materials.hpp"
#include "model/mesh.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// A saturated section as the solver sees it: elements, materials, numbered unknowns, loads.
/// fem/build_model.hpp makes one from a section mesh and settings. docs/theory/fem.md
namespace flowslide::fem {

using Law = ShakingLaws::Variant<flowslide::Material>;

/// How the permeability of a soil grows with its excess pore pressure.
struct PermeabilityRise {
  double factor = 1.0;  ///< at r_u = 1, over that at rest; 1: it does not grow
  double exponent = 1.0;
};

struct Material {
  std::string name;
  Law law;
  double density = kUnset;                             ///< mixture of grains and water [kg/m3]
  double porosity = kUnset;                            ///< n [-]
  std::array<double, 2> permeability{kUnset, kUnset};  ///< horizontal, vertical [m/s]
  double gravity_poisson = kUnset;                     ///< K_0/(1 + K_0) [-]
  bool drained = false;                                ///< no excess pore pressure in this soil
  PermeabilityRise permeability_rise{};
};

struct Fluid {
  double bulk_modulus = 2.2e9;  ///< K_f [Pa]
  double density = 1000.0;      ///< [kg/m3]
};

struct Model {
  QuadMesh mesh;
  std::vector<Material> materials;
  std::vector<std::int32_t> material;  ///< of each element, index into materials
  std::vector<double> thickness;       ///< of each element [m]
  Fluid fluid;
  double gravity = kGravity;  ///< [m/s2], downwards

  /// Unknown of the motion of each node in x and y. Tied nodes share a number; fixed ones have
  /// num_dofs, a number past the last.
  std::vector<std::array<std::int32_t, 2>> dof;
  std::int32_t num_dofs = 0;
  std::vector<double> known_pressure;  ///< of each node [Pa]; NaN where it is unknown
  std::vector<double> load;            ///< constant force on each unknown [N]

  /// Unknowns at the base that move with the ground.
  std::vector<std::int32_t> base_dofs;
  /// Dashpot of each of them [N s/m]; empty: they follow the motion rigidly.
  std::vector<double> base_dashpots;
};

/// Sizes, ranges and indices; throws InputError naming material, element or node.
void check(const Model& model);

}  // namespace flowslide::fem
