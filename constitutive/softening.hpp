#pragma once
#include <algorithm>

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
  [[nodiscard]] double degree(double plastic_strain) const noexcept {
    return std::min(1.0, std::max(0.0, (plastic_strain - strain_peak) * inverse_width));
  }
};

/// Volume that opens when tension exceeds the cut-off is kept as a gap, a volumetric strain >= 0.
/// It must close again before the soil carries compression; without it each cycle of separation
/// and contact leaves the soil bulked.
struct GapStep {
  double volumetric;  ///< part of the volumetric strain increment that strains the soil
  double gap;         ///< gap after the increment
};
[[nodiscard]] inline GapStep close_gap_first(double gap, double volumetric) noexcept {
  const double left = gap + volumetric;
  const bool open = gap > 0.0;
  return {open ? std::min(left, 0.0) : volumetric, open ? std::max(left, 0.0) : 0.0};
}

}  // namespace flowslide
