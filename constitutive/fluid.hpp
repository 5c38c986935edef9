#pragma once
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
#include "constitutive/softening.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

/// What the viscous fluids share: an equation of state for the pressure, and a deviator that is
/// strained elastically and relaxes towards the flow curve tau(gamma'). docs/theory/fluids.md
namespace flowslide {

/// p = K/n (J^-n - 1) with J the volume ratio; n = 1 for most uses, 7 for water (Tait).
struct EquationOfState {
  double bulk;      ///< K [Pa]
  double exponent;  ///< n [-]
  /// Change of the mean stress (tension positive) from J to J_new [Pa].
  template <class T>
  [[nodiscard]] T mean_stress_change(T j, T j_new) const noexcept {
    return (bulk / exponent) * (power(1.0 / j) - power(1.0 / j_new));
  }

 private:
  template <class T>
  [[nodiscard]] T power(T x) const noexcept {
    if (exponent == 1.0) return x;
    if constexpr (std::is_same_v<T, Pack>) {
      T r;
      for (int i = 0; i < Pack::lanes; ++i) r.v[i] = pow(x.v[i], exponent);
      return r;
    } else {
      return pow(x, exponent);
    }
  }
};

/// State of every fluid.
template <class T>
struct FluidState {
  T plastic_strain = 0.0;  ///< accumulated eps_q of the flow [-]
  T gap = 0.0;             ///< opened volumetric strain [-]
  T volume_ratio = 1.0;    ///< J of the fluid without the gap [-]
};
inline constexpr std::array<std::string_view, 3> kFluidStates{"plastic_strain", "gap",
                                                              "volume_ratio"};

/// One step of a fluid. `relaxed(tau_trial)` is the shear stress sqrt(J2) after the step for that
/// of the elastic predictor; `tension` the largest mean tension [Pa].
template <int Dim, class T, class Relaxed>
[[nodiscard]] StressUpdate<FluidState<T>, Dim, T> update_fluid(
    const EquationOfState& eos, double shear, double tension, const FluidState<T>& old,
    const Stress<Dim, T>& sigma, const StrainIncrement<Dim, T>& de, Relaxed&& relaxed) noexcept {
  const T volumetric = de[0] + de[1] + de[2];
  const GapStep<T> step = close_gap_first(old.gap, volumetric);
  const T third = volumetric * (1.0 / 3.0), p_old = mean_stress(sigma);
  StressUpdate<FluidState<T>, Dim, T> r;
  std::array<T, kVoigt<Dim>> s{};
  T j2_trial = 0.0;
  for (int i = 0; i < 3; ++i) {
    s[i] = sigma[i] - p_old + 2.0 * shear * (de[i] - third);
    j2_trial += 0.5 * s[i] * s[i];
  }
  for (int i = 3; i < kVoigt<Dim>; ++i) {
    s[i] = sigma[i] + shear * de[i];
    j2_trial += s[i] * s[i];
  }
  const T tau_trial = sqrt(j2_trial), tau = min(tau_trial, relaxed(tau_trial));
  const T scale = select(tau < tau_trial, tau / max(tau_trial, T(1e-300)), T(1.0));

  // Tension beyond the cut-off opens a gap: the fluid keeps the volume at which it tore.
  const T j = old.volume_ratio * exp_of_small(step.volumetric);
  const T p_trial = p_old + eos.mean_stress_change(old.volume_ratio, j);
  const T excess = max(T(0.0), p_trial - tension);
  const T opened = excess * (1.0 / eos.bulk);
  const T p = p_trial - excess;
  r.state.plastic_strain =
      old.plastic_strain + (tau_trial - tau) * (1.0 / (std::sqrt(3.0) * shear));
  r.state.gap = step.gap + opened;
  r.state.volume_ratio = j * exp_of_small(-opened);
  for (int i = 0; i < 3; ++i) r.stress[i] = s[i] * scale + p;
  for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = s[i] * scale;
  return r;
}

/// A fluid carries any shear stress, at some rate, and mean tension up to `tension` [Pa].
inline AdmissibleStress admissible_fluid(double tension, const Stress<2>& total) {
  const double mean = mean_stress(total), excess = std::max(0.0, mean - tension);
  const double strength = std::max(tension, 1.0);
  AdmissibleStress r{total, (mean - tension) / strength, (mean - excess - tension) / strength};
  for (int i = 0; i < 3; ++i) r.stress[i] -= excess;
  return r;
}

/// Shear modulus as a share of the bulk modulus where the user gives none: high enough not to
/// matter (tau/G well below 1), low enough not to shorten the time step by much.
inline constexpr double kFluidShearRatio = 0.2;

}  // namespace flowslide
