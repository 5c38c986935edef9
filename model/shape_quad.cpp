#include "model/shape_quad.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr std::array<double, 4> kXi{-1.0, 1.0, 1.0, -1.0};
constexpr std::array<double, 4> kEta{-1.0, -1.0, 1.0, 1.0};

/// d(x,y)/d(xi,eta), row-major.
struct Gradient {
  double x_xi = 0.0, x_eta = 0.0, y_xi = 0.0, y_eta = 0.0;
  [[nodiscard]] double determinant() const { return x_xi * y_eta - x_eta * y_xi; }
};

Gradient gradient(const std::array<Vec2, 4>& quad, double xi, double eta) {
  Gradient g;
  for (std::size_t k = 0; k < 4; ++k) {
    const double d_xi = 0.25 * kXi[k] * (1.0 + kEta[k] * eta);
    const double d_eta = 0.25 * kEta[k] * (1.0 + kXi[k] * xi);
    g.x_xi += d_xi * quad[k][0];
    g.x_eta += d_eta * quad[k][0];
    g.y_xi += d_xi * quad[k][1];
    g.y_eta += d_eta * quad[k][1];
  }
  return g;
}

}  // namespace

std::array<double, 4> shape(double xi, double eta) {
  std::array<double, 4> n{};
  for (std::size_t k = 0; k < 4; ++k) n[k] = 0.25 * (1.0 + kXi[k] * xi) * (1.0 + kEta[k] * eta);
  return n;
}

Vec2 interpolate(const std::array<Vec2, 4>& nodal, double xi, double eta) {
  const std::array<double, 4> n = shape(xi, eta);
  return {n[0] * nodal[0][0] + n[1] * nodal[1][0] + n[2] * nodal[2][0] + n[3] * nodal[3][0],
          n[0] * nodal[0][1] + n[1] * nodal[1][1] + n[2] * nodal[2][1] + n[3] * nodal[3][1]};
}

double interpolate(const std::array<double, 4>& nodal, double xi, double eta) {
  const std::array<double, 4> n = shape(xi, eta);
  return n[0] * nodal[0] + n[1] * nodal[1] + n[2] * nodal[2] + n[3] * nodal[3];
}

double jacobian(const std::array<Vec2, 4>& quad, double xi, double eta) {
  return gradient(quad, xi, eta).determinant();
}

std::optional<Vec2> natural_coordinates(const std::array<Vec2, 4>& quad, Vec2 point,
                                        double tolerance) {
  // Relative to the point, so that map coordinates of 1e5 m do not cost digits.
  std::array<Vec2, 4> local = quad;
  double size = 0.0;
  for (Vec2& c : local) {
    c = {c[0] - point[0], c[1] - point[1]};
    size = std::max({size, std::abs(c[0]), std::abs(c[1])});
  }
  if (!(size < 1e300)) return std::nullopt;

  constexpr int kMaxIterations = 60;
  constexpr double kRoundOff = 4e-16;
  // The Jacobian is positive inside a convex element but may vanish outside; iterates are kept
  // where a solution is acceptable, plus room for the path to it.
  const double limit = 1.0 + std::max(0.25, tolerance);
  Vec2 x{0.0, 0.0};
  for (int i = 0; i < kMaxIterations; ++i) {
    const Vec2 r = interpolate(local, x[0], x[1]);
    const Gradient g = gradient(local, x[0], x[1]);
    const double det = g.determinant();
    if (!(std::abs(det) > 0.0)) return std::nullopt;
    const Vec2 next{std::clamp(x[0] - (g.y_eta * r[0] - g.x_eta * r[1]) / det, -limit, limit),
                    std::clamp(x[1] - (g.x_xi * r[1] - g.y_xi * r[0]) / det, -limit, limit)};
    const double step = std::max(std::abs(next[0] - x[0]), std::abs(next[1] - x[1]));
    x = next;
    if (step <= kRoundOff) break;
  }
  const Vec2 r = interpolate(local, x[0], x[1]);
  const bool solved = std::max(std::abs(r[0]), std::abs(r[1])) <= 1e-13 * size;
  const bool inside = std::max(std::abs(x[0]), std::abs(x[1])) <= 1.0 + tolerance;
  return solved && inside ? std::optional<Vec2>(x) : std::nullopt;
}

}  // namespace flowslide
