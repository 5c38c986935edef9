#pragma once
#include "core/check.hpp"
#include "core/unroll.hpp"
#include "mpm/grid/grid.hpp"
#include "mpm/grid/points.hpp"
#include "mpm/kernels/basis.hpp"

/// Weights of as many points as a Pack has lanes, and where their nodes lie in a tile's window.
namespace flowslide::mpm {

template <int Dim, class Basis>
struct Stencil {
  Pack w[Dim][Basis::nodes], g[Dim][Basis::nodes];  ///< weights, gradients [1/cell]
  Pack r[Dim];                                      ///< lowest node less point [cells]
  alignas(64) std::int32_t at[Pack::lanes];         ///< lowest node within the window
  [[nodiscard]] Pack moment(int d) const {          ///< D of direction d [cells^2]
    return second_moment<Basis, Pack>(-r[d], w[d]);
  }
};

/// Calls f(l) for the N layers of a stencil, one in the plane. Layers of nine or sixteen nodes are
/// a loop: written out they take up to four times as long to compile, and run no faster.
template <int Dim, int N, class F>
[[gnu::always_inline]] inline void each_layer(F&& f) noexcept {
  if constexpr (Dim == 3 && N > 2) {
    for (int l = 0; l < N; ++l) f(l);
  } else {
    unroll<(Dim == 3 ? N : 1)>(f);
  }
}

/// How values at the nodes of eight points are fetched. Points follow one another by cell, so that
/// most Packs hold points of two to four cells: as many broadcasts as cells, merged by masks, cost
/// a fraction of a gather of eight addresses.
template <int kMost>
struct CellRuns {
  std::int32_t at[kMost];
  PackMask from[kMost];  ///< lanes of run k and later ones
  [[gnu::always_inline]] Pack operator()(const double* v) const noexcept {
    Pack r = v[at[0]];
    unroll<kMost - 1>([&](auto k) { r = select(from[k + 1], Pack(v[at[k + 1]]), r); });
    return r;
  }
};
struct EachLane {
  const std::int32_t* at;
  [[gnu::always_inline]] Pack operator()(const double* v) const noexcept {
    return gather_pack(v, at);
  }
};

/// Calls f with the cheapest fetch for the lanes' lowest nodes `at`.
template <class F>
[[gnu::always_inline]] inline void with_fetch(const std::int32_t* at, F&& f) noexcept {
  constexpr int kMost = 4;
  CellRuns<kMost> four;
  int runs = 1;
  PackMask::Vector lane;
  for (int k = 0; k < Pack::lanes; ++k) lane[k] = k;
  for (int k = 0; k < kMost; ++k) four.at[k] = at[0], four.from[k] = {lane < 0};
  for (int k = 1; k < Pack::lanes; ++k) {
    if (at[k] == at[k - 1]) continue;
    if (runs < kMost) four.at[runs] = at[k], four.from[runs] = {lane >= k};
    ++runs;
  }
  if (runs <= 2)
    f(CellRuns<2>{{four.at[0], four.at[1]}, {four.from[0], four.from[1]}});
  else if (runs <= kMost)
    f(four);
  else
    f(EachLane{at});
}

/// Position of the first node of a tile's window [cells].
template <int Dim>
std::array<double, Dim> window_corner(const Tile<Dim>& tile) noexcept {
  std::array<double, Dim> corner;
  for (int d = 0; d < Dim; ++d) corner[d] = tile.block[d] * kBlockWidth<Dim> - 1.0;
  return corner;
}

/// True where all points of a tile, at positions `x`, touch nodes of its window only. A position
/// that is not a number lies outside.
template <int Dim, class Basis>
[[gnu::flatten]] bool in_window(const std::array<StaggeredArray<double>, Dim>& x,
                                const Tile<Dim>& tile, const Grid<Dim>& grid) noexcept {
  // The rounding of a floor that is taken elsewhere is left to neither side.
  constexpr double kMargin = 1e-6, kWidth = kBlockWidth<Dim> + 2;
  const double inverse = 1.0 / grid.h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  PackMask in{Pack(0.0).v == Pack(0.0).v};
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    unroll<Dim>([&](auto d) {
      const Pack base =
          (load_pack(x[d].data() + q, count) - grid.origin[d]) * inverse - corner[d] - Basis::shift;
      in = in && base > Pack(kMargin) && base < Pack(kWidth - kMargin);
    });
  }
  return all(in);
}

/// Points [q, q + count); lanes beyond repeat the last point.
template <int Dim, class Basis>
[[gnu::always_inline]] inline void evaluate_stencil(const Points<Dim>& p, std::int32_t q, int count,
                                                    const Grid<Dim>& grid, double inverse,
                                                    const std::array<double, Dim>& corner,
                                                    Stencil<Dim, Basis>& s) noexcept {
  constexpr int W = kLocalWidth<Dim, Basis>;
  Pack index = 0.0;
  unroll<Dim>([&](auto d) {
    const Pack x = (load_pack(p.x[d].data() + q, count) - grid.origin[d]) * inverse - corner[d];
    const Pack base = base_node<Basis>(x);
    FLOWSLIDE_EXPECT(all(base >= Pack(0.0) && base <= Pack(kBlockWidth<Dim> + 1.0)));
    Basis::evaluate(x - base, s.w[d], s.g[d]);
    s.r[d] = base - x;
    index += base * double(power<d>(W));
  });
  for (int k = 0; k < Pack::lanes; ++k) s.at[k] = static_cast<std::int32_t>(index[k]);
}

}  // namespace flowslide::mpm
