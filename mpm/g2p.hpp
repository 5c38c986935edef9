#pragma once
#include "core/unroll.hpp"
#include "mpm/basis.hpp"
#include "mpm/local_grid.hpp"
#include "mpm/points.hpp"
#include "mpm/volume_average.hpp"

/// Grid to particle: velocity, affine field, velocity gradient and new position.
/// `keep` is the share of its own velocity a point keeps in a step with aflip.
/// v = sum w v_i;  C = D^-1 sum w v_i (x_i - x_p)^T;  L = sum v_i grad w;  x += dt sum w v_i.
namespace flowslide::mpm {

/// Velocity gradients of a tile's points and the buffers of its averages; one per thread.
template <int Dim>
struct TileScratch {
  std::array<std::vector<double>, Dim * Dim> gradient;  ///< row-major L [1/s]
  SpanScratch average;
};

/// How points get their velocity from the grid; all keep an affine velocity field.
/// apic, tpic: the grid's velocity itself; noise and sub-grid motion are lost every step, a
/// viscosity that grows like h^2/dt. aflip: the point's own velocity plus the grid's change,
/// relaxed towards the grid's velocity with a time constant, so that the loss does not depend on
/// dt.
enum class Transfer { apic, tpic, aflip };

template <int Dim, class Basis, Transfer kTransfer>
void gather_tile(Points<Dim>& p, const Tile<Dim>& tile, const Grid<Dim>& grid, double dt,
                 double keep, TileScratch<Dim>& scratch) {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>, B = kBlockWidth<Dim>;
  using L = NodeLayout<Dim>;
  constexpr bool kFlip = kTransfer == Transfer::aflip;
  double v[Dim][power<Dim>(W)];
  double change[kFlip ? Dim : 1][kFlip ? power<Dim>(W) : 1];
  for_each_row<Dim, W>(tile, [&](int to, std::int32_t block, int from, int count) {
    const Node* source = grid.nodes.data() + std::size_t(block) * kBlockNodes<Dim> + from;
    for (int i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) v[d][to + i] = source[i].q[L::momentum + d];
    if constexpr (kFlip)
      for (int i = 0; i < count; ++i)
        for (int d = 0; d < Dim; ++d) change[d][to + i] = source[i].q[L::force + d];
  });

  const double h = grid.h, inverse = 1.0 / h;
  const double affine = 1.0 / (Basis::affine_moment * h * h);
  std::array<double, Dim> corner;
  for (int d = 0; d < Dim; ++d) corner[d] = tile.block[d] * B - 1.0;

  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Pack w[Dim][N], g[Dim][N], r[Dim], index = 0.0;
    unroll<Dim>([&](auto d) {
      const Pack position =
          (load_pack(p.x[d].data() + q, count) - grid.origin[d]) * inverse - corner[d];
      const Pack base = Basis::base(position);
      Basis::evaluate(position - base, w[d], g[d]);
      r[d] = base - position;
      index += base * double(power<d>(W));
    });
    std::int32_t at[Pack::lanes];
    for (int i = 0; i < Pack::lanes; ++i) at[i] = static_cast<std::int32_t>(index[i]);

    Pack u[Dim], moment[Dim][Dim], gradient[Dim][Dim];
    unroll<Dim>([&](auto d) {
      Pack s_u = 0, s_x = 0, s_y = 0, s_z = 0, g_x = 0, g_y = 0, g_z = 0;
      unroll<(Dim == 3 ? N : 1)>([&](auto l) {
        Pack t_u = 0, t_x = 0, t_y = 0, t_gx = 0, t_gy = 0;
        unroll<N>([&](auto j) {
          Pack a = 0, ax = 0, ag = 0;
          unroll<N>([&](auto i) {
            const Pack vi = gather_pack(v[d] + (i + W * j + (Dim == 3 ? W * W * l : 0)), at);
            const Pack weighted = w[0][i] * vi;
            a += weighted;
            if constexpr (i > 0) ax += double(i) * weighted;
            ag += g[0][i] * vi;
          });
          t_u += w[1][j] * a;
          t_x += w[1][j] * ax;
          t_gx += w[1][j] * ag;
          if constexpr (j > 0) t_y += double(j) * (w[1][j] * a);
          t_gy += g[1][j] * a;
        });
        if constexpr (Dim == 3) {
          s_u += w[2][l] * t_u;
          s_x += w[2][l] * t_x;
          s_y += w[2][l] * t_y;
          g_x += w[2][l] * t_gx;
          g_y += w[2][l] * t_gy;
          if constexpr (l > 0) s_z += double(l) * (w[2][l] * t_u);
          g_z += g[2][l] * t_u;
        } else {
          s_u = t_u, s_x = t_x, s_y = t_y, g_x = t_gx, g_y = t_gy;
        }
      });
      u[d] = s_u;
      moment[d][0] = s_x;
      moment[d][1] = s_y;
      gradient[d][0] = g_x * inverse;
      gradient[d][1] = g_y * inverse;
      if constexpr (Dim == 3) {
        moment[d][2] = s_z;
        gradient[d][2] = g_z * inverse;
      }
    });
    unroll<Dim>([&](auto d) {
      unroll<Dim>([&](auto e) {
        store_pack(scratch.gradient[Dim * d + e].data() + (q - tile.first), gradient[d][e], count);
        // sum w v (x_i - x_p) = h (moment + r u)
        const Pack c = kTransfer == Transfer::tpic ? gradient[d][e]
                                                   : affine * h * (moment[d][e] + r[e] * u[d]);
        store_pack(p.c[Dim * d + e].data() + q, c, count);
      });
      Pack velocity = u[d];
      if constexpr (kFlip) {
        Pack gain = 0.0;
        unroll<power<Dim>(N)>([&](auto n) {
          constexpr int i = n % N, j = n / N % N, l = n / (N * N);
          Pack weight = w[0][i] * w[1][j];
          if constexpr (Dim == 3) weight *= w[Dim - 1][l];
          gain += weight * gather_pack(change[d] + (i + W * j + W * W * l), at);
        });
        velocity += keep * (load_pack(p.v[d].data() + q, count) + gain - u[d]);
      }
      store_pack(p.v[d].data() + q, velocity, count);
      store_pack(p.x[d].data() + q, load_pack(p.x[d].data() + q, count) + dt * u[d], count);
    });
  }
}

}  // namespace flowslide::mpm
