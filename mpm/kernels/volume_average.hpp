#pragma once
#include "mpm/kernels/stencil.hpp"

#include <algorithm>
#include <span>
#include <vector>

/// Averages over knot spans (the pieces on which the shape functions are one polynomial), the cure
/// of volumetric locking: the volumetric strain rate AND the mean stress of nearly incompressible
/// points are averaged over the same spans with the same weights, so that the force stays conjugate
/// to the strain rate. Averaging the rate alone pumps energy. docs/theory/mpm.md, section F-bar
namespace flowslide::mpm {

/// Volume-weighted sum of a span and its weight, side by side so that one addition serves both.
using SpanSum = double __attribute__((vector_size(16)));

/// Buffers for one tile, one per thread; those per point are longer by the lanes of a Pack.
struct SpanScratch {
  std::int32_t* span = nullptr;  ///< per point of the tile, within StepScratch::span
  std::vector<double> change;    ///< per point: average minus own value, 0 where not averaged
  std::vector<double> value;     ///< per point
  std::vector<SpanSum> sum;      ///< per span
  std::vector<double> mean;      ///< per span
};

template <int Dim>
inline constexpr int kSpans = power<Dim>(kBlockWidth<Dim> + 2);  ///< in the reach of a tile

/// Knot span of every point of the tile, numbered inside the tile's window.
template <int Dim, class Basis>
[[gnu::flatten]] void find_spans(const Points<Dim>& p, const Tile<Dim>& tile, const Grid<Dim>& grid,
                                 SpanScratch& s) noexcept {
  const double inverse = 1.0 / grid.h;
  const std::array<double, Dim> corner = window_corner<Dim>(tile);
  for (std::int32_t q = tile.first; q < tile.last; q += Pack::lanes) {
    const int count = std::min<int>(Pack::lanes, tile.last - q);
    Pack at = 0.0;
    unroll<Dim>([&](auto d) {
      const Pack x = (load_pack(p.x[d].data() + q, count) - grid.origin[d]) * inverse - corner[d];
      at += base_node<Basis>(x) * double(power<d>(kBlockWidth<Dim> + 2));
    });
    for (int k = 0; k < count; ++k) s.span[q - tile.first + k] = static_cast<std::int32_t>(at[k]);
  }
}

/// s.change[k] = mean over the span - value(k) for points of averaged runs, 0 for others; means are
/// weighted by volume. `averaged(run)` tells which runs take part; `value(k, count)` gives the
/// values of points [k, k + count) of the tile.
template <int Dim, class Averaged, class Value>
[[gnu::flatten]] void average_over_spans(const Points<Dim>& p, const Tile<Dim>& tile,
                                         std::span<const MaterialRun> runs, SpanScratch& s,
                                         Averaged&& averaged, Value&& value) noexcept {
  if (std::none_of(runs.begin(), runs.end(), averaged)) {
    std::fill_n(s.change.begin(), tile.last - tile.first, 0.0);
    return;
  }
  std::fill(s.sum.begin(), s.sum.end(), SpanSum{});
  for (const MaterialRun& run : runs) {
    if (!averaged(run)) continue;
    for (std::int32_t q = run.first; q < run.last; q += Pack::lanes) {
      const int count = std::min<int>(Pack::lanes, run.last - q);
      const std::int32_t k = q - tile.first;
      const Pack own = value(k, count);
      store_pack(s.value.data() + k, own, count);
      double weighted[Pack::lanes];
      store_pack(weighted, load_pack(p.volume.data() + q, count) * own, Pack::lanes);
      for (int i = 0; i < count; ++i) s.sum[s.span[k + i]] += SpanSum{weighted[i], p.volume[q + i]};
    }
  }
  for (int at = 0; at < kSpans<Dim>; ++at) s.mean[at] = s.sum[at][0] / s.sum[at][1];
  for (const MaterialRun& run : runs) {
    const bool on = averaged(run);
    for (std::int32_t q = run.first; q < run.last; q += Pack::lanes) {
      const int count = std::min<int>(Pack::lanes, run.last - q);
      const std::int32_t k = q - tile.first;
      const Pack change =
          on ? gather_pack(s.mean.data(), s.span + k, count) - load_pack(s.value.data() + k, count)
             : Pack(0.0);
      store_pack(s.change.data() + k, change, count);
    }
  }
}

}  // namespace flowslide::mpm
