#include "transfer/audit/out_of_balance.hpp"

#include "core/bspline.hpp"
#include "core/check.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flowslide {
namespace {

struct Node {
  double mass = 0.0;
  double fx = 0.0, fy = 0.0;
};

/// The grid under the points; two more nodes on each side than they span hold every support.
class Lattice {
 public:
  Lattice(const ParticleSet& particles, double cell, Vec2 origin) : cell_(cell), origin_(origin) {
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
    const double count = (high[0] - low[0] + 5) * (high[1] - low[1] + 5);
    validate(low[0] > -kFarthest && low[1] > -kFarthest && high[0] < kFarthest &&
                 high[1] < kFarthest && count < kMostNodes,
             "a grid of {:g} m cells from ({:g}, {:g}) under the points has {:.2g} nodes (at most "
             "{:g} are looked at) use a larger cell, or a grid_origin near the section",
             cell, origin[0], origin[1], count, kMostNodes);
    for (int i = 0; i < 2; ++i) {
      first_[i] = static_cast<std::int64_t>(std::floor(low[i])) - 2;
      count_[i] = static_cast<std::int64_t>(std::floor(high[i])) + 3 - first_[i];
    }
    nodes_.resize(static_cast<std::size_t>(count_[0] * count_[1]));
    volume_.assign(nodes_.size(), 0.0);
  }

  /// Mass and force of a point on its nodes, and its volume in its cell.
  void add(const ParticleSet& particles, std::size_t p) {
    const double x = (particles.position[p][0] - origin_[0]) / cell_;
    const double y = (particles.position[p][1] - origin_[1]) / cell_;
    volume_[at(static_cast<std::int64_t>(std::floor(x)),
               static_cast<std::int64_t>(std::floor(y)))] += particles.volume[p];
    const Spline sx = spline(x), sy = spline(y);
    const auto& s = particles.stress[p];
    const double v = particles.volume[p] / cell_;
    for (int b = 0; b < 3; ++b) {
      for (int a = 0; a < 3; ++a) {
        Node& n = nodes_[at(sx.first + a, sy.first + b)];
        const double gx = sx.slope[a] * sy.value[b], gy = sx.value[a] * sy.slope[b];
        const double m = particles.mass[p] * sx.value[a] * sy.value[b];
        n.mass += m;
        n.fx -= v * (s[0] * gx + s[3] * gy);
        n.fy -= v * (s[3] * gx + s[1] * gy) + m * kGravity;
      }
    }
  }

  /// Calls f(node, position) for every node amid cells whose points fill at least this share.
  template <class F>
  void for_each_interior(double full_cell, F&& f) const {
    for (std::int64_t j = first_[1] + 2; j < first_[1] + count_[1] - 1; ++j)
      for (std::int64_t i = first_[0] + 2; i < first_[0] + count_[0] - 1; ++i)
        if (is_interior(i, j, full_cell * cell_ * cell_))
          f(nodes_[at(i, j)], Vec2{origin_[0] + static_cast<double>(i) * cell_,
                                   origin_[1] + static_cast<double>(j) * cell_});
  }

 private:
  /// Of the three nodes along one axis whose splines reach a point; `first` is the lowest.
  struct Spline {
    std::int64_t first;
    std::array<double, 3> value, slope;  ///< slope per cell width
  };
  static Spline spline(double x) {
    const double lowest = std::floor(x + 0.5) - 1.0;
    Spline s{static_cast<std::int64_t>(lowest), {}, {}};
    quadratic_bspline(x - lowest, s.value.data(), s.slope.data());
    return s;
  }
  [[nodiscard]] std::size_t at(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j - first_[1]) * count_[0] + (i - first_[0]));
  }
  [[nodiscard]] bool is_interior(std::int64_t i, std::int64_t j, double full_volume) const {
    for (std::int64_t b = j - 2; b < j + 2; ++b)
      for (std::int64_t a = i - 2; a < i + 2; ++a)
        if (!(volume_[at(a, b)] >= full_volume)) return false;
    return true;
  }

  double cell_;
  Vec2 origin_;
  std::array<std::int64_t, 2> first_{}, count_{};
  std::vector<Node> nodes_;
  std::vector<double> volume_;  ///< per cell, at its lowest node [m3/m]
};

}  // namespace

OutOfBalance out_of_balance(const ParticleSet& particles, double cell, Vec2 origin,
                            double full_cell) {
  OutOfBalance result;
  if (particles.size() == 0) return result;
  Lattice lattice(particles, cell, origin);
  for (std::size_t p = 0; p < particles.size(); ++p) lattice.add(particles, p);
  double sum = 0.0;
  lattice.for_each_interior(full_cell, [&](const Node& n, Vec2 position) {
    const double acceleration = hypot(n.fx, n.fy) / (n.mass * kGravity);
    sum += acceleration * acceleration;
    ++result.nodes;
    if (!(acceleration <= result.max)) {
      result.max = acceleration;
      result.worst = position;
    }
  });
  if (result.nodes > 0) result.rms = std::sqrt(sum / result.nodes);
  return result;
}

}  // namespace flowslide
