#pragma once
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

#pragma omp simd
  for (std::int32_t q = tile.first; q < tile.last; ++q) {
    double w[Dim][N], g[Dim][N], r[Dim];
    int at = 0, stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const double x = (p.x[d][q] - grid.origin[d]) * inverse - corner[d];
      const double base = Basis::base(x);
      Basis::evaluate(x - base, w[d], g[d]);
      r[d] = base - x;
      at += static_cast<int>(base) * stride;
      stride *= W;
    }
    double u[Dim] = {}, moment[Dim][Dim] = {}, gradient[Dim][Dim] = {};
    for (int d = 0; d < Dim; ++d) {
      for (int l = 0; l < (Dim == 3 ? N : 1); ++l) {
        double s0 = 0, sx = 0, sgx = 0, sy = 0, sgy = 0;
        for (int j = 0; j < N; ++j) {
          double a = 0, ax = 0, ag = 0;
          for (int i = 0; i < N; ++i) {
            const double vi = v[d][at + i + W * j + (Dim == 3 ? W * W * l : 0)];
            a += w[0][i] * vi;
            ax += w[0][i] * i * vi;
            ag += g[0][i] * vi;
          }
          s0 += w[1][j] * a;
          sx += w[1][j] * ax;
          sgx += w[1][j] * ag;
          sy += w[1][j] * j * a;
          sgy += g[1][j] * a;
        }
        const double wz = Dim == 3 ? w[Dim - 1][l] : 1.0;
        u[d] += wz * s0;
        moment[d][0] += wz * sx;
        moment[d][1] += wz * sy;
        gradient[d][0] += wz * sgx;
        gradient[d][1] += wz * sgy;
        if constexpr (Dim == 3) {
          moment[d][2] += wz * l * s0;
          gradient[d][2] += g[2][l] * s0;
        }
      }
    }
    for (int d = 0; d < Dim; ++d) {
      for (int e = 0; e < Dim; ++e) {
        scratch.gradient[Dim * d + e][q - tile.first] = gradient[d][e] * inverse;
        // sum w v (x_i - x_p) = h (moment + r u)
        p.c[Dim * d + e][q] = kTransfer == Transfer::tpic
                                  ? gradient[d][e] * inverse
                                  : affine * h * (moment[d][e] + r[e] * u[d]);
      }
      p.v[d][q] = u[d];
      p.x[d][q] += dt * u[d];
    }
  }
}

}  // namespace flowslide::mpm
