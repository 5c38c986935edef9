#pragma once
#include "mpm/grid/local_grid.hpp"
#include "mpm/kernels/momentum.hpp"
#include "mpm/kernels/stress.hpp"

/// The part of sleeping tiles in a step; docs/theory/mpm.md, section Sleep.
namespace flowslide::mpm {

/// What a sleeping tile costs the nodes that it shares with others, in `window` as its points gave
/// it: they do not take up their share of momentum, nor does their stress change, nor do they sink.
/// Where points keep the share `keep` of their own velocity (aflip, flip), those awake keep the
/// difference to a grid that is slower for what sleeps.
template <int Dim, class Basis>
StressWork hold_asleep(const Tile<Dim>& tile, const NodeVector* window, const Grid<Dim>& grid,
                       const MomentumSettings& s, double keep, GridWork<Dim>& work) noexcept {
  using L = NodeLayout<Dim>;
  StressWork stress;
  work = {};
  for_each_row<Dim, kLocalWidth<Dim, Basis>>(
      tile, [&](int to, std::int32_t block, int from, int count) {
        const Node* nodes = grid.nodes.data() + std::size_t(block) * kBlockNodes<Dim> + from;
        for (int i = 0; i < count; ++i) {
          const NodeVector& given = window[to + i];
          for (int d = 0; d < Dim; ++d) {
            const double v = nodes[i].q[L::momentum + d], old = v - nodes[i].q[L::force + d];
            const double weight = given[L::mass] * s.gravity[d];
            const double sinking = 0.5 * s.dt * weight * (old + v);
            stress.power_start -= s.dt * given[L::force + d] * v;
            work.gravity -= sinking;
            work.boundary += sinking;
            work.boundary_impulse[d] -= given[L::mass] * (v - keep * old);
          }
        }
      });
  stress.power_end = stress.power_start;
  return stress;
}

}  // namespace flowslide::mpm
