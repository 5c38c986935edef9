#pragma once
#include "mpm/grid.hpp"

/// Copies between a tile's local window of nodes and the blocks around it.
namespace flowslide::mpm {

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

}  // namespace flowslide::mpm
