#pragma once
#include "core/pack.hpp"

namespace flowslide {

/// Linear change of a strength from `peak` to `residual` while the accumulated deviatoric plastic
/// strain eps_q^p goes from strain_peak to strain_residual (docs/theory/softening.md).
struct LinearSoftening {
  double strain_peak;
  double inverse_width;  ///< 1 / (strain_residual - strain_peak); 0 switches softening off

  /// `softening_scale` = cell size / reference length: plastic strain in a band of fixed number of
  /// cells grows like 1/cell size, so both strains are divided by it (crack-band scaling).
  static LinearSoftening scaled(double strain_peak, double strain_residual,
                                double softening_scale) {
    const double width = strain_residual - strain_peak;
    return {strain_peak / softening_scale, width > 0.0 ? softening_scale / width : 0.0};
  }
  /// 0 at peak, 1 at residual.
  template <class T>
  [[nodiscard]] T degree(T plastic_strain) const noexcept {
    return min(T(1.0), max(T(0.0), (plastic_strain - strain_peak) * inverse_width));
  }
};

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

/// exp(x) to fourth order, for strains of a step; the library's does not run on eight lanes.
template <class T>
[[nodiscard]] T exp_of_small(T x) noexcept {
  return 1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0))));
}

}  // namespace flowslide
