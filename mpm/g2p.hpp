#pragma once
#include "core/unroll.hpp"
#include "mpm/basis.hpp"
#include "mpm/local_grid.hpp"
#include "mpm/points.hpp"
#include "mpm/volume_average.hpp"

/// Grid to particle: velocity, affine field, velocity gradient and new position.
/// v = sum w v_i;  C = D^-1 sum w v_i (x_i - x_p)^T;  L = sum v_i grad w;  x += dt sum w v_i.
namespace flowslide::mpm {

/// Velocity gradients of a tile's points and the buffers of its averages; one per thread.
template <int Dim>
struct TileScratch {
  std::array<std::vector<double>, Dim * Dim> gradient;  ///< row-major L [1/s]
  SpanScratch average;
};

enum class Transfer { apic, tpic };

template <int Dim, class Basis, Transfer kTransfer>
void gather_tile(Points<Dim>& p, const Tile<Dim>& tile, const Grid<Dim>& grid, double dt,
                 TileScratch<Dim>& scratch) {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>, B = kBlockWidth<Dim>;
  using L = NodeLayout<Dim>;
  double v[Dim][power<Dim>(W)];
  for_each_row<Dim, W>(tile, [&](int to, std::int32_t block, int from, int count) {
    const Node* source = grid.nodes.data() + std::size_t(block) * kBlockNodes<Dim> + from;
    for (int i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) v[d][to + i] = source[i].q[L::momentum + d];
  });

  const double h = grid.h, inverse = 1.0 / h;
  const double affine = 1.0 / (Basis::affine_moment * h * h);
  std::array<double, Dim> corner;
  for (int d = 0; d < Dim; ++d) corner[d] = tile.block[d] * B - 1.0;

  // Plain pointers, so that the compiler need not fear that a store moves an array.
  const std::int32_t first = tile.first, count = tile.last - tile.first;
  double *px[Dim], *pv[Dim], *pc[Dim * Dim], *pl[Dim * Dim];
  for (int d = 0; d < Dim; ++d) {
    px[d] = p.x[d].data() + first;
    pv[d] = p.v[d].data() + first;
  }
  for (int k = 0; k < Dim * Dim; ++k) {
    pc[k] = p.c[k].data() + first;
    pl[k] = scratch.gradient[k].data();
  }
#pragma omp simd
  for (std::int32_t q = 0; q < count; ++q) {
    double w[Dim][N], g[Dim][N], r[Dim];
    int at = 0;
    unroll<Dim>([&](auto d) {
      const double position = (px[d][q] - grid.origin[d]) * inverse - corner[d];
      const double base = Basis::base(position);
      Basis::evaluate(position - base, w[d], g[d]);
      r[d] = base - position;
      at += static_cast<int>(base) * power<d>(W);
    });
    double u[Dim], moment[Dim][Dim], gradient[Dim][Dim];
    unroll<Dim>([&](auto d) {
      double s_u = 0, s_x = 0, s_y = 0, s_z = 0, g_x = 0, g_y = 0, g_z = 0;
      unroll<(Dim == 3 ? N : 1)>([&](auto l) {
        double t_u = 0, t_x = 0, t_y = 0, t_gx = 0, t_gy = 0;
        unroll<N>([&](auto j) {
          double a = 0, ax = 0, ag = 0;
          unroll<N>([&](auto i) {
            const double vi = v[d][at + (i + W * j + (Dim == 3 ? W * W * l : 0))];
            a += w[0][i] * vi;
            ax += (w[0][i] * i) * vi;
            ag += g[0][i] * vi;
          });
          t_u += w[1][j] * a;
          t_x += w[1][j] * ax;
          t_gx += w[1][j] * ag;
          t_y += (w[1][j] * j) * a;
          t_gy += g[1][j] * a;
        });
        const double wz = Dim == 3 ? w[Dim - 1][l] : 1.0;
        s_u += wz * t_u;
        s_x += wz * t_x;
        s_y += wz * t_y;
        g_x += wz * t_gx;
        g_y += wz * t_gy;
        if constexpr (Dim == 3) {
          s_z += (wz * l) * t_u;
          g_z += g[Dim - 1][l] * t_u;
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
        pl[Dim * d + e][q] = gradient[d][e];
        // sum w v (x_i - x_p) = h (moment + r u)
        pc[Dim * d + e][q] = kTransfer == Transfer::tpic
                                  ? gradient[d][e]
                                  : affine * h * (moment[d][e] + r[e] * u[d]);
      });
      pv[d][q] = u[d];
      px[d][q] += dt * u[d];
    });
  }
}

}  // namespace flowslide::mpm
