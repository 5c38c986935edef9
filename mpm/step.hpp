#pragma once
#include "mpm/p2g.hpp"
#include "mpm/remap.hpp"
#include "mpm/simulation.hpp"

#include <cstring>

#include <omp.h>

/// One step for a choice of basis; included by the files that instantiate it.
namespace flowslide::mpm {

template <int Dim>
std::span<const MaterialRun> runs_of(const Tiling<Dim>& tiling, std::int32_t tile) noexcept {
  return {tiling.runs.data() + tiling.run_first[tile],
          static_cast<std::size_t>(tiling.run_first[tile + 1] - tiling.run_first[tile])};
}

/// Mass, momentum and force of all points; call inside a parallel region.
template <int Dim, class Basis>
void scatter_all(const Simulation<Dim>& s, Node* nodes, TileScratch<Dim>& mine) {
  scatter_coloured(s.tiling, [&](std::int32_t i) {
    const Tile<Dim>& tile = s.tiling.tiles[i];
    find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
    average_over_spans<Dim>(
        s.points, tile, runs_of(s.tiling, i), mine.average,
        [&](const MaterialRun& run) { return s.averages(run.material); },
        [&](std::int32_t k, int count) {
          const auto& sigma = s.points.sigma;
          const std::int32_t q = tile.first + k;
          return (load_pack(sigma[0].data() + q, count) + load_pack(sigma[1].data() + q, count) +
                  load_pack(sigma[2].data() + q, count)) /
                 3.0;
        });
    scatter_tile<Dim, Basis, Scatter::force>(s.points, tile, mine.average.change.data(), nullptr,
                                             s.grid, nodes);
  });
}

template <int Dim, class Basis>
void gather_points(Simulation<Dim>& s, const Tile<Dim>& tile, double keep,
                   std::array<std::vector<double>, Dim>& moved, TileScratch<Dim>& mine) {
  const auto gather = [&]<Transfer kTransfer>(std::integral_constant<Transfer, kTransfer>) {
    gather_tile<Dim, Basis, kTransfer>(s.points, tile, s.grid, s.dt, keep, moved, mine);
  };
  switch (s.settings.transfer) {
    case Transfer::apic:
      return gather(std::integral_constant<Transfer, Transfer::apic>{});
    case Transfer::tpic:
      return gather(std::integral_constant<Transfer, Transfer::tpic>{});
    case Transfer::aflip:
      return gather(std::integral_constant<Transfer, Transfer::aflip>{});
    case Transfer::flip:
      return gather(std::integral_constant<Transfer, Transfer::flip>{});
    case Transfer::pic:
    case Transfer::fmpm:
      return gather(std::integral_constant<Transfer, Transfer::pic>{});
  }
}

template <int Dim, class Basis>
void step(Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  const double dt = s.dt;
  const auto tiles = static_cast<std::int32_t>(s.tiling.tiles.size());
  const auto blocks = static_cast<std::int32_t>(s.grid.blocks.size());
  const MomentumSettings momentum{dt, s.settings.gravity, s.settings.cundall};
  const double keep = s.settings.transfer == Transfer::flip ? s.settings.flip_share
                                                            : std::exp(-dt / s.settings.relaxation);
  const Update update = s.settings.update;
  // With musl positions stay until the new velocities have been mapped back.
  auto& moved = update == Update::musl ? scratch.moved : s.points.x;
  const int threads = static_cast<int>(scratch.tile.size());

#pragma omp parallel num_threads(threads)
  {
    TileScratch<Dim>& mine = scratch.tile[omp_get_thread_num()];
    const auto strain = [&](std::int32_t i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      scratch.stress_work[i] = update_stress<Dim>(s.points, tile, runs_of(s.tiling, i), s.materials,
                                                  dt, mine, s.settings.average_volume);
    };
    const auto strain_from_points = [&] {
      map_velocities<Dim, Basis>(s, scratch.second);
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t i = 0; i < tiles; ++i) {
        const Tile<Dim>& tile = s.tiling.tiles[i];
        find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
        gather_gradient<Dim, Basis>(s.points, tile, s.grid, scratch.second.data(), mine);
        strain(i);
      }
    };
    if (update == Update::usf) strain_from_points();
    clear_nodes<Dim>(s.grid.nodes, blocks);
    scatter_all<Dim, Basis>(s, s.grid.nodes.data(), mine);
#pragma omp for schedule(dynamic, 8)
    for (std::int32_t b = 0; b < blocks; ++b)
      scratch.grid_work[b] = update_momentum<Dim>(s.grid, b, momentum, s.full_mass);
#pragma omp single
    scratch.contact_work = hold_at_walls(s.grid, s.contact, momentum, s.full_mass);
    if (s.settings.transfer == Transfer::fmpm)
      approach_full_mass<Dim, Basis>(s, scratch.second, scratch.third, scratch.contact_work, mine);
#pragma omp for schedule(dynamic, 1)
    for (std::int32_t i = 0; i < tiles; ++i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      if (update == Update::symplectic)
        find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
      gather_points<Dim, Basis>(s, tile, keep, moved, mine);
      if (update == Update::symplectic) strain(i);
    }
    if (update == Update::musl) strain_from_points();
  }
  if (update == Update::musl) s.points.x.swap(scratch.moved);
}

}  // namespace flowslide::mpm
