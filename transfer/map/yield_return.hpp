#pragma once
#include "constitutive/mohr_coulomb.hpp"
#include "core/voigt.hpp"
#include "transfer/map/map_config.hpp"

/// Interpolated stress brought back to what the laws of the runout can carry.
/// Theory: docs/theory/transfer.md, "Return to the yield surface".
namespace flowslide {

/// f / strength of the shear part or of the tension limit, whichever is larger; positive: outside.
/// The strength is that at the present confinement, at least that without confinement and 1 Pa.
/// `stress` is the one friction acts on.
double relative_violation(const MohrCoulombSurface<double>& surface, const Stress<2>& stress);
/// (sqrt(J2) - s) / s or (p - tension_cutoff) / s, whichever is larger; s = `strength` [Pa].
double relative_violation(double strength, double tension_cutoff, const Stress<2>& stress);

/// The law's own return at zero strain increment. Total stress in and out; friction acts on
/// total + state.pore_pressure. Plastic strain does not grow: the difference stems from
/// interpolation and from the change of law, not from straining.
Stress<2> return_mohr_coulomb(const MohrCoulomb::Constants& constants,
                              const MohrCoulomb::State& state, const Stress<2>& total);

/// Liquefied soil: the deviator s is scaled by a <= 1 until sqrt(J2) <= strength, and the mean
/// stress p follows. `vertical_stress` keeps the total sigma_yy, which carries the overburden
/// (p = sigma_yy - a s_yy); `mean_stress` keeps p. Neither leaves p above the tension cut-off.
Stress<2> return_liquefied(LiquefiedReturn method, double strength, double tension_cutoff,
                           const Stress<2>& total);

}  // namespace flowslide
