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

/// exp(x) to fourth order, for strains of a step; the library's does not run on eight lanes.
template <class T>
[[nodiscard]] T exp_of_small(T x) noexcept {
  return 1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0))));
}

}  // namespace flowslide
