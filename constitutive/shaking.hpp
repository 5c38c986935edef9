#pragma once
#include "constitutive/concept.hpp"

#include <limits>

/// What the finite elements ask of a law besides its update. A law of the runout becomes one of the
/// shaking with a function shear_strength; the rest has an answer for every law, which a law may
/// replace by its own.
namespace flowslide {

/// Shear stress in the plane that soil can carry: cohesion + friction p [Pa], [-].
struct ShearStrength {
  double cohesion = std::numeric_limits<double>::infinity(), friction = 0.0;
};

template <class M>
concept ShakingModel = requires(const typename M::Params& p, const typename M::Constants& c,
                                const typename M::State& s, const Stress<2>& sigma,
                                const StrainIncrement<2>& de) {
  { M::shear_strength(p) } -> std::same_as<ShearStrength>;
  { M::update(c, s, sigma, de).stress } -> std::convertible_to<Stress<2>>;
  { M::update(c, s, sigma, de).state } -> std::convertible_to<typename M::State>;
};

/// Constants of a law whose softening needs no length.
template <class M>
typename M::Constants shaking_constants(const typename M::Params& p) {
  if constexpr (requires { M::constants(p); })
    return M::constants(p);
  else
    return M::constants(p, 1.0);
}

/// The same for explicit steps of a mesh.
template <class M>
typename M::Constants mesh_constants(const typename M::Params& p) {
  if constexpr (requires { M::mesh_constants(p); })
    return M::mesh_constants(p);
  else
    return shaking_constants<M>(p);
}

/// Elastic constants of the stage of gravity, whose Poisson's ratio sets K_0 = nu/(1 - nu) and need
/// not be the law's own.
template <class M>
Elasticity rest_elasticity(const typename M::Params& p, double poisson_ratio) {
  if constexpr (requires { M::gravity_elasticity(p, poisson_ratio); })
    return M::gravity_elasticity(p, poisson_ratio);
  else
    return Elasticity::from_young(p.youngs_modulus, poisson_ratio);
}

/// State of a point that was consolidated to `sigma` by the volumetric strain of the stage of
/// gravity (compression positive) and has no history of shearing.
template <class M>
typename M::State rest_state(const typename M::Params& p, const typename M::Constants& c,
                             const Stress<2>& sigma, double volumetric_strain) {
  if constexpr (requires { M::initial_state(c, sigma, volumetric_strain); })
    return M::initial_state(c, sigma, volumetric_strain);
  else
    return M::initial_state(p);
}

/// Tells a law that softens what share of an element its bands take: the length of softening over
/// the size of the element. docs/theory/pm4sand.md, "A length for softening"
template <class M>
void set_band(typename M::State& state, double share) {
  if constexpr (requires { state.band; }) state.band = share;
}

/// Out-of-plane stress at rest: that of elastic plane strain, or the mean of the plane where the
/// law knows no other.
template <class M>
double rest_out_of_plane(double poisson_ratio, double sxx, double syy) {
  if constexpr (requires { M::plane_mean_stress; })
    return 0.5 * (sxx + syy);
  else
    return poisson_ratio * (sxx + syy);
}

/// Present elastic constants [Pa].
template <class M>
Elasticity present_elasticity(const typename M::Constants& c, const typename M::State& s,
                              const Stress<2>& sigma) {
  if constexpr (requires { M::elasticity(c, s, sigma); })
    return M::elasticity(c, s, sigma);
  else
    return c.elastic;
}

}  // namespace flowslide
