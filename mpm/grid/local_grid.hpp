#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/grid/node_vector.hpp"

#include <algorithm>
#include <cstring>

/// A tile's window: the nodes its points can touch, one below its block to one or more above it.
/// Points give to windows, which belong to one tile each, so that no two threads write to the same
/// node; the nodes of the grid are then the sums of the windows that reach them.
namespace flowslide::mpm {

template <int Dim, class Basis>
inline constexpr int kWindowNodes = power<Dim>(kLocalWidth<Dim, Basis>);

/// Calls f(local_row_start, block_index, node_row_start, count) for every run of nodes along x in
/// the window of `tile`: `width` nodes per direction, the first one node below the tile's block.
template <int Dim, int Width, class F>
inline void for_each_row(const Tile<Dim>& tile, F&& f) {
  constexpr int B = kBlockWidth<Dim>;
  const auto rows_of = [&](int local, int& block, int& node) {
    const int shifted = local - 1 + B;  // node relative to the block below
    block = shifted / B;                // 0 below, 1 own, 2 above
    node = shifted % B;
  };
  constexpr int outer = Dim == 3 ? Width : 1;
  for (int z = 0; z < outer; ++z) {
    int bz = 0, nz = 0;
    if constexpr (Dim == 3) rows_of(z, bz, nz);
    for (int y = 0; y < Width; ++y) {
      int by = 0, ny = 0;
      rows_of(y, by, ny);
      const int around = Dim == 3 ? 3 * (by + 3 * bz) : 3 * by;
      const int node = Dim == 3 ? B * (ny + B * nz) : B * ny;
      const int local = Width * (y + Width * z);
      f(local, tile.around[around + 0], node + B - 1, 1);
      f(local + 1, tile.around[around + 1], node, B);
      f(local + 1 + B, tile.around[around + 2], node, Width - 1 - B);
    }
  }
}

/// Nodes of a block as sums of what the windows of the tiles around it hold, in the order of the
/// tiles. `windows` has kWindowNodes per tile, `nodes` is laid out as Grid::nodes.
template <int Dim, class Basis>
void sum_windows(const Tiling<Dim>& tiling, const Node* windows, std::int32_t block,
                 Node* nodes) noexcept {
  constexpr int B = kBlockWidth<Dim>, W = kLocalWidth<Dim, Basis>;
  struct Overlap {
    int node, window, count;
  };
  // Of a tile with this block below, at or above its own.
  constexpr Overlap overlaps[3] = {{B - 1, 0, 1}, {0, 1, B}, {0, 1 + B, W - 1 - B}};
  auto* target = reinterpret_cast<NodeVector*>(nodes + std::size_t(block) * kBlockNodes<Dim>);
  std::memset(static_cast<void*>(target), 0, sizeof(Node) * kBlockNodes<Dim>);
  for (std::int32_t r = tiling.reach_first[block]; r < tiling.reach_first[block + 1]; ++r) {
    const Reach reach = tiling.reach[r];
    const auto* window = reinterpret_cast<const NodeVector*>(
        windows + std::size_t(reach.tile) * kWindowNodes<Dim, Basis>);
    const Overlap x = overlaps[reach.place % 3], y = overlaps[reach.place / 3 % 3];
    const Overlap z = Dim == 3 ? overlaps[reach.place / 9] : Overlap{0, 0, 1};
    for (int k = 0; k < z.count; ++k) {
      for (int j = 0; j < y.count; ++j) {
        const NodeVector* from = window + x.window + W * (y.window + j + W * (z.window + k));
        NodeVector* to = target + x.node + B * (y.node + j + B * (z.node + k));
        for (int i = 0; i < x.count; ++i) to[i] += from[i];
      }
    }
  }
}

}  // namespace flowslide::mpm
