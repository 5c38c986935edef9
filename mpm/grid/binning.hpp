#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/grid/points.hpp"

namespace flowslide::mpm {

/// Buffers of bin_points, kept between calls so that binning allocates only while they grow.
struct BinningScratch {
  std::vector<std::int64_t> key;     ///< of the block a point lies in
  std::vector<std::int64_t> blocks;  ///< keys that occur, ascending
  std::vector<std::int64_t> place;   ///< rank by (tile, material, cell)
  std::vector<std::int32_t> order;
  struct Copy {
    StaggeredArray<double> real;
    std::vector<std::int32_t> integer;
  };
  std::vector<Copy> copy{1};  ///< one per thread that may permute arrays
};

/// Sorts the points by (tile, material, cell), ties in their present order, and rebuilds tiles,
/// runs, reaches and active blocks. `basis_shift` is where a basis function's support starts
/// relative to its point in cells (0.5 for the quadratic spline). Boundary lists are left to the
/// caller.
template <int Dim>
void bin_points(Points<Dim>& p, Grid<Dim>& grid, Tiling<Dim>& tiling, double basis_shift,
                BinningScratch& scratch);

/// Neighbours, reaches and active blocks from tiling.tiles[].block/first/last and runs,
/// which a checkpoint restores.
template <int Dim>
void link_tiles(Grid<Dim>& grid, Tiling<Dim>& tiling);

}  // namespace flowslide::mpm
