#pragma once
#include "constitutive/materials.hpp"
#include "mpm/kernels/g2p.hpp"
#include "mpm/kernels/scheme.hpp"

#include <algorithm>
#include <span>
#include <variant>

/// Stress update of the points from their velocity gradients: corotational, with the volumetric
/// rate averaged over knot spans where a material is nearly incompressible (F-bar on rates).
namespace flowslide::mpm {

/// A law with its constants, as the step loop sees it.
template <class M>
struct Typed {
  typename M::Constants constants;
};
using TypedMaterial = FlowLaws::Variant<Typed>;

struct SolverMaterial {
  TypedMaterial law;
  Elasticity elastic;   ///< for the stable step and the recoverable energy
  bool average_volume;  ///< F-bar: bulk modulus well above shear modulus
  double wave_modulus;  ///< below
};

/// Stiffness that bounds the time step [Pa]: that of compression without strain to the sides, K +
/// 4/3 G; with mls, whose gradient is one field, that of the worst such field by its number of
/// components, equal stretches unless Poisson's ratio is negative. Where F-bar gives changes of
/// volume another rate than shear, both count in full. docs/theory/time-step.md, section 1
template <int Dim>
double wave_modulus(const Elasticity& e, bool averages, BasisKind basis) noexcept {
  if (basis != BasisKind::mls) return e.bulk + (averages ? 2.0 : 4.0 / 3.0) * e.shear;
  const double of_stretch = averages ? 2.0 : 2.0 - 2.0 * Dim / 3.0;
  return std::max(e.bulk + of_stretch / Dim * e.shear, 2.0 / Dim * e.shear);
}

struct StressWork {
  double power_start = 0.0;  ///< dt sum V sigma : D with V and sigma before the step [J]
  double power_end = 0.0;    ///< the same with V and sigma after it [J]
  double max_wave2 = 0.0;    ///< largest wave modulus / rho [m2/s2]
  double max_speed2 = 0.0;   ///< largest |v|^2 [m2/s2]
  double max_strain = 0.0;   ///< largest |L| dt of the step [-]
  void add(const StressWork& o) {
    power_start += o.power_start;
    power_end += o.power_end;
    max_wave2 = std::max(max_wave2, o.max_wave2);
    max_speed2 = std::max(max_speed2, o.max_speed2);
    max_strain = std::max(max_strain, o.max_strain);
  }
};

/// Updates stress, state and volume of a tile's points from s.gradient; s.average.span must be
/// theirs. `average` switches F-bar. Instantiated in stress_2d.cpp and stress_3d.cpp.
template <int Dim>
StressWork update_stress(Points<Dim>& p, const Tile<Dim>& tile, std::span<const MaterialRun> runs,
                         std::span<const SolverMaterial> materials, double dt, TileScratch<Dim>& s,
                         bool average) noexcept;

}  // namespace flowslide::mpm
