#include "mpm/solver/sleep.hpp"

#include <cmath>

namespace flowslide::mpm {
namespace {

/// Notes which points have left the place where they were last seen to move.
template <int Dim>
void follow(double now, const Points<Dim>& p, Sleep<Dim>& sleep) {
  const double far = sleep.speed * sleep.after;
  for (std::size_t q = 0; q < p.size(); ++q) {
    const std::int32_t i = p.index[q];
    double moved2 = 0.0;
    for (int d = 0; d < Dim; ++d)
      moved2 += (p.x[d][q] - sleep.place[d][i]) * (p.x[d][q] - sleep.place[d][i]);
    if (moved2 < far * far) continue;
    for (int d = 0; d < Dim; ++d) sleep.place[d][i] = p.x[d][q];
    sleep.since[i] = now;
  }
}

}  // namespace

template <int Dim>
SleepChange<Dim> look_for_sleep(double now, const std::vector<std::int32_t>& restless,
                                const Grid<Dim>& grid, const Tiling<Dim>& tiling, Points<Dim>& p,
                                Sleep<Dim>& sleep) {
  if (sleep.since.empty()) {
    for (auto& x : sleep.place) x.resize(p.size());
    sleep.since.assign(p.size(), now);
    sleep.asleep.assign(p.size(), 0);
    for (std::size_t q = 0; q < p.size(); ++q)
      for (int d = 0; d < Dim; ++d) sleep.place[d][p.index[q]] = p.x[d][q];
  }
  follow(now, p, sleep);
  for (const std::int32_t i : restless) sleep.since[i] = now;

  std::vector<std::int32_t> moving(grid.blocks.size(), 0);  // per block: a tile that is not quiet
  constexpr int own = (kNeighbours<Dim> - 1) / 2;
  for (const Tile<Dim>& tile : tiling.tiles)
    for (std::int32_t q = tile.first; q < tile.last; ++q)
      if (!(now - sleep.since[p.index[q]] >= sleep.after)) moving[tile.around[own]] = 1;
  SleepChange<Dim> change;
  sleep.count = 0;
  for (const Tile<Dim>& tile : tiling.tiles) {
    bool quiet = true;
    for (const std::int32_t block : tile.around) quiet = quiet && moving[block] == 0;
    for (std::int32_t q = tile.first; q < tile.last; ++q) {
      std::int32_t& asleep = sleep.asleep[p.index[q]];
      change.woken = change.woken || (asleep != 0 && !quiet);
      if (quiet && asleep == 0) {
        for (int d = 0; d < Dim; ++d) {
          change.impulse[d] -= p.mass[q] * p.v[d][q];
          p.v[d][q] = 0.0;
        }
        for (auto& c : p.c) c[q] = 0.0;
      }
      asleep = quiet ? 1 : 0;
    }
    if (quiet) sleep.count += tile.last - tile.first;
  }
  sleep.next_look = now + 0.5 * sleep.after;
  return change;
}

template SleepChange<2> look_for_sleep<2>(double, const std::vector<std::int32_t>&, const Grid<2>&,
                                          const Tiling<2>&, Points<2>&, Sleep<2>&);
template SleepChange<3> look_for_sleep<3>(double, const std::vector<std::int32_t>&, const Grid<3>&,
                                          const Tiling<3>&, Points<3>&, Sleep<3>&);

}  // namespace flowslide::mpm
