#pragma once
#include "constitutive/concept.hpp"
#include "model/particle_set.hpp"
#include "mpm/run/flow_config.hpp"

#include <string>
#include <vector>

/// `stiffness: automatic`: elastic constants as soft as the flow allows. docs/theory/stiffness.md
namespace flowslide {

/// Speed of a free fall through a height [m/s].
double fall_speed(double gravity, double height);

/// Bulk modulus [Pa] that keeps the bounds for soil of a density [kg/m3], the largest mean stress
/// [Pa] and speed [m/s] in it.
double needed_bulk(const StiffnessBounds& bounds, double density, double pressure, double speed);

/// As given, or with that bulk modulus where it is less; the shear modulus follows where Poisson's
/// ratio would fall below 0.45, or below the given one if that is less, but not below `shear`.
Elasticity no_stiffer(const Elasticity& given, double bulk, double shear);

/// Steepest fall of the shear strength over deviatoric plastic strain [Pa] of each material under a
/// mean pressure [Pa], with the strains of this cell; 0 without softening.
std::vector<double> softening_slopes(const ParticleSet& particles, const FlowConfig& config,
                                     const std::vector<double>& pressure);

/// Throws InputError where soil softens and nothing tells for which cells its strains hold.
void expect_reference_length(const ParticleSet& particles, const FlowConfig& config);

/// A sentence for each material whose softening runs on without deformation.
std::vector<std::string> snapping_soils(const ParticleSet& particles, const FlowConfig& config);

struct StiffnessOfMaterial {
  std::string material;
  Elasticity given{}, used{};  ///< [Pa]
  double needed = 0.0;         ///< bulk modulus [Pa]
  double volume_change = 0.0;  ///< expected at most with `used` [-]
  double mach_number = 0.0;    ///< likewise
  double brittleness = 0.0;    ///< likewise; 0 without softening
};

struct StiffnessChoice {
  double fall = 0.0;   ///< from the highest point to the lowest ground [m]
  double speed = 0.0;  ///< [m/s]
  std::vector<StiffnessOfMaterial> materials;
  /// Materials whose law takes its stiffness from the stress; they stay as they are.
  std::vector<std::string> left;
};

/// Changes the elastic constants of the materials; stresses stay. Throws what reading a terrain
/// throws.
StiffnessChoice soften(ParticleSet& particles, const FlowConfig& config);

/// What was chosen, a sentence for each material.
std::vector<std::string> told(const StiffnessChoice& choice);

}  // namespace flowslide
