#include "mpm/kernels/basis.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace flowslide::mpm;

TEMPLATE_TEST_CASE("Shape functions reproduce linear fields", "[mpm]", Linear, Gimp,
                   QuadraticBSpline, CubicBSpline, MovingLeastSquares) {
  using Basis = TestType;
  constexpr int N = Basis::nodes;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-50.0, 50.0);
  for (int i = 0; i < 5000; ++i) {
    double x = anywhere(random);
    if (i % 10 == 0) x = std::round(2.0 * x) / 2.0;  // nodes and mid-points, where pieces meet
    double w[N], g[N];
    const double base = base_node<Basis>(x);
    Basis::evaluate(x - base, w, g);
    double sum = 0, slope = 0, first = 0, first_slope = 0, second = 0;
    for (int k = 0; k < N; ++k) {
      const double node = base + k;
      CHECK(w[k] >= 0.0);
      sum += w[k];
      slope += g[k];
      first += w[k] * node;
      first_slope += g[k] * node;
      second += w[k] * (node - x) * (node - x);
    }
    CHECK(sum == Approx(1.0).epsilon(1e-14));
    CHECK(slope == Approx(0.0).margin(1e-14));
    CHECK(first == Approx(x).margin(1e-13));
    CHECK(first_slope == Approx(1.0).epsilon(1e-12));
    CHECK(second == Approx(second_moment<Basis>(x - base, w)).margin(1e-11));
    if constexpr (Basis::constant_moment)
      CHECK(second == Approx(Basis::affine_moment).epsilon(1e-11));
  }
}

TEMPLATE_TEST_CASE("Gradients are the slopes of the weights", "[mpm]", Linear, Gimp,
                   QuadraticBSpline, CubicBSpline) {
  using Basis = TestType;
  constexpr int N = Basis::nodes;
  const double step = 1e-6;
  for (double x = 0.03; x < 3.0; x += 0.07) {
    double w0[N], w1[N], g[N], unused[N];
    const double base = base_node<Basis>(x);
    Basis::evaluate(x - base - step, w0, unused);
    Basis::evaluate(x - base + step, w1, unused);
    Basis::evaluate(x - base, unused, g);
    for (int k = 0; k < N; ++k) CHECK((w1[k] - w0[k]) / (2.0 * step) == Approx(g[k]).margin(1e-8));
  }
}

TEMPLATE_TEST_CASE("Gradient and affine bound are the largest values", "[mpm]", Linear, Gimp,
                   QuadraticBSpline, CubicBSpline, MovingLeastSquares) {
  using Basis = TestType;
  constexpr int N = Basis::nodes;
  double largest = 0.0, affine = 0.0;
  for (int i = 1; i < 4000; ++i) {
    const double x = i / 4000.0;
    // Hat functions have no bound; theirs holds away from nodes.
    if (Basis::kind == BasisKind::linear && std::abs(x - 0.5) > 0.5 - 1.0 / 16.0) continue;
    double w[N], g[N], s = 0.0;
    const double d = x - base_node<Basis>(x);
    Basis::evaluate(d, w, g);
    for (int k = 0; k < N; ++k)
      if (w[k] > 0.0) s += g[k] * g[k] / w[k];
    largest = std::max(largest, s);
    affine = std::max(affine, 2.0 * s - 1.0 / second_moment<Basis>(d, w));
  }
  constexpr double rounding = 1.0 + 1e-12;
  CHECK(largest <= rounding * Basis::gradient_bound);
  CHECK(largest > 0.99 * Basis::gradient_bound);
  CHECK(affine <= rounding * Basis::affine_bound);
  CHECK(affine > 0.99 * Basis::affine_bound);
}

TEST_CASE("The gradient of mls is the affine field, close to the slope of the spline", "[mpm]") {
  for (double x = 0.003; x < 3.0; x += 0.007) {
    double w[3], g[3], slope[3];
    const double base = base_node<QuadraticBSpline>(x), t = x - base - 1.0;
    MovingLeastSquares::evaluate(x - base, w, g);
    QuadraticBSpline::evaluate(x - base, w, slope);
    // Both give 0 and 1 for constant and linear fields, so what differs is a second difference.
    const double differs = 2.0 * t * (0.25 - t * t);
    for (int k = 0; k < 3; ++k) {
      CHECK(g[k] == Approx(4.0 * w[k] * (base + k - x)).margin(1e-14));
      CHECK(g[k] - slope[k] == Approx(k == 1 ? -2.0 * differs : differs).margin(1e-13));
    }
  }
}
