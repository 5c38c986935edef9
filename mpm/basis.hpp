#pragma once
#include "core/pack.hpp"

/// One-dimensional shape functions on a grid of unit spacing; tensor products give 2D and 3D.
/// docs/theory/mpm.md
namespace flowslide::mpm {

/// Quadratic B-spline: continuous gradient, no cell-crossing noise, sum |grad w|^2/w <= 6/h^2.
struct QuadraticBSpline {
  static constexpr const char* name = "quadratic";
  static constexpr int nodes = 3;                ///< per direction
  static constexpr double affine_moment = 0.25;  ///< D / h^2 of APIC
  static constexpr double gradient_bound =
      6.0;  ///< largest sum |grad w|^2 / w per direction [1/h^2]
  /// The same with the affine field fed back, 2 S - 4 (docs/theory/time-step.md): what bounds the
  /// step.
  static constexpr double affine_bound = 8.0;
  /// Lowest node of the support of a point at `x` [cells].
  template <class T>
  static T base(T x) noexcept {
    return floor(x - 0.5);
  }
  /// Weights and gradients [1/cell] at distance `d` = x - base, in [0.5, 1.5).
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    w[0] = 0.5 * (1.5 - d) * (1.5 - d);
    w[1] = 0.75 - (d - 1.0) * (d - 1.0);
    w[2] = 0.5 * (d - 0.5) * (d - 0.5);
    g[0] = d - 1.5;
    g[1] = -2.0 * (d - 1.0);
    g[2] = d - 0.5;
  }
};

/// Linear hat functions: cheapest, but noisy when points cross cells and without a bound on the
/// stable step at sparse fronts.
struct Linear {
  static constexpr const char* name = "linear";
  static constexpr int nodes = 2;
  static constexpr double affine_moment = 0.25;  ///< not constant for linear functions; see g2p.hpp
  static constexpr double gradient_bound =
      16.0;  ///< at 1/16 of a cell from a node; unbounded nearer
  static constexpr double affine_bound =
      16.0;  ///< the affine field of hat functions is their gradient
  template <class T>
  static T base(T x) noexcept {
    return floor(x);
  }
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    w[0] = 1.0 - d;
    w[1] = d;
    g[0] = -1.0;
    g[1] = 1.0;
  }
};

}  // namespace flowslide::mpm
