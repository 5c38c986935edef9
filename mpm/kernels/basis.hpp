#pragma once
#include "core/bspline.hpp"
#include "core/pack.hpp"
#include "mpm/kernels/scheme.hpp"

#include <cmath>

/// One-dimensional shape functions on a grid of unit spacing; tensor products give 2D and 3D.
/// A point at x [cells] touches the nodes base, ..., base + nodes - 1 with base = floor(x - shift).
/// `evaluate` gives weights and gradients [1/cell] at the distance d = x - base.
/// Bounds of the step are per direction [1/cell^2]: `gradient_bound` is the largest
/// S = sum |grad w|^2 / w, `affine_bound` the largest 2 S - 1/D with D = sum w (x_i - x)^2, what an
/// affine field fed back makes of it (docs/theory/time-step.md). With `affine_gradient` the
/// velocity gradient is the affine field of apic.
namespace flowslide::mpm {

/// Hat functions: cheapest, but points that cross cells make the force jump, and a point close to a
/// node leaves the nodes behind with hardly any mass: S = 1 / (d (1 - d)) has no bound.
struct Linear {
  static constexpr BasisKind kind = BasisKind::linear;
  static constexpr const char* name = "linear";
  static constexpr int nodes = 2;
  static constexpr double shift = 0.0;
  static constexpr bool constant_moment = false;
  static constexpr double affine_moment = 0.0;
  static constexpr bool affine_gradient = false;
  /// At 1/16 of a cell from a node. Nearer, the step is not safe for a lone point.
  static constexpr double gradient_bound = 16.0 * 16.0 / 15.0;
  static constexpr double affine_bound = gradient_bound;  ///< the affine field is the gradient
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    w[0] = 1.0 - d;
    w[1] = d;
    g[0] = -1.0;
    g[1] = 1.0;
  }
};

/// Generalised interpolation (Bardenhagen & Kober 2004) in its uniform form: hat functions averaged
/// over a point of constant size, here half a cell (two points per direction).
struct Gimp {
  static constexpr BasisKind kind = BasisKind::gimp;
  static constexpr const char* name = "gimp";
  static constexpr int nodes = 3;
  static constexpr double shift = 0.5;
  static constexpr bool constant_moment = false;
  static constexpr double affine_moment = 0.0;
  static constexpr bool affine_gradient = false;
  static constexpr double half = 0.25;            ///< half the size of a point [cells]
  static constexpr double gradient_bound = 9.34;  ///< where an outer node loses its overlap
  static constexpr double affine_bound = 13.34;
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    const T t = d - 1.0;  // from the middle node
    const auto flat = t < T(half) && t > T(-half);
    const T distance = select(t < T(0.0), -t, t);
    const T right = t + half, left = half - t;
    // Next to a node both outer nodes overlap the point; elsewhere the hats are straight.
    w[0] = select(flat, left * left * (0.25 / half), max(T(0.0), -t));
    w[1] = select(flat, 1.0 - (t * t + half * half) * (0.5 / half), 1.0 - distance);
    w[2] = select(flat, right * right * (0.25 / half), max(T(0.0), t));
    const T sign = select(t < T(0.0), T(-1.0), T(1.0));
    g[0] = select(flat, left * (-0.5 / half), 0.5 * (sign - 1.0));
    g[1] = select(flat, t * (-1.0 / half), -sign);
    g[2] = select(flat, right * (0.5 / half), 0.5 * (sign + 1.0));
  }
};

/// Quadratic B-spline: continuous gradient, no cell-crossing noise.
struct QuadraticBSpline {
  static constexpr BasisKind kind = BasisKind::quadratic;
  static constexpr const char* name = "quadratic";
  static constexpr int nodes = 3;
  static constexpr double shift = 0.5;
  static constexpr bool constant_moment = true;
  static constexpr double affine_moment = 0.25;  ///< D, the same at every position
  static constexpr bool affine_gradient = false;
  static constexpr double gradient_bound = 6.0;
  static constexpr double affine_bound = 8.0;
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    quadratic_bspline(d, w, g);
  }
};

