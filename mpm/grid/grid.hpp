#pragma once
#include "core/staggered_array.hpp"

#include <array>
#include <cstdint>
#include <vector>

/// Sparse background grid: blocks of nodes exist only where points are near.
namespace flowslide::mpm {

template <int Dim>
inline constexpr int kBlockWidth = Dim == 2 ? 8 : 4;  ///< nodes per direction of a block

template <int Dim>
constexpr int power(int base) {
  int r = 1;
  for (int i = 0; i < Dim; ++i) r *= base;
  return r;
}

template <int Dim>
inline constexpr int kBlockNodes = power<Dim>(kBlockWidth<Dim>);
template <int Dim>
inline constexpr int kNeighbours = power<Dim>(3);  ///< a block and all around it

/// Nodal sums as one cache line: mass, momentum (velocity after the momentum step), force.
struct alignas(64) Node {
  std::array<double, 8> q;
};
/// Components of Node::q.
template <int Dim>
struct NodeLayout {
  static constexpr int mass = 0;
  static constexpr int momentum = 1;     ///< Dim entries; velocity v* after the momentum step
  static constexpr int force = 1 + Dim;  ///< Dim entries; internal force [N], v* - v afterwards
  /// Dim entries: force of tractions [N]. Only plane strain has room for them.
  static constexpr int load = Dim == 2 ? 5 : -1;
};

template <int Dim>
using Coordinate = std::array<std::int32_t, Dim>;  ///< block or node coordinate

template <int Dim>
struct Grid {
  double h = 0.0;                       ///< spacing [m]
  std::array<double, Dim> origin{};     ///< position of node 0 [m]
  std::vector<Coordinate<Dim>> blocks;  ///< active blocks, ascending
  StaggeredArray<Node> nodes;           ///< kBlockNodes per block
};

/// A tile is a block that owns points. They may have drifted up to one cell out of it.
template <int Dim>
struct Tile {
  Coordinate<Dim> block{};
  std::int32_t first = 0, last = 0;                     ///< points [first, last)
  std::array<std::int32_t, kNeighbours<Dim>> around{};  ///< indices into Grid::blocks, x fastest
};

/// A tile whose points reach into a block, which is neighbour `place` of Tile::around.
struct Reach {
  std::int32_t tile, place;
};

/// Points [first, last) of one material inside one tile.
struct MaterialRun {
  std::int32_t first, last, material;
};

template <int Dim>
struct Tiling {
  std::vector<Tile<Dim>> tiles;
  std::vector<std::int32_t> run_first;  ///< per tile, into runs; one more at the end
  std::vector<MaterialRun> runs;
  std::vector<std::int32_t> reach_first;  ///< per block, into reach; one more at the end
  std::vector<Reach> reach;               ///< tiles ascending within a block
};

/// Width of the nodes a tile's points can touch: one cell of drift on each side.
template <int Dim, class Basis>
inline constexpr int kLocalWidth = kBlockWidth<Dim> + 1 + Basis::nodes;

}  // namespace flowslide::mpm
