#pragma once
#include "mpm/grid/local_grid.hpp"
#include "mpm/kernels/stencil.hpp"

/// Particle to grid: mass, momentum (with the affine field) and internal force in one sweep.
/// m_i = sum w m;  (mv)_i = sum w m (v + C (x_i - x_p));  f_i = -sum V sigma grad w, which with the
/// gradient of the affine field, w (x_i - x_p) / (D h^2), has the form of the momentum.
namespace flowslide::mpm {

/// What goes to the grid beside mass: the points' momentum and force, their momentum alone, or that
/// of a given velocity without an affine field.
enum class Scatter { force, momentum, velocity };
template <int Dim>
using TileVelocity = std::array<std::vector<double>, Dim>;  ///< per point of the tile [m/s]

/// What points give to their nodes, one record of node sums per point: node (i, j) receives
/// w_i w_j (a + i b_0 + j b_1) + g_i w_j f_0 + w_i g_j f_1. The first direction is kept as a (with
/// f_0 in the lanes of the force) and b_0, the others as b and f in one record. With the gradient
/// of the affine field there is no f, and the lanes of the force are like those of the momentum.
template <int Dim>
struct Contributions {
  struct Part {
    NodePart a[Pack::lanes], b[Pack::lanes], other[Dim - 1][Pack::lanes];
  };
  /// Parts that hold mass, momentum and force.
  static constexpr int parts = (NodeLayout<Dim>::force + Dim + Pack::lanes - 1) / Pack::lanes;
  Part part[parts];
};

template <int Dim, class Basis, Scatter kScatter>
[[gnu::always_inline]] inline void contributions(const Points<Dim>& p, std::int32_t q, int count,
                                                 const double* mean_change,
                                                 const double* const* velocity,
                                                 const Stencil<Dim, Basis>& s, double h,
                                                 Contributions<Dim>& out) noexcept {
  using L = NodeLayout<Dim>;
  const Pack m = load_pack(p.mass.data() + q, count);
  Pack a[kNodeLanes], b[Dim][kNodeLanes];
  for (Pack& x : a) x = 0.0;
  for (auto& direction : b)
    for (Pack& x : direction) x = 0.0;
  a[L::mass] = m;
  unroll<Dim>([&](auto d) {
    if constexpr (kScatter == Scatter::velocity) {
      a[L::momentum + d] = m * load_pack(velocity[d], count);
    } else {
      Pack u = load_pack(p.v[d].data() + q, count);
      unroll<Dim>([&](auto e) {
        const Pack c = load_pack(p.c[Dim * d + e].data() + q, count);
        u += c * (s.r[e] * h);
        b[e][L::momentum + d] = m * c * h;
      });
      a[L::momentum + d] = m * u;
    }
  });
  if constexpr (kScatter == Scatter::force) {
    // Gradients of the stencil are per cell.
    Pack minus_v = load_pack(p.volume.data() + q, count) * (-1.0 / h);
    if constexpr (Basis::affine_gradient) minus_v *= 1.0 / Basis::affine_moment;
    const Pack mean = load_pack(mean_change, count);
    unroll<Dim>([&](auto d) {
      unroll<Dim>([&](auto e) {
        constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        Pack sigma = load_pack(p.sigma[voigt[d][e]].data() + q, count);
        if constexpr (d == e) sigma += mean;
        const Pack pull = minus_v * sigma;
        if constexpr (Basis::affine_gradient) {
          a[L::force + d] += pull * s.r[e];
          b[e][L::force + d] = pull;
        } else {
          (e == 0 ? a : b[e])[L::force + d] = pull;
        }
      });
    });
  }
  for (int part = 0; part < Contributions<Dim>::parts; ++part) {
    const int first = part * Pack::lanes;
    transpose(a + first, out.part[part].a);
    transpose(b[0] + first, out.part[part].b);
    for (int e = 1; e < Dim; ++e) transpose(b[e] + first, out.part[part].other[e - 1]);
  }
}

/// Weights and gradients of the points of a pack, lane by lane.
template <int Dim, class Basis>
struct LaneStencil {
  alignas(64) double w[Dim][Basis::nodes][Pack::lanes];
  alignas(64) double g[Dim][Basis::nodes][Pack::lanes];
  explicit LaneStencil(const Stencil<Dim, Basis>& s) noexcept {
    unroll<Dim>([&](auto d) {
      unroll<Basis::nodes>([&](auto i) {
        store_pack(w[d][i], s.w[d][i], Pack::lanes);
        store_pack(g[d][i], s.g[d][i], Pack::lanes);
      });
    });
  }
};

/// What point `k` of a pack gives to a part of the nodes of its stencil; `target(n, l)` is node n
/// of layer l.
template <int kPart, int Dim, class Basis, class Target>
[[gnu::always_inline]] inline void give_to_nodes(const LaneStencil<Dim, Basis>& s,
                                                 const typename Contributions<Dim>::Part& give,
                                                 int k, Target&& target) noexcept {
  constexpr int N = Basis::nodes;
  const auto& w = s.w;
  const auto& g = s.g;
  NodePart row[N], column[N];
  unroll<N>([&](auto i) __attribute__((always_inline)) {
    row[i] = weight_and_gradient<Dim, kPart>(w[0][i][k], g[0][i][k]) * give.a[k];
    if constexpr (i > 0) row[i] += (double(i) * w[0][i][k]) * give.b[k];
  });
  unroll<N>([&](auto j) __attribute__((always_inline)) {
    column[j] =
        weight_and_gradient<Dim, kPart>(double(j) * w[1][j][k], g[1][j][k]) * give.other[0][k];
  });
  if constexpr (Dim == 2) {
    unroll<N>([&](auto j) __attribute__((always_inline)) {
      unroll<N>([&](auto i) __attribute__((always_inline)) {
        target(std::integral_constant<int, i + N * j>{}, 0) +=
            w[1][j][k] * row[i] + w[0][i][k] * column[j];
      });
    });
  } else {
    each_layer<Dim, N>([&](auto l) __attribute__((always_inline)) {
      const double wz = w[Dim - 1][l][k];
      const NodePart layer = weight_and_gradient<Dim, kPart>(double(l) * wz, g[Dim - 1][l][k]) *
                             give.other[Dim - 2][k];
      unroll<N>([&](auto j) __attribute__((always_inline)) {
        const double wy = w[1][j][k], wyz = wy * wz;
        const NodePart rest = wz * column[j] + wy * layer;
        unroll<N>([&](auto i) __attribute__((always_inline)) {
          target(std::integral_constant<int, i + N * j>{}, l) += wyz * row[i] + w[0][i][k] * rest;
        });
      });
    });
  }
}

/// Products of the weights of the points of a pack, node by node and lane by lane.
template <int Dim, class Basis>
struct LaneWeights {
  static constexpr int N = Basis::nodes;
  alignas(64) double w[power<Dim>(N)][Pack::lanes];
  explicit LaneWeights(const Stencil<Dim, Basis>& s) noexcept {
    unroll<power<Dim>(N)>([&](auto n) __attribute__((always_inline)) {
      constexpr int i = n % N, j = n / N % N, l = n / (N * N);
      Pack weight = s.w[0][i] * s.w[1][j];
      if constexpr (Dim == 3) weight *= s.w[Dim - 1][l];
      store_pack(w[n], weight, Pack::lanes);
    });
  }
};

/// The same where weights are all that is needed.
template <int kPart, int Dim, class Basis, class Target>
[[gnu::always_inline]] inline void give_to_nodes(const LaneWeights<Dim, Basis>& s,
                                                 const typename Contributions<Dim>::Part& give,
                                                 int k, Target&& target) noexcept {
  constexpr int N = Basis::nodes;
  NodePart row[N];
  unroll<N>([&](auto i) __attribute__((always_inline)) {
    row[i] = give.a[k];
    if constexpr (i > 0) row[i] += double(i) * give.b[k];
  });
  each_layer<Dim, N>([&](auto l) __attribute__((always_inline)) {
    unroll<N * N>([&](auto n) __attribute__((always_inline)) {
      constexpr int i = n % N, j = n / N;
      NodePart value = row[i];
      if constexpr (j > 0) value += double(j) * give.other[0][k];
      if (l > 0) value += double(l) * give.other[Dim - 2][k];
      target(n, l) += s.w[n + N * N * l][k] * value;
    });
  });
}

/// Place of node n of a stencil in a window of parts.
template <int Dim, class Basis>
constexpr int window_offset(int n) {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>;
  return kNodeParts * (n % N + W * (n / N % N) + W * W * (n / (N * N)));
}

/// Sums of the nodes of one point, which stay in registers while points of the same cell follow;
/// of stencils that registers have no room for, nothing.
template <int Dim, class Basis>
struct HeldSums {
  static constexpr int nodes = power<Dim>(Basis::nodes);
  static constexpr bool on = nodes <= 16;
  NodePart sum[Contributions<Dim>::parts][on ? nodes : 1]{};
  std::int32_t cell = -1;  ///< Stencil::at of the point; -1: none yet
};

/// A part of what the points of a pack give to their nodes, into `sums` and `held`.
template <int kPart, int Dim, class Basis, class Lanes>
[[gnu::always_inline]] inline void give_part(const Stencil<Dim, Basis>& s, int count,
                                             const Lanes& lanes, const Contributions<Dim>& give,
                                             HeldSums<Dim, Basis>& held, NodePart* sums) noexcept {
  constexpr int T = HeldSums<Dim, Basis>::nodes;
  constexpr bool kHold = HeldSums<Dim, Basis>::on;
  constexpr auto offset = window_offset<Dim, Basis>;
  std::int32_t cell = held.cell;
  NodePart mine[kHold ? T : 1];  // a part of its own, so that it may stay in registers
  if constexpr (kHold) unroll<T>([&](auto n) { mine[n] = held.sum[kPart][n]; });
  for (int k = 0; k < count; ++k) {
    NodePart* at = sums + kNodeParts * s.at[k] + kPart;
    if constexpr (kHold) {
      if (s.at[k] != cell) {
        NodePart* before = sums + kNodeParts * cell + kPart;
        if (cell >= 0) unroll<T>([&](auto n) { before[offset(n)] = mine[n]; });
        unroll<T>([&](auto n) { mine[n] = at[offset(n)]; });
        cell = s.at[k];
      }
    }
    const auto target = [&](auto n, auto layer) __attribute__((always_inline))->NodePart& {
      constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>;
      if constexpr (kHold)
        return mine[n + N * N * layer];
      else
        return at[offset(n) + kNodeParts * W * W * layer];
    };
    give_to_nodes<kPart, Dim, Basis>(lanes, give.part[kPart], k, target);
  }
  if constexpr (kHold) unroll<T>([&](auto n) { held.sum[kPart][n] = mine[n]; });
}

/// The points of a tile into its `window` (kWindowNodes). With Scatter::force `mean_change` is
/// added to the normal stresses of each point of the tile: what F-bar does to the force. With
/// Scatter::velocity `velocity` is what the points have.
template <int Dim, class Basis, Scatter kScatter>
[[gnu::flatten]] void scatter_tile(const Points<Dim>& p, const Tile<Dim>& tile,
                                   const double* mean_change, const TileVelocity<Dim>* velocity,
                                   const Grid<Dim>& grid, NodeVector* window) noexcept {
  constexpr int kParts = Contributions<Dim>::parts;
  std::memset(static_cast<void*>(window), 0, sizeof(NodeVector) * kWindowNodes<Dim, Basis>);
  auto* sums = reinterpret_cast<NodePart*>(window);
  const double h = grid.h, inverse = 1.0 / h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  HeldSums<Dim, Basis> held;
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<std::int32_t>(Pack::lanes, tile.last - q);
    Stencil<Dim, Basis> s;
    evaluate_stencil<Dim, Basis>(p, q, count, grid, inverse, corner, s);
    Contributions<Dim> give;
    const std::int32_t in_tile = q - tile.first;
    const double* from[Dim] = {};
    if constexpr (kScatter == Scatter::velocity)
      for (int d = 0; d < Dim; ++d) from[d] = (*velocity)[d].data() + in_tile;
    contributions<Dim, Basis, kScatter>(
        p, q, count, kScatter == Scatter::force ? mean_change + in_tile : nullptr, from, s, h,
        give);
    using Lanes = std::conditional_t<Basis::affine_gradient, LaneWeights<Dim, Basis>,
                                     LaneStencil<Dim, Basis>>;
    const Lanes lanes(s);
    unroll<kParts>([&](auto part) __attribute__((always_inline)) {
      give_part<part, Dim, Basis>(s, count, lanes, give, held, sums);
    });
    held.cell = s.at[count - 1];
  }
  if constexpr (held.on)
    if (held.cell >= 0)
      unroll<kParts>([&](auto part) {
        NodePart* at = sums + kNodeParts * held.cell + part;
        unroll<held.nodes>([&](auto n) { at[window_offset<Dim, Basis>(n)] = held.sum[part][n]; });
      });
}

}  // namespace flowslide::mpm
