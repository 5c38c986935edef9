#include "mpm/grid/binning.hpp"

#include "core/check.hpp"
#include "core/memory.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <omp.h>

namespace flowslide::mpm {
namespace {

// 20 bits of block coordinate per direction around zero, 3 bits less than a double holds exactly.
constexpr std::int64_t kBits = 20, kHalf = std::int64_t{1} << (kBits - 1);
constexpr double kFarthest = double(kHalf - 2);  // room for the neighbours of a block

template <int Dim>
std::int64_t pack(const Coordinate<Dim>& c) {
  std::int64_t key = 0;
  for (int d = Dim - 1; d >= 0; --d) key = (key << kBits) | (c[d] + kHalf);
  return key;
}
template <int Dim>
Coordinate<Dim> unpack(std::int64_t key) {
  Coordinate<Dim> c{};
  for (int d = 0; d < Dim; ++d) {
    c[d] = static_cast<std::int32_t>((key & ((std::int64_t{1} << kBits) - 1)) - kHalf);
    key >>= kBits;
  }
  return c;
}

template <class Array>
void permute(Array& a, const std::vector<std::int32_t>& order, Array& scratch) {
  scratch.resize(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) scratch[i] = a[order[i]];
  a.swap(scratch);
}

/// Order of the points by `place`, below `places`, stable: a counting sort.
void sort_by_place(BinningScratch& scratch, std::int64_t places) {
  std::vector<std::int32_t> first(places + 1, 0);
  for (const std::int64_t place : scratch.place) ++first[place + 1];
  for (std::int64_t i = 0; i < places; ++i) first[i + 1] += first[i];
  scratch.order.resize(scratch.place.size());
  for (std::size_t i = 0; i < scratch.place.size(); ++i)
    scratch.order[first[scratch.place[i]]++] = static_cast<std::int32_t>(i);
}

}  // namespace

template <int Dim>
void link_tiles(Grid<Dim>& grid, Tiling<Dim>& tiling) {
  std::vector<std::int64_t> keys;
  keys.reserve(tiling.tiles.size() * kNeighbours<Dim>);
  const auto neighbour = [](const Coordinate<Dim>& block, int n) {
    Coordinate<Dim> c = block;
    for (int d = 0; d < Dim; ++d, n /= 3) c[d] += n % 3 - 1;
    return c;
  };
  for (const Tile<Dim>& t : tiling.tiles)
    for (int n = 0; n < kNeighbours<Dim>; ++n) keys.push_back(pack<Dim>(neighbour(t.block, n)));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  // Nodes, and about as much for the windows of the tiles.
  const double bytes = 2.0 * sizeof(Node) * kBlockNodes<Dim> * double(keys.size());
  if (keys.size() * kBlockNodes < Dim >> grid.nodes.capacity() && bytes > 1e8)
    need_memory(bytes,
                fmt::format("a grid of {} blocks of {} cells of {:.3g} m", keys.size(),
                            kBlockNodes<Dim>, grid.h),
                "use a larger cell, or an outlet for points that fly away");
  grid.blocks.clear();
  for (const std::int64_t key : keys) grid.blocks.push_back(unpack<Dim>(key));
  grid.nodes.resize(keys.size() * kBlockNodes<Dim>);
  tiling.reach_first.assign(keys.size() + 1, 0);
  for (std::size_t i = 0; i < tiling.tiles.size(); ++i) {
    Tile<Dim>& t = tiling.tiles[i];
    for (int n = 0; n < kNeighbours<Dim>; ++n) {
      const auto at = std::lower_bound(keys.begin(), keys.end(), pack<Dim>(neighbour(t.block, n)));
      t.around[n] = static_cast<std::int32_t>(at - keys.begin());
    }
    for (const std::int32_t block : t.around) ++tiling.reach_first[block + 1];
  }
  for (std::size_t b = 0; b < keys.size(); ++b) tiling.reach_first[b + 1] += tiling.reach_first[b];
  tiling.reach.resize(tiling.tiles.size() * kNeighbours<Dim>);
  std::vector<std::int32_t> next(tiling.reach_first.begin(), tiling.reach_first.end() - 1);
  for (std::size_t i = 0; i < tiling.tiles.size(); ++i)
    for (int n = 0; n < kNeighbours<Dim>; ++n)
      tiling.reach[next[tiling.tiles[i].around[n]]++] = {static_cast<std::int32_t>(i), n};
}

namespace {

/// A point so far that no number is left for its block.
template <int Dim>
[[noreturn]] void refuse_escape(const Points<Dim>& p, std::size_t q) {
  double x = 0.0;
  for (int d = 0; d < Dim; ++d)
    if (!(std::abs(p.x[d][q]) <= std::abs(x))) x = p.x[d][q];
  throw NumericsError(
      fmt::format("particle {} (counted from 0 in order of id) has left for {:.3g} m (farther than "
                  "the grid can number) check its stress, its velocity and the strength of its "
                  "material",
                  p.index[q], x));
}

/// Key of each point's block, its cell within it, and the keys there are; returns the number of
/// materials.
template <int Dim>
std::int32_t find_blocks(const Points<Dim>& p, const Grid<Dim>& grid, double basis_shift,
                         BinningScratch& scratch) {
  constexpr int B = kBlockWidth<Dim>;
  const std::size_t n = p.size();
  scratch.key.resize(n);
  scratch.place.resize(n);
  const double inverse = 1.0 / grid.h;
  constexpr std::int64_t kEscaped = -1;
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(scratch.copy.size()))
  for (std::size_t i = 0; i < n; ++i) {
    Coordinate<Dim> block{};
    std::int64_t cell = 0;
    bool escaped = false;
    for (int d = Dim - 1; d >= 0; --d) {
      const double base = std::floor((p.x[d][i] - grid.origin[d]) * inverse - basis_shift);
      escaped = escaped || !(std::abs(base) < kFarthest * B);
      if (escaped) break;
      block[d] = static_cast<std::int32_t>(std::floor(base / B));
      cell = cell * B + (static_cast<std::int32_t>(base) - block[d] * B);
    }
    scratch.key[i] = escaped ? kEscaped : pack<Dim>(block);
    scratch.place[i] = cell;
  }
  std::int32_t materials = 1;
  scratch.blocks.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (scratch.key[i] == kEscaped) refuse_escape(p, i);
    materials = std::max(materials, p.material[i] + 1);
    if (i == 0 || scratch.key[i] != scratch.key[i - 1]) scratch.blocks.push_back(scratch.key[i]);
  }
  std::sort(scratch.blocks.begin(), scratch.blocks.end());
  scratch.blocks.erase(std::unique(scratch.blocks.begin(), scratch.blocks.end()),
                       scratch.blocks.end());
  return materials;
}

