#include "mpm/binning.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

template <class T>
void permute(std::vector<T>& a, const std::vector<std::int32_t>& order, std::vector<T>& scratch) {
  scratch.resize(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) scratch[i] = a[order[i]];
  a.swap(scratch);
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

  grid.blocks.clear();
  for (const std::int64_t key : keys) grid.blocks.push_back(unpack<Dim>(key));
  grid.nodes.resize(keys.size() * kBlockNodes<Dim>);
  for (auto& list : tiling.colour) list.clear();
  for (std::size_t i = 0; i < tiling.tiles.size(); ++i) {
    Tile<Dim>& t = tiling.tiles[i];
    for (int n = 0; n < kNeighbours<Dim>; ++n) {
      const auto at = std::lower_bound(keys.begin(), keys.end(), pack<Dim>(neighbour(t.block, n)));
      t.around[n] = static_cast<std::int32_t>(at - keys.begin());
    }
    int colour = 0;
    for (int d = 0; d < Dim; ++d) colour |= (t.block[d] & 1) << d;
    tiling.colour[colour].push_back(static_cast<std::int32_t>(i));
  }
}

template <int Dim>
void bin_points(Points<Dim>& p, Grid<Dim>& grid, Tiling<Dim>& tiling, double basis_shift,
                BinningScratch& scratch) {
  const std::size_t n = p.size();
  scratch.key.resize(n);
  scratch.order.resize(n);
  const double inverse = 1.0 / grid.h;
  for (std::size_t i = 0; i < n; ++i) {
    Coordinate<Dim> block{};
    for (int d = 0; d < Dim; ++d) {
      const double base = std::floor((p.x[d][i] - grid.origin[d]) * inverse - basis_shift);
      if (!(std::abs(base) < kFarthest * kBlockWidth<Dim>)) {
        throw NumericsError(
            fmt::format("particle {} (counted from 0 in order of id) has left for {:.3g} m "
                        "(farther than the grid can "
                        "number) check its stress, its velocity and the strength of its material",
                        p.index[i], p.x[d][i]));
      }
      block[d] = static_cast<std::int32_t>(std::floor(base / kBlockWidth<Dim>));
    }
    scratch.key[i] = pack<Dim>(block);
  }
  std::iota(scratch.order.begin(), scratch.order.end(), 0);
  std::sort(scratch.order.begin(), scratch.order.end(), [&](std::int32_t a, std::int32_t b) {
    if (scratch.key[a] != scratch.key[b]) return scratch.key[a] < scratch.key[b];
    if (p.material[a] != p.material[b]) return p.material[a] < p.material[b];
    return a < b;
  });
  visit_arrays(p, [&](auto& array) {
    if constexpr (std::is_same_v<std::decay_t<decltype(array)>, std::vector<double>>)
      permute(array, scratch.order, scratch.real);
    else
      permute(array, scratch.order, scratch.integer);
  });

  tiling.tiles.clear();
  tiling.runs.clear();
  tiling.run_first.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::int32_t>(i);
    const bool new_tile =
        i == 0 || scratch.key[scratch.order[i]] != scratch.key[scratch.order[i - 1]];
    if (new_tile) {
      if (!tiling.tiles.empty()) tiling.tiles.back().last = at;
      tiling.tiles.push_back({unpack<Dim>(scratch.key[scratch.order[i]]), at, at, {}});
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
  link_tiles(grid, tiling);
}

template void link_tiles<2>(Grid<2>&, Tiling<2>&);
template void link_tiles<3>(Grid<3>&, Tiling<3>&);
template void bin_points<2>(Points<2>&, Grid<2>&, Tiling<2>&, double, BinningScratch&);
template void bin_points<3>(Points<3>&, Grid<3>&, Tiling<3>&, double, BinningScratch&);

}  // namespace flowslide::mpm
