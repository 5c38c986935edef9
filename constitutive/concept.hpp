#pragma once
#include "constitutive/gap.hpp"
#include "core/voigt.hpp"

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

/// What a constitutive law must be: named parameters, a small state and a pure function.
namespace flowslide {

/// `T` is double, or Pack where the law treats eight points at once.
template <class State, int Dim, class T = double>
struct StressUpdate {
  Stress<Dim, T> stress;
  State state;
};

/// Isotropic elasticity as every law here uses it.
struct Elasticity {
  double bulk;   ///< K [Pa]
  double shear;  ///< G [Pa]
  /// From Young's modulus [Pa] and Poisson's ratio [-].
  static constexpr Elasticity from_young(double youngs_modulus, double poisson_ratio) {
    return {youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)),
            youngs_modulus / (2.0 * (1.0 + poisson_ratio))};
  }
};

/// Hooke's law on increments.
template <int Dim, class T>
constexpr Stress<Dim, T> hooke(const Elasticity& e, const Stress<Dim, T>& s,
                               const StrainIncrement<Dim, T>& de) {
  const double lambda = e.bulk - 2.0 / 3.0 * e.shear;
  const T volumetric = lambda * (de[0] + de[1] + de[2]);
  Stress<Dim, T> r = s;
  for (int i = 0; i < 3; ++i) r[i] += volumetric + (2.0 * e.shear) * de[i];
  for (int i = 3; i < kVoigt<Dim>; ++i) r[i] += e.shear * de[i];
  return r;
}

/// The update of law M. Laws whose stress depends on the rate of strain say so with
/// `rate_dependent` and take the time step [s] as well. Soil that has come apart has no stress, but
/// for laws that need some pressure to work with and say so with `keeps_pressure`.
template <class M, int Dim, class T>
[[nodiscard]] StressUpdate<typename M::template StateOf<T>, Dim, T> update_law(
    const typename M::Constants& c, const typename M::template StateOf<T>& state,
    const Stress<Dim, T>& sigma, const StrainIncrement<Dim, T>& de, double dt) noexcept {
  auto result = [&] {
    if constexpr (requires { M::rate_dependent; })
      return M::template update<Dim>(c, state, sigma, de, dt);
    else
      return M::template update<Dim>(c, state, sigma, de);
  }();
  if constexpr (
      requires { result.state.gap; } && !requires { M::keeps_pressure; }) {
    const auto apart = result.state.gap > T(kApart);
    for (int i = 0; i < kVoigt<Dim>; ++i)
      result.stress[i] = select(apart, T(0.0), result.stress[i]);
  }
  return result;
}

/// A law M. `StateOf<T>` is an aggregate of numbers T in the order of `state_names`, so that
/// solvers can keep it as plain arrays; State is StateOf<double>. `Constants` are numbers derived
/// once from the parameters: what the update needs, without a transcendental function per point.
/// `softening_scale` is cell size over reference length (docs/theory/softening.md).
template <class M, int Dim>
concept ConstitutiveModel = std::is_aggregate_v<typename M::Params> &&
                                std::is_trivially_copyable_v<typename M::State> &&
                                sizeof(typename M::State) ==
                                sizeof(double) * M::state_names.size() +
                                    (M::state_names.empty() ? 1 : 0) &&
                            requires(const typename M::Params& p, const typename M::Constants& c,
                                     const typename M::State& s, const Stress<Dim>& sigma,
                                     const StrainIncrement<Dim>& de, double softening_scale,
                                     double dt) {
  { M::name } -> std::convertible_to<std::string_view>;
  { M::constants(p, softening_scale) } -> std::same_as<typename M::Constants>;
  { M::initial_state(p) } -> std::same_as<typename M::State>;
  { update_law<M, Dim, double>(c, s, sigma, de, dt) }
  noexcept->std::same_as<StressUpdate<typename M::State, Dim>>;
  { M::elasticity(p) } -> std::same_as<Elasticity>;
  { M::present_strength(c, s) }
  noexcept->std::same_as<double>;
};

}  // namespace flowslide
