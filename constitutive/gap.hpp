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

/// Soil that has opened by more is in pieces that do not touch, and free of stress until the gap
/// has closed to this again. It is twice the largest strain_limit that a run accepts: a step that
/// keeps its limit does not close it at once.
inline constexpr double kApart = 0.4;

/// The modulus of closed soil as the time step sees it, which multiplies it by the present volume.
/// Soil in pieces resists nothing; a trace keeps the step finite. A smaller gap closes before the
/// soil is compressed, and takes its part of the volume with it: exp(gap), from below.
template <class T>
[[nodiscard]] T modulus_with_gap(double modulus, T gap) noexcept {
  constexpr double kTrace = 1e-6;
  return select(gap > T(kApart), T(kTrace * modulus),
                modulus * reciprocal(1.0 + gap * (1.0 + 0.5 * gap)));
}

}  // namespace flowslide
