#pragma once

namespace flowslide {

/// Quadratic B-spline of the three nodes around a point: weights and slopes [1/cell], from the
/// point's distance `d` to the lowest of them, within [0.5, 1.5) [cells].
template <class T>
void quadratic_bspline(T d, T* weight, T* slope) noexcept {
  weight[0] = 0.5 * (1.5 - d) * (1.5 - d);
  weight[1] = 0.75 - (d - 1.0) * (d - 1.0);
  weight[2] = 0.5 * (d - 0.5) * (d - 0.5);
  slope[0] = d - 1.5;
  slope[1] = -2.0 * (d - 1.0);
  slope[2] = d - 0.5;
}

}  // namespace flowslide
