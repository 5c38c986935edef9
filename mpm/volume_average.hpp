#pragma once
#include "core/unroll.hpp"
#include "mpm/basis.hpp"
#include "mpm/grid.hpp"
#include "mpm/points.hpp"

#include <algorithm>
#include <span>
#include <vector>

/// Averages over knot spans (the pieces on which the shape functions are one polynomial), the cure
/// of volumetric locking: the volumetric strain rate AND the mean stress of nearly incompressible
/// points are averaged over the same spans with the same weights, so that the force stays conjugate
/// to the strain rate. Averaging the rate alone pumps energy. docs/theory/mpm.md, section F-bar
namespace flowslide::mpm {

/// Buffers for one tile, one per thread.
struct SpanScratch {
  std::vector<std::int32_t> span;   ///< per point of the tile
  std::vector<double> change;       ///< per point: average minus own value, 0 where not averaged
  std::vector<double> sum, weight;  ///< per span
};

/// Knot span of every point of the tile, numbered inside the tile's window.
template <int Dim, class Basis>
void find_spans(const Points<Dim>& p, const Tile<Dim>& tile, const Grid<Dim>& grid,
                SpanScratch& s) noexcept {
  constexpr int B = kBlockWidth<Dim>;
  const double inverse = 1.0 / grid.h;
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Pack at = 0.0;
    unroll<Dim>([&](auto d) {
      const Pack x = (load_pack(p.x[d].data() + q, count) - grid.origin[d]) * inverse -
                     (tile.block[d] * B - 1.0);
      at += Basis::base(x) * double(power<d>(B + 2));
    });
    for (int k = 0; k < count; ++k) s.span[q - tile.first + k] = static_cast<std::int32_t>(at[k]);
  }
}

/// s.change[k] = mean over the span - value(k) for points of averaged runs, 0 for others; means are
/// weighted by volume. `averaged(run)` tells which runs take part.
template <int Dim, class Averaged, class Value>
void average_over_spans(const Points<Dim>& p, const Tile<Dim>& tile,
                        std::span<const MaterialRun> runs, SpanScratch& s, Averaged&& averaged,
                        Value&& value) noexcept {
  std::fill(s.sum.begin(), s.sum.end(), 0.0);
  std::fill(s.weight.begin(), s.weight.end(), 0.0);
  for (const MaterialRun& run : runs) {
    if (!averaged(run)) continue;
    for (std::int32_t q = run.first; q < run.last; ++q) {
      const std::int32_t k = q - tile.first, at = s.span[k];
      s.sum[at] += p.volume[q] * value(k);
      s.weight[at] += p.volume[q];
    }
  }
  for (const MaterialRun& run : runs) {
    const bool on = averaged(run);
    for (std::int32_t q = run.first; q < run.last; ++q) {
      const std::int32_t k = q - tile.first, at = s.span[k];
      s.change[k] = on ? s.sum[at] / s.weight[at] - value(k) : 0.0;
    }
  }
}

}  // namespace flowslide::mpm
