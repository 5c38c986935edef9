#include "mpm/grid/binning.hpp"

#include "mpm/grid/local_grid.hpp"
#include "mpm/kernels/basis.hpp"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

namespace {

template <int Dim>
Points<Dim> random_points(int n, unsigned seed) {
  Points<Dim> p;
  visit_arrays(p, [&](auto& a) { a.assign(n, {}); });
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-40.0, 40.0);
  for (int q = 0; q < n; ++q) {
    for (int d = 0; d < Dim; ++d) p.x[d][q] = place(random);
    p.mass[q] = 1.0 + q;
    p.material[q] = static_cast<std::int32_t>(random() % 3);
    p.index[q] = q;
  }
  return p;
}

template <int Dim>
struct Binned {
  Points<Dim> p;
  Grid<Dim> grid;
  Tiling<Dim> tiling;
  explicit Binned(Points<Dim> points) : p(std::move(points)) {
    grid.h = 0.5;
    for (int d = 0; d < Dim; ++d) grid.origin[d] = 0.3 * d;
    BinningScratch scratch;
    bin_points<Dim>(p, grid, tiling, 0.5, scratch);
  }
};

template <int Dim>
int cell_of(const Binned<Dim>& b, const Tile<Dim>& tile, std::int32_t q) {
  int cell = 0;
  for (int d = Dim - 1; d >= 0; --d) {
    const double base = std::floor((b.p.x[d][q] - b.grid.origin[d]) / b.grid.h - 0.5);
    cell = cell * kBlockWidth<Dim> + static_cast<int>(base) - tile.block[d] * kBlockWidth<Dim>;
  }
  return cell;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Every point lies in its tile and in a run of its material", "[mpm]",
                       ((int Dim), Dim), 2, 3) {
  const Points<Dim> before = random_points<Dim>(3000, 1);
  const Binned<Dim> b(before);
  std::vector<int> seen(before.size(), 0);
  std::int32_t expected = 0;
  for (std::size_t t = 0; t < b.tiling.tiles.size(); ++t) {
    const Tile<Dim>& tile = b.tiling.tiles[t];
    REQUIRE(tile.first == expected);
    REQUIRE(tile.last > tile.first);
    expected = tile.last;
    std::int32_t in_run = tile.first;
    for (std::int32_t r = b.tiling.run_first[t]; r < b.tiling.run_first[t + 1]; ++r) {
      const MaterialRun& run = b.tiling.runs[r];
      REQUIRE(run.first == in_run);
      in_run = run.last;
      for (std::int32_t q = run.first; q < run.last; ++q) {
        REQUIRE(b.p.material[q] == run.material);
        const std::int32_t original = b.p.index[q];
        ++seen[original];
        REQUIRE(b.p.mass[q] == before.mass[original]);  // arrays move together
        if (q > run.first) {                            // by cell, ties as they were
          const int now = cell_of(b, tile, q), before_it = cell_of(b, tile, q - 1);
          REQUIRE(before_it <= now);
          if (before_it == now) REQUIRE(b.p.index[q - 1] < original);
        }
        for (int d = 0; d < Dim; ++d) {
          REQUIRE(b.p.x[d][q] == before.x[d][original]);
          const double base = std::floor((b.p.x[d][q] - b.grid.origin[d]) / b.grid.h - 0.5);
          REQUIRE(base >= tile.block[d] * kBlockWidth<Dim>);
          REQUIRE(base < (tile.block[d] + 1) * kBlockWidth<Dim>);
        }
      }
    }
    REQUIRE(in_run == tile.last);
    // Neighbours are where their place in `around` says, the tile's own block in the middle.
    for (int n = 0; n < kNeighbours<Dim>; ++n) {
      int rest = n;
      for (int d = 0; d < Dim; ++d, rest /= 3)
        REQUIRE(b.grid.blocks[tile.around[n]][d] == tile.block[d] + rest % 3 - 1);
    }
  }
  REQUIRE(expected == std::int32_t(before.size()));
  CHECK(std::all_of(seen.begin(), seen.end(), [](int k) { return k == 1; }));
  CHECK(b.grid.nodes.size() == b.grid.blocks.size() * kBlockNodes<Dim>);
}

TEMPLATE_TEST_CASE_SIG("Every block knows the tiles that reach into it", "[mpm]", ((int Dim), Dim),
                       2, 3) {
  const Binned<Dim> b(random_points<Dim>(3000, 2));
  REQUIRE(b.tiling.reach_first.size() == b.grid.blocks.size() + 1);
  CHECK(b.tiling.reach.size() == b.tiling.tiles.size() * kNeighbours<Dim>);
  for (std::size_t block = 0; block < b.grid.blocks.size(); ++block) {
    std::int32_t before = -1;
    for (std::int32_t r = b.tiling.reach_first[block]; r < b.tiling.reach_first[block + 1]; ++r) {
      const Reach reach = b.tiling.reach[r];
      REQUIRE(b.tiling.tiles[reach.tile].around[reach.place] == std::int32_t(block));
      REQUIRE(reach.tile > before);  // the order of summation, whatever the threads
      before = reach.tile;
    }
  }
}

TEMPLATE_TEST_CASE_SIG("Windows add up to what goes to the grid", "[mpm]", ((int Dim), Dim), 2, 3) {
  const Binned<Dim> b(random_points<Dim>(3000, 2));
  using Basis = QuadraticBSpline;
  constexpr int W = kLocalWidth<Dim, Basis>;
  // Windows with small whole numbers: sums are exact in any order.
  std::vector<Node> windows(b.tiling.tiles.size() * kWindowNodes<Dim, Basis>);
  for (std::size_t i = 0; i < windows.size(); ++i) windows[i].q.fill(double(i % 97));
  std::vector<double> expected(b.grid.nodes.size(), 0.0);
  for (std::size_t t = 0; t < b.tiling.tiles.size(); ++t)
    for_each_row<Dim, W>(b.tiling.tiles[t], [&](int from, std::int32_t block, int to, int count) {
      for (int i = 0; i < count; ++i)
        expected[std::size_t(block) * kBlockNodes<Dim> + to + i] +=
            windows[t * kWindowNodes<Dim, Basis> + from + i].q[0];
    });
  std::vector<Node> nodes(b.grid.nodes.size());
  for (std::size_t block = 0; block < b.grid.blocks.size(); ++block)
    sum_windows<Dim, Basis>(b.tiling, windows.data(), std::int32_t(block), nodes.data());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const double q : nodes[n].q) REQUIRE(q == expected[n]);
}

TEST_CASE("Binning twice is binning once", "[mpm]") {
  const Binned<2> once(random_points<2>(2000, 3));
  const Binned<2> twice(once.p);
  CHECK(once.p.index == twice.p.index);
  CHECK(once.tiling.run_first == twice.tiling.run_first);
}
