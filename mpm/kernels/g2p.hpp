#pragma once
#include "mpm/grid/local_grid.hpp"
#include "mpm/kernels/stencil.hpp"
#include "mpm/kernels/volume_average.hpp"

/// Grid to particle: velocity, affine field, velocity gradient and new position.
/// v = sum w v_i;  C = D^-1 sum w v_i (x_i - x_p)^T;  L = sum v_i grad w;  x += dt sum w v_i.
namespace flowslide::mpm {

/// Velocity gradients of a tile's points and the buffers of its averages; one per thread.
template <int Dim>
struct TileScratch {
  std::array<std::vector<double>, Dim * Dim> gradient;  ///< row-major L [1/s]
  std::array<std::vector<double>, Dim> velocity;        ///< of fmpm's series [m/s]
  SpanScratch average;
  double gain2 = 0.0;    ///< of update_momentum [m2/s2]
  bool outside = false;  ///< a tile has points outside its window
};

/// Components [first, first + Dim) of the nodes around a tile, one array per component.
template <int Dim, int Width>
struct Window {
  double v[Dim][power<Dim>(Width)];
  void read(const Tile<Dim>& tile, const Node* nodes, int first) noexcept {
    for_each_row<Dim, Width>(tile, [&](int to, std::int32_t block, int from, int count) {
      const Node* source = nodes + std::size_t(block) * kBlockNodes<Dim> + from;
      for (int i = 0; i < count; ++i)
        for (int d = 0; d < Dim; ++d) v[d][to + i] = source[i].q[first + d];
    });
  }
};

/// Sums over the nodes of a stencil: u = sum w v, moment[e] = sum w v i_e (i_e counted from the
/// lowest node), gradient[e] = sum v dw/dx_e per cell.
template <int Dim>
struct NodeSums {
  Pack u, moment[Dim], gradient[Dim];
};

// Lambdas say that they are to be inlined: `flatten` stops at some of them when a function has
// grown, and their captures then go through memory.

template <int Dim, class Basis, class Fetch>
[[gnu::always_inline]] inline NodeSums<Dim> sum_nodes(const Stencil<Dim, Basis>& s,
                                                      const Fetch& fetch,
                                                      const double* v) noexcept {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>;
  NodeSums<Dim> r;
  Pack s_u = 0, s_x = 0, s_y = 0, s_z = 0, g_x = 0, g_y = 0, g_z = 0;
  each_layer<Dim, N>([&](auto l) __attribute__((always_inline)) {
    Pack t_u = 0, t_x = 0, t_y = 0, t_gx = 0, t_gy = 0;
    unroll<N>([&](auto j) __attribute__((always_inline)) {
      Pack a = 0, ax = 0, ag = 0;
      unroll<N>([&](auto i) __attribute__((always_inline)) {
        const Pack vi = fetch(v + (i + W * j + (Dim == 3 ? W * W * l : 0)));
        const Pack weighted = s.w[0][i] * vi;
        a += weighted;
        if constexpr (i > 0) ax += double(i) * weighted;
        ag += s.g[0][i] * vi;
      });
      t_u += s.w[1][j] * a;
      t_x += s.w[1][j] * ax;
      t_gx += s.w[1][j] * ag;
      if constexpr (j > 0) t_y += double(j) * (s.w[1][j] * a);
      t_gy += s.g[1][j] * a;
    });
    if constexpr (Dim == 3) {
      s_u += s.w[2][l] * t_u;
      s_x += s.w[2][l] * t_x;
      s_y += s.w[2][l] * t_y;
      g_x += s.w[2][l] * t_gx;
      g_y += s.w[2][l] * t_gy;
      if (l > 0) s_z += double(l) * (s.w[2][l] * t_u);
      g_z += s.g[2][l] * t_u;
    } else {
      s_u = t_u, s_x = t_x, s_y = t_y, g_x = t_gx, g_y = t_gy;
    }
  });
  r.u = s_u;
  r.moment[0] = s_x, r.moment[1] = s_y;
  r.gradient[0] = g_x, r.gradient[1] = g_y;
  if constexpr (Dim == 3) r.moment[2] = s_z, r.gradient[2] = g_z;
  return r;
}

/// sum w v over the nodes of a stencil.
template <int Dim, class Basis, class Fetch>
[[gnu::always_inline]] inline Pack interpolate(const Stencil<Dim, Basis>& s, const Fetch& fetch,
                                               const double* v) noexcept {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>;
  Pack sum = 0.0;
  each_layer<Dim, N>([&](auto l) __attribute__((always_inline)) {
    unroll<N * N>([&](auto n) __attribute__((always_inline)) {
      constexpr int i = n % N, j = n / N;
      Pack weight = s.w[0][i] * s.w[1][j];
      if constexpr (Dim == 3) weight *= s.w[Dim - 1][l];
      sum += weight * fetch(v + (i + W * j + W * W * l));
    });
  });
  return sum;
}

/// `keep` is the share of its own velocity a point keeps in the step with aflip and flip. New
/// positions go to `moved`, which may be p.x.
template <int Dim, class Basis, Transfer kTransfer>
[[gnu::flatten]] void gather_tile(Points<Dim>& p, const Tile<Dim>& tile, const Grid<Dim>& grid,
                                  double dt, double keep,
                                  std::array<StaggeredArray<double>, Dim>& moved,
                                  TileScratch<Dim>& scratch) {
  constexpr int W = kLocalWidth<Dim, Basis>;
  using L = NodeLayout<Dim>;
  constexpr bool kKeep = kTransfer == Transfer::aflip || kTransfer == Transfer::flip;
  // Hat functions have their gradient as affine field.
  constexpr bool kGradient = kTransfer == Transfer::tpic ||
                             (Basis::kind == BasisKind::linear &&
                              (kTransfer == Transfer::apic || kTransfer == Transfer::aflip));
  constexpr bool kMoment =
      !kGradient && (kTransfer == Transfer::apic || kTransfer == Transfer::aflip);
  constexpr bool kAffine = Basis::affine_gradient;  // one sum for both
  Window<Dim, W> velocity;
  velocity.read(tile, grid.nodes.data(), L::momentum);
  [[maybe_unused]] std::conditional_t<kKeep, Window<Dim, W>, int> change;
  if constexpr (kKeep) change.read(tile, grid.nodes.data(), L::force);

  const double h = grid.h, inverse = 1.0 / h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Stencil<Dim, Basis> s;
    evaluate_stencil<Dim, Basis>(p, q, count, grid, inverse, corner, s);
    Pack factor[Dim];  // h / (D h^2)
    if constexpr (kMoment || kAffine) {
      unroll<Dim>([&](auto e) {
        if constexpr (Basis::constant_moment)
          factor[e] = 1.0 / (Basis::affine_moment * h * h) * h;
        else
          factor[e] = inverse / s.moment(e);
      });
    }
    const auto take = [&](const auto& fetch) __attribute__((always_inline)) {
      unroll<Dim>([&](auto d) {
        const NodeSums<Dim> sums = sum_nodes<Dim, Basis>(s, fetch, velocity.v[d]);
        unroll<Dim>([&](auto e) {
          // sum w v (x_i - x_p) = h (moment + r u)
          [[maybe_unused]] Pack affine = 0.0;
          if constexpr (kMoment || kAffine) affine = factor[e] * (sums.moment[e] + s.r[e] * sums.u);
          const Pack gradient = kAffine ? affine : sums.gradient[e] * inverse;
          store_pack(scratch.gradient[Dim * d + e].data() + (q - tile.first), gradient, count);
          if constexpr (kGradient) store_pack(p.c[Dim * d + e].data() + q, gradient, count);
          if constexpr (kMoment) store_pack(p.c[Dim * d + e].data() + q, affine, count);
        });
        Pack v = sums.u;
        if constexpr (kKeep) {
          const Pack gain = interpolate<Dim, Basis>(s, fetch, change.v[d]);
          v += keep * (load_pack(p.v[d].data() + q, count) + gain - sums.u);
        }
        store_pack(p.v[d].data() + q, v, count);
        store_pack(moved[d].data() + q, load_pack(p.x[d].data() + q, count) + dt * sums.u, count);
      });
    };
    with_fetch(s.at, take);
  }
}

