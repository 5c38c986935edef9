#pragma once
#include "core/pack.hpp"

namespace flowslide {

/// Volume that opens when tension exceeds the cut-off is kept as a gap, a volumetric strain >= 0.
/// It must close again before the soil carries compression; without it each cycle of separation
/// and contact leaves the soil bulked.
template <class T>
struct GapStep {
  T volumetric;  ///< part of the volumetric strain increment that strains the soil
  T gap;         ///< gap after the increment
};
template <class T>
[[nodiscard]] GapStep<T> close_gap_first(T gap, T volumetric) noexcept {
  const T left = gap + volumetric;
  const auto open = gap > T(0.0);
  return {select(open, min(left, T(0.0)), volumetric), select(open, max(left, T(0.0)), T(0.0))};
}

/// Water does not push soil apart for ever: where a gap opens, u falls with the opened volume and
/// returns when the gap closes. With u held, soil at the apex is a gas of constant pressure.
template <class T>
[[nodiscard]] T present_pore_pressure(double bulk, T pore_pressure, T gap) noexcept {
  const T left = max(T(0.0), pore_pressure - bulk * gap);
  return select(gap > T(0.0), min(pore_pressure, left), pore_pressure);
}

/// `modulus`, which contains K, as the time step sees it. While more is open than one step can
/// close, changes of volume move the gap and nothing else, so K is out of play: debris that has
/// opened to several times its volume would otherwise set a step for a stiffness it does not have.
template <class T>
[[nodiscard]] T modulus_with_gap(double modulus, double bulk, T gap) noexcept {
  constexpr double kBeyondOneStep = 0.4;  // twice the largest strain_limit that a run accepts
  return select(gap > T(kBeyondOneStep), T(modulus - bulk), T(modulus));
}

}  // namespace flowslide