/// Order of the points by block, material and cell.
template <int Dim>
void find_order(const Points<Dim>& p, std::int32_t materials, BinningScratch& scratch) {
  constexpr int B = kBlockWidth<Dim>;
  std::int64_t tile = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i == 0 || scratch.key[i] != scratch.key[i - 1])
      tile = std::lower_bound(scratch.blocks.begin(), scratch.blocks.end(), scratch.key[i]) -
             scratch.blocks.begin();
    scratch.place[i] += power<Dim>(B) * (tile * materials + p.material[i]);
  }
  sort_by_place(scratch, power<Dim>(B) * materials * std::int64_t(scratch.blocks.size()));
}

/// Brings all arrays into that order.
template <int Dim>
void permute_points(Points<Dim>& p, BinningScratch& scratch) {
  std::vector<StaggeredArray<double>*> reals;
  std::vector<std::vector<std::int32_t>*> integers;
  visit_arrays(p, [&](auto& array) {
    if constexpr (std::is_same_v<std::decay_t<decltype(array)>, StaggeredArray<double>>)
      reals.push_back(&array);
    else
      integers.push_back(&array);
  });
  const auto arrays = static_cast<int>(reals.size() + integers.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(static_cast <int>(scratch.copy.size()))
  for (int i = 0; i < arrays; ++i) {
    BinningScratch::Copy& copy = scratch.copy[omp_get_thread_num()];
    const auto k = static_cast<std::size_t>(i);
    if (k < reals.size())
      permute(*reals[k], scratch.order, copy.real);
    else
      permute(*integers[k - reals.size()], scratch.order, copy.integer);
  }
}

/// Tiles and their runs of one material, from the points in order.
template <int Dim>
void list_tiles(const Points<Dim>& p, const BinningScratch& scratch, Tiling<Dim>& tiling) {
  tiling.tiles.clear();
  tiling.runs.clear();
  tiling.run_first.clear();
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::int32_t>(i);
    const std::int64_t key = scratch.key[scratch.order[i]];
    const bool new_tile = i == 0 || key != scratch.key[scratch.order[i - 1]];
    if (new_tile) {
      if (!tiling.tiles.empty()) tiling.tiles.back().last = at;
      tiling.tiles.push_back({unpack<Dim>(key), at, at, {}});
      tiling.run_first.push_back(static_cast<std::int32_t>(tiling.runs.size()));
    }
    if (new_tile || p.material[i] != p.material[i - 1]) {
      if (!tiling.runs.empty()) tiling.runs.back().last = at;
      tiling.runs.push_back({at, at, p.material[i]});
    }
  }
  if (n > 0) {
    tiling.tiles.back().last = static_cast<std::int32_t>(n);
    tiling.runs.back().last = static_cast<std::int32_t>(n);
  }
  tiling.run_first.push_back(static_cast<std::int32_t>(tiling.runs.size()));
}

}  // namespace

template <int Dim>
void bin_points(Points<Dim>& p, Grid<Dim>& grid, Tiling<Dim>& tiling, double basis_shift,
                BinningScratch& scratch) {
  const std::int32_t materials = find_blocks(p, grid, basis_shift, scratch);
  find_order(p, materials, scratch);
  permute_points(p, scratch);
  list_tiles(p, scratch, tiling);
  link_tiles(grid, tiling);
}

template void link_tiles<2>(Grid<2>&, Tiling<2>&);
template void link_tiles<3>(Grid<3>&, Tiling<3>&);
template void bin_points<2>(Points<2>&, Grid<2>&, Tiling<2>&, double, BinningScratch&);
template void bin_points<3>(Points<3>&, Grid<3>&, Tiling<3>&, double, BinningScratch&);

}  // namespace flowslide::mpm
