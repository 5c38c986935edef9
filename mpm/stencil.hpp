#pragma once
#include "core/unroll.hpp"
#include "mpm/basis.hpp"
#include "mpm/grid.hpp"
#include "mpm/points.hpp"

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

/// Position of the first node of a tile's window [cells].
template <int Dim>
std::array<double, Dim> window_corner(const Tile<Dim>& tile) noexcept {
  std::array<double, Dim> corner;
  for (int d = 0; d < Dim; ++d) corner[d] = tile.block[d] * kBlockWidth<Dim> - 1.0;
  return corner;
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
    Basis::evaluate(x - base, s.w[d], s.g[d]);
    s.r[d] = base - x;
    index += base * double(power<d>(W));
  });
  for (int k = 0; k < Pack::lanes; ++k) s.at[k] = static_cast<std::int32_t>(index[k]);
}

}  // namespace flowslide::mpm
