#pragma once
#include "core/unroll.hpp"
#include "mpm/basis.hpp"
#include "mpm/local_grid.hpp"
#include "mpm/points.hpp"

#include <cstring>

/// Particle to grid: mass, momentum (with the affine field) and internal force in one sweep.
/// m_i = sum w m;  (mv)_i = sum w m (v + C (x_i - x_p));  f_i = -sum V sigma grad w.
namespace flowslide::mpm {

/// All sums of a node in one vector register; plain vector extension of GCC and Clang.
using Vec8 = double __attribute__((vector_size(64), aligned(64)));

inline constexpr int kBatch = Pack::lanes;  ///< points whose weights are evaluated together

/// `mean_change` is added to the normal stresses of each point of the tile: what F-bar does to the
/// force.
///
/// What one point gives to its nodes: node (i,j) receives w (a + i b1 + j b2) + grad w . f.
template <int Dim>
struct Contribution {
  Vec8 a, b[Dim], f[Dim];
};

template <int Dim, class Basis>
void scatter_tile(const Points<Dim>& p, const Tile<Dim>& tile, const double* mean_change,
                  Grid<Dim>& grid) noexcept {
  constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>, B = kBlockWidth<Dim>;
  using L = NodeLayout<Dim>;
  alignas(64) Vec8 local[power<Dim>(W)];
  std::memset(local, 0, sizeof local);

  const double h = grid.h, inverse = 1.0 / h;
  std::array<double, Dim> corner;  // position of the window's first node, in cells
  for (int d = 0; d < Dim; ++d) corner[d] = tile.block[d] * B - 1.0;

  double w[Dim][N][kBatch], g[Dim][N][kBatch], rel[Dim][kBatch];
  std::int32_t node[kBatch];
  for (std::int32_t first = tile.first; first < tile.last; first += kBatch) {
    const int count = std::min<std::int32_t>(kBatch, tile.last - first);
    Pack index = 0.0;
    unroll<Dim>([&](auto d) {
      const Pack x =
          (load_pack(p.x[d].data() + first, count) - grid.origin[d]) * inverse - corner[d];
      const Pack base = Basis::base(x);
      Pack wk[N], gk[N];
      Basis::evaluate(x - base, wk, gk);
      unroll<N>([&](auto i) {
        store_pack(w[d][i], wk[i], kBatch);
        store_pack(g[d][i], gk[i] * inverse, kBatch);
      });
      store_pack(rel[d], (base - x) * h, kBatch);
      index += base * double(power<d>(W));
    });
    for (int k = 0; k < kBatch; ++k) node[k] = static_cast<std::int32_t>(index[k]);
    for (int k = 0; k < count; ++k) {
      const std::int32_t q = first + k;
      const double m = p.mass[q], minus_v = -p.volume[q];
      Contribution<Dim> s{};
      s.a[L::mass] = m;
      for (int d = 0; d < Dim; ++d) {
        double u = p.v[d][q];
        for (int e = 0; e < Dim; ++e) {
          const double c = p.c[Dim * d + e][q];
          u += c * rel[e][k];
          s.b[e][L::momentum + d] = m * c * h;
        }
        s.a[L::momentum + d] = m * u;
        for (int e = 0; e < Dim; ++e) {
          constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
          const double mean = d == e ? mean_change[q - tile.first] : 0.0;
          s.f[e][L::force + d] = minus_v * (p.sigma[voigt[d][e]][q] + mean);
        }
      }
      Vec8* at = local + node[k];
      if constexpr (Dim == 2) {
        Vec8 row[N], column[N];
        for (int i = 0; i < N; ++i)
          row[i] = w[0][i][k] * (s.a + double(i) * s.b[0]) + g[0][i][k] * s.f[0];
        for (int j = 0; j < N; ++j) column[j] = (w[1][j][k] * j) * s.b[1] + g[1][j][k] * s.f[1];
        for (int j = 0; j < N; ++j)
          for (int i = 0; i < N; ++i) at[i + W * j] += w[1][j][k] * row[i] + w[0][i][k] * column[j];
      } else {
        for (int l = 0; l < N; ++l) {
          const Vec8 layer = (w[2][l][k] * l) * s.b[2] + g[2][l][k] * s.f[2];
          Vec8 row[N], column[N];
          for (int i = 0; i < N; ++i)
            row[i] = w[0][i][k] * (s.a + double(i) * s.b[0]) + g[0][i][k] * s.f[0];
          for (int j = 0; j < N; ++j) column[j] = (w[1][j][k] * j) * s.b[1] + g[1][j][k] * s.f[1];
          for (int j = 0; j < N; ++j) {
            const double wyz = w[1][j][k] * w[2][l][k];
            const Vec8 rest = w[2][l][k] * column[j] + w[1][j][k] * layer;
            for (int i = 0; i < N; ++i) at[i + W * (j + W * l)] += wyz * row[i] + w[0][i][k] * rest;
          }
        }
      }
    }
  }

  for_each_row<Dim, W>(tile, [&](int from, std::int32_t block, int to, int count) {
    auto* target =
        reinterpret_cast<Vec8*>(grid.nodes.data() + std::size_t(block) * kBlockNodes<Dim> + to);
    for (int i = 0; i < count; ++i) target[i] += local[from + i];
  });
}

}  // namespace flowslide::mpm