/// The weights of the quadratic B-spline with the gradient of the affine field, w (x_i - x) / D:
/// that of the linear field that fits the nodes best (moving least squares, Hu et al. 2018). S is
/// the same at every position, and what bounds the step is half that of the spline's slope.
struct MovingLeastSquares : QuadraticBSpline {
  static constexpr BasisKind kind = BasisKind::mls;
  static constexpr const char* name = "mls";
  static constexpr bool affine_gradient = true;
  static constexpr double gradient_bound = 4.0;
  static constexpr double affine_bound = 4.0;
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    quadratic_bspline(d, w, g);
    for (int i = 0; i < nodes; ++i) g[i] = w[i] * (double(i) - d) * (1.0 / affine_moment);
  }
};

/// Cubic B-spline: smoothest, the largest step, and the widest support.
struct CubicBSpline {
  static constexpr BasisKind kind = BasisKind::cubic;
  static constexpr const char* name = "cubic";
  static constexpr int nodes = 4;
  static constexpr double shift = 1.0;
  static constexpr bool constant_moment = true;
  static constexpr double affine_moment = 1.0 / 3.0;
  static constexpr bool affine_gradient = false;
  static constexpr double gradient_bound = 3.15;
  static constexpr double affine_bound = 3.29;
  template <class T>
  static void evaluate(T d, T* w, T* g) noexcept {
    const T t = d - 1.0, u = 1.0 - t;  // from the second node, in [0, 1)
    w[0] = u * u * u * (1.0 / 6.0);
    w[1] = 2.0 / 3.0 - t * t * (1.0 - 0.5 * t);
    w[2] = 2.0 / 3.0 - u * u * (1.0 - 0.5 * u);
    w[3] = t * t * t * (1.0 / 6.0);
    g[0] = -0.5 * u * u;
    g[1] = t * (1.5 * t - 2.0);
    g[2] = u * (2.0 - 1.5 * u);
    g[3] = 0.5 * t * t;
  }
};

/// Lowest node of the support of a point at `x` [cells].
template <class Basis, class T>
T base_node(T x) noexcept {
  return floor(x - Basis::shift);
}

/// D = sum w (x_i - x)^2 [cells^2] of a point whose weights were evaluated at d.
template <class Basis, class T>
T second_moment(T d, const T* w) noexcept {
  if constexpr (Basis::constant_moment) return Basis::affine_moment;
  T sum = 0.0;
  for (int i = 0; i < Basis::nodes; ++i) sum += w[i] * (double(i) - d) * (double(i) - d);
  return sum;
}

/// Calls f(basis) with the struct of `kind`: the choice is made once, outside the loops.
template <class F>
decltype(auto) visit_basis(BasisKind kind, F&& f) {
  switch (kind) {
    case BasisKind::linear:
      return f(Linear{});
    case BasisKind::gimp:
      return f(Gimp{});
    case BasisKind::quadratic:
      return f(QuadraticBSpline{});
    case BasisKind::mls:
      return f(MovingLeastSquares{});
    case BasisKind::cubic:
      break;
  }
  return f(CubicBSpline{});
}

/// What bounds (K + 2 G) / rho (dt / h)^2 / 4 from above, per direction (docs/theory/time-step.md).
template <class Basis>
double step_bound(const StepSettings& s) noexcept {
  switch (s.transfer) {
    case Transfer::apic:
    case Transfer::aflip:
      return Basis::affine_bound;
    case Transfer::tpic:
      return Basis::gradient_bound;
    case Transfer::flip:
    case Transfer::pic:
      return 2.0 * Basis::gradient_bound;
    case Transfer::fmpm:
      break;
  }
  return 2.0 * s.fmpm_order * Basis::gradient_bound;
}

/// Cells that a wave may cross in a stable step.
template <int Dim>
double stable_cells(const StepSettings& s) {
  return visit_basis(
      s.basis, [&]<class Basis>(Basis) { return 2.0 / std::sqrt(Dim * step_bound<Basis>(s)); });
}

}  // namespace flowslide::mpm
