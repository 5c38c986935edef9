#include "transfer/audit/out_of_balance.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flowslide {
namespace {

constexpr double full_cell =
    0.95;  ///< volume of a cell without a gap; merged slivers shift a little

/// Quadratic B-spline of three nodes along one axis; `first` is the lowest of them.
struct Spline {
  std::int64_t first;
  std::array<double, 3> value;
  std::array<double, 3> slope;  ///< per cell width
};

Spline quadratic_spline(double x) {
  const double nearest = std::floor(x + 0.5);
  const double d = x - nearest;
  return {static_cast<std::int64_t>(nearest) - 1,
          {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)},
          {d - 0.5, -2.0 * d, d + 0.5}};
}

struct Node {
  double mass = 0.0;
  double fx = 0.0, fy = 0.0;
};

}  // namespace

OutOfBalance out_of_balance(const ParticleSet& particles, double cell, Vec2 origin,
                            double full_cell) {
  OutOfBalance result;
  if (particles.size() == 0) return result;
  double low[2], high[2];
  for (int i = 0; i < 2; ++i) {
    low[i] = std::numeric_limits<double>::infinity();
    high[i] = -low[i];
    for (const auto& x : particles.position) {
      low[i] = std::min(low[i], (x[i] - origin[i]) / cell);
      high[i] = std::max(high[i], (x[i] - origin[i]) / cell);
    }
  }
  constexpr double kMostNodes = 2e8, kFarthest = 1e9;
  validate(low[0] > -kFarthest && low[1] > -kFarthest && high[0] < kFarthest &&
               high[1] < kFarthest && (high[0] - low[0] + 5) * (high[1] - low[1] + 5) < kMostNodes,
           "a grid of {:g} m cells from ({:g}, {:g}) under the points has {:.2g} nodes (at most "
           "{:g} are looked at) use a larger cell, or a grid_origin near the section",
           cell, origin[0], origin[1], (high[0] - low[0] + 5) * (high[1] - low[1] + 5), kMostNodes);
  // Two more nodes on each side hold every support.
  const auto i0 = static_cast<std::int64_t>(std::floor(low[0])) - 2;
  const auto j0 = static_cast<std::int64_t>(std::floor(low[1])) - 2;
  const auto nx = static_cast<std::int64_t>(std::floor(high[0])) + 3 - i0;
  const auto ny = static_cast<std::int64_t>(std::floor(high[1])) + 3 - j0;
  std::vector<Node> nodes(static_cast<std::size_t>(nx * ny));
  std::vector<double> volume(nodes.size(), 0.0);
  const auto at = [&](std::int64_t i, std::int64_t j) {
    return static_cast<std::size_t>((j - j0) * nx + (i - i0));
  };

  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double x = (particles.position[p][0] - origin[0]) / cell;
    const double y = (particles.position[p][1] - origin[1]) / cell;
    volume[at(static_cast<std::int64_t>(std::floor(x)),
              static_cast<std::int64_t>(std::floor(y)))] += particles.volume[p];
    const Spline sx = quadratic_spline(x), sy = quadratic_spline(y);
    const auto& s = particles.stress[p];
    const double v = particles.volume[p] / cell;
    for (int b = 0; b < 3; ++b) {
      for (int a = 0; a < 3; ++a) {
        Node& n = nodes[at(sx.first + a, sy.first + b)];
        const double gx = sx.slope[a] * sy.value[b], gy = sx.value[a] * sy.slope[b];
        const double m = particles.mass[p] * sx.value[a] * sy.value[b];
        n.mass += m;
        n.fx -= v * (s[0] * gx + s[3] * gy);
        n.fy -= v * (s[3] * gx + s[1] * gy) + m * kGravity;
      }
    }
  }

  double sum = 0.0;
  for (std::int64_t j = j0 + 2; j < j0 + ny - 1; ++j) {
    for (std::int64_t i = i0 + 2; i < i0 + nx - 1; ++i) {
      bool interior = true;
      for (std::int64_t b = j - 2; b < j + 2 && interior; ++b)
        for (std::int64_t a = i - 2; a < i + 2 && interior; ++a)
          interior = volume[at(a, b)] >= full_cell * cell * cell;
      if (!interior) continue;
      const Node& n = nodes[at(i, j)];
      const double acceleration = hypot(n.fx, n.fy) / (n.mass * kGravity);
      sum += acceleration * acceleration;
      ++result.nodes;
      if (!(acceleration <= result.max)) {
        result.max = acceleration;
        result.worst = {origin[0] + static_cast<double>(i) * cell,
                        origin[1] + static_cast<double>(j) * cell};
      }
    }
  }
  if (result.nodes > 0) result.rms = std::sqrt(sum / result.nodes);
  return result;
}

}  // namespace flowslide
