#include "mpm/simulation.hpp"

#include "mpm/p2g.hpp"

#include <cstring>

#include <omp.h>

namespace flowslide::mpm {

template <int Dim, class Basis>
double stable_step(const Simulation<Dim>& s) {
  const double h = s.grid.h;
  const double elastic =
      2.0 * h / std::sqrt(Dim * Basis::affine_bound * s.last.max_wave2) * s.settings.courant;
  const double speed = std::sqrt(s.last.max_speed2);
  const double advective = s.settings.velocity_limit * h / std::max(speed, 1e-300);
  // The rate of the last step stands for this one.
  const double straining =
      s.dt > 0.0 ? s.settings.strain_limit * s.dt / std::max(s.last.max_strain, 1e-300) : elastic;
  return std::min({elastic, advective, straining});
}

template <int Dim, class Basis>
void prepare(Simulation<Dim>& s, StepScratch<Dim>& scratch, bool rebin) {
  if (rebin) {
    const double shift = -Basis::base(0.0) - 0.5 > 0.0 ? 0.5 : 0.0;
    bin_points<Dim>(s.points, s.grid, s.tiling, shift, scratch.binning);
    s.drift = 0.0;
  } else {
    link_tiles<Dim>(s.grid, s.tiling);
  }
  list_boundary_nodes<Dim>(s.grid, s.ground, s.rollers);
  std::size_t most = 0;
  for (const Tile<Dim>& t : s.tiling.tiles) most = std::max<std::size_t>(most, t.last - t.first);
  const std::size_t spans = power<Dim>(kBlockWidth<Dim> + 2);
  for (auto& t : scratch.tile) {
    for (auto& g : t.gradient) g.resize(most);
    t.average.span.resize(most);
    t.average.change.resize(most);
    t.average.sum.resize(spans);
    t.average.weight.resize(spans);
  }
  scratch.stress_work.resize(s.tiling.tiles.size());
  scratch.grid_work.resize(s.grid.blocks.size());
}

template <int Dim, class Basis, Transfer kTransfer>
void advance(Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  if (s.drift > 0.95 * s.grid.h) prepare<Dim, Basis>(s, scratch, true);
  s.dt = stable_step<Dim, Basis>(s);
  const double dt = s.dt;
  const auto tiles = static_cast<std::int32_t>(s.tiling.tiles.size());
  const auto blocks = static_cast<std::int32_t>(s.grid.blocks.size());
  const MomentumSettings momentum{dt, s.settings.gravity, s.settings.cundall};
  const double keep = std::exp(-dt / s.settings.relaxation);
  const int threads = static_cast<int>(scratch.tile.size());

#pragma omp parallel num_threads(threads)
  {
    TileScratch<Dim>& mine = scratch.tile[omp_get_thread_num()];
    const auto runs_of = [&](std::int32_t i) {
      return std::span<const MaterialRun>(s.tiling.runs.data() + s.tiling.run_first[i],
                                          s.tiling.run_first[i + 1] - s.tiling.run_first[i]);
    };
#pragma omp for schedule(static)
    for (std::int32_t b = 0; b < blocks; ++b)
      std::memset(static_cast<void*>(s.grid.nodes.data() + std::size_t(b) * kBlockNodes<Dim>), 0,
                  sizeof(Node) * kBlockNodes<Dim>);
    for (const auto& colour : s.tiling.colour) {
      const auto count = static_cast<std::int32_t>(colour.size());
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t i = 0; i < count; ++i) {
        const Tile<Dim>& tile = s.tiling.tiles[colour[i]];
        find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
        average_over_spans<Dim>(
            s.points, tile, runs_of(colour[i]), mine.average,
            [&](const MaterialRun& run) { return s.averages(run.material); },
            [&](std::int32_t k) {
              const auto& sigma = s.points.sigma;
              const std::int32_t q = tile.first + k;
              return (sigma[0][q] + sigma[1][q] + sigma[2][q]) / 3.0;
            });
        scatter_tile<Dim, Basis>(s.points, tile, mine.average.change.data(), s.grid);
      }
    }
#pragma omp for schedule(dynamic, 8)
    for (std::int32_t b = 0; b < blocks; ++b)
      scratch.grid_work[b] = update_momentum<Dim>(s.grid, b, momentum, s.full_mass);
#pragma omp for schedule(dynamic, 1)
    for (std::int32_t i = 0; i < tiles; ++i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
      gather_tile<Dim, Basis, kTransfer>(s.points, tile, s.grid, dt, keep, mine);
      scratch.stress_work[i] = update_stress<Dim>(s.points, tile, runs_of(i), s.materials, dt, mine,
                                                  s.settings.average_volume);
    }
  }

  // Serial sums in a fixed order: the same bits for any number of threads.
  StressWork stress;
  for (const StressWork& w : scratch.stress_work) stress.add(w);
  for (const GridWork<Dim>& w : scratch.grid_work) s.balance.grid.add(w);
  s.balance.power_start += stress.power_start;
  s.balance.power_end += stress.power_end;
  s.last = stress;
  s.drift += std::sqrt(stress.max_speed2) * dt;
  s.time += dt;
  ++s.step;
}

#define FLOWSLIDE_INSTANTIATE(DIM, BASIS)                                                  \
  template double stable_step<DIM, BASIS>(const Simulation<DIM>&);                         \
  template void prepare<DIM, BASIS>(Simulation<DIM>&, StepScratch<DIM>&, bool);            \
  template void advance<DIM, BASIS, Transfer::aflip>(Simulation<DIM>&, StepScratch<DIM>&); \
  template void advance<DIM, BASIS, Transfer::apic>(Simulation<DIM>&, StepScratch<DIM>&);  \
  template void advance<DIM, BASIS, Transfer::tpic>(Simulation<DIM>&, StepScratch<DIM>&);
FLOWSLIDE_INSTANTIATE(2, QuadraticBSpline)
#undef FLOWSLIDE_INSTANTIATE

}  // namespace flowslide::mpm