/// L = sum v_i grad w of a tile's points from the velocities in `nodes`, into scratch.gradient.
template <int Dim, class Basis>
[[gnu::flatten]] void gather_gradient(const Points<Dim>& p, const Tile<Dim>& tile,
                                      const Grid<Dim>& grid, const Node* nodes,
                                      TileScratch<Dim>& scratch) {
  constexpr int W = kLocalWidth<Dim, Basis>;
  Window<Dim, W> velocity;
  velocity.read(tile, nodes, NodeLayout<Dim>::momentum);
  const double inverse = 1.0 / grid.h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Stencil<Dim, Basis> s;
    evaluate_stencil<Dim, Basis>(p, q, count, grid, inverse, corner, s);
    unroll<Dim>([&](auto d) {
      const NodeSums<Dim> sums = sum_nodes<Dim, Basis>(s, EachLane{s.at}, velocity.v[d]);
      unroll<Dim>([&](auto e) {
        store_pack(scratch.gradient[Dim * d + e].data() + (q - tile.first),
                   sums.gradient[e] * inverse, count);
      });
    });
  }
}

/// sum w v of a tile's points from the velocities in `nodes`, into scratch.velocity.
template <int Dim, class Basis>
[[gnu::flatten]] void interpolate_tile(const Points<Dim>& p, const Tile<Dim>& tile,
                                       const Grid<Dim>& grid, const Node* nodes,
                                       TileScratch<Dim>& scratch) {
  constexpr int W = kLocalWidth<Dim, Basis>;
  Window<Dim, W> velocity;
  velocity.read(tile, nodes, NodeLayout<Dim>::momentum);
  const double inverse = 1.0 / grid.h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Stencil<Dim, Basis> s;
    evaluate_stencil<Dim, Basis>(p, q, count, grid, inverse, corner, s);
    unroll<Dim>([&](auto d) {
      store_pack(scratch.velocity[d].data() + (q - tile.first),
                 interpolate<Dim, Basis>(s, EachLane{s.at}, velocity.v[d]), count);
    });
  }
}

}  // namespace flowslide::mpm
