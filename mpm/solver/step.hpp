#pragma once
#include "core/elementary.hpp"
#include "mpm/kernels/p2g.hpp"
#include "mpm/solver/hold_asleep.hpp"
#include "mpm/solver/remap.hpp"
#include "mpm/solver/simulation.hpp"
#include "mpm/solver/way.hpp"

#include <cstring>

#include <omp.h>

/// One step for a choice of basis; included by the files that instantiate it.
namespace flowslide::mpm {

template <int Dim>
std::span<const MaterialRun> runs_of(const Tiling<Dim>& tiling, std::int32_t tile) noexcept {
  return {tiling.runs.data() + tiling.run_first[tile],
          static_cast<std::size_t>(tiling.run_first[tile + 1] - tiling.run_first[tile])};
}

/// Mass, momentum and force of a tile's points into its window.
template <int Dim, class Basis>
void scatter_points(const Simulation<Dim>& s, std::int32_t i, StepScratch<Dim>& scratch,
                    TileScratch<Dim>& mine) {
  const Tile<Dim>& tile = s.tiling.tiles[i];
  mine.average.span = scratch.span.data() + tile.first;
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
                                           s.grid, window_of<Dim, Basis>(scratch, i));
}

/// Tractions into the windows of the tiles their points are in.
template <int Dim, class Basis>
void add_loads(const Simulation<Dim>& s, StepScratch<Dim>& scratch) noexcept {
  if constexpr (Dim == 2) {
    constexpr int N = Basis::nodes, W = kLocalWidth<Dim, Basis>;
    const double h = s.grid.h, now = s.time + 0.5 * s.dt;
    for (const Load<Dim>& load : s.loads) {
      const double share = std::clamp((now - load.begin) / load.ramp, 0.0, 1.0);
      if (load.point < 0 || share == 0.0) continue;
      const Tile<Dim>& tile = s.tiling.tiles[load.tile];
      double w[Dim][N], g[Dim][N];
      int first[Dim];
      for (int d = 0; d < Dim; ++d) {
        const double x = (s.points.x[d][load.point] - s.grid.origin[d]) / h;
        const double base = base_node<Basis>(x);
        Basis::evaluate(x - base, w[d], g[d]);
        first[d] = static_cast<int>(base) - (tile.block[d] * kBlockWidth<Dim> - 1);
      }
      NodeVector* window = window_of<Dim, Basis>(scratch, load.tile);
      for (int j = 0; j < N; ++j) {
        for (int i = 0; i < N; ++i) {
          NodeVector& node = window[first[0] + i + W * (first[1] + j)];
          const double weight = w[0][i] * w[1][j];
          const double along =
              (load.normal[0] * g[0][i] * w[1][j] + load.normal[1] * w[0][i] * g[1][j]) / h;
          for (int d = 0; d < Dim; ++d)
            node[NodeLayout<Dim>::load + d] +=
                share * load.force[d] * (weight + load.above * along);
        }
      }
    }
  }
}

template <int Dim, class Basis>
void gather_points(Simulation<Dim>& s, const Tile<Dim>& tile, double keep,
                   std::array<StaggeredArray<double>, Dim>& moved, TileScratch<Dim>& mine) {
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

/// The phases of a step, each called by every thread of a parallel region.
template <int Dim, class Basis>
struct Phases {
  Simulation<Dim>& s;
  StepScratch<Dim>& scratch;
  const double dt = s.dt;
  const Update update = s.settings.update;
  const MomentumSettings momentum{dt, s.gravity, s.settings.damping, scratch.light};
  /// Share of its own velocity that a point keeps with aflip and flip.
  const double keep = s.settings.transfer == Transfer::flip ? s.settings.flip_share
                                                            : exp(-dt / s.settings.relaxation);
  // Only with symplectic updates: their windows keep what the points gave.
  const bool sleepers = !scratch.asleep.tiles.empty();

  void strain(std::int32_t tile, TileScratch<Dim>& mine) {
    scratch.stress_work[tile] =
        update_stress<Dim>(s.points, s.tiling.tiles[tile], runs_of(s.tiling, tile), s.materials, dt,
                           mine, s.settings.volume_average == VolumeAverage::automatic);
  }

  /// Strains of usf and musl, from velocities that the points map to the grid.
  void strain_from_points(int thread) {
    TileScratch<Dim>& mine = scratch.tile[thread];
    map_velocities<Dim, Basis>(s, scratch, thread);
    take_turns(scratch.groups, thread, [&](std::int32_t i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      mine.average.span = scratch.span.data() + tile.first;
      find_spans<Dim, Basis>(s.points, tile, s.grid, mine.average);
      gather_gradient<Dim, Basis>(s.points, tile, s.grid, scratch.second.data(), mine);
      strain(i, mine);
    });
  }

  /// Mass, momentum and force of the points into the windows of their tiles, unless the last step
  /// has done so.
  void points_to_grid(int thread) {
    TileScratch<Dim>& mine = scratch.tile[thread];
    if (update == Update::usf) strain_from_points(thread);
    if (!scratch.scattered) {
      const auto scatter = [&](std::int32_t i) { scatter_points<Dim, Basis>(s, i, scratch, mine); };
      take_turns(scratch.groups, thread, scatter);
      if (sleepers) take_turns(scratch.asleep, thread, scatter);
    }
    if (!s.loads.empty()) {
#pragma omp single
      add_loads<Dim, Basis>(s, scratch);
    }
  }

  /// The windows' sums on the nodes, and the momentum balance there.
  void balance_momentum(int thread) {
    const bool loaded = !s.loads.empty();
    const auto blocks = static_cast<std::int32_t>(s.grid.blocks.size());
    const std::uint64_t* at_walls = s.contact.in_block.data();
    double most2 = 0.0;
#pragma omp for schedule(static) nowait
    for (std::int32_t b = 0; b < blocks; ++b) {
      sum_windows<Dim, Basis>(s.tiling, scratch.windows.data(), b, s.grid.nodes.data());
      double gain2 = 0.0;
      scratch.grid_work[b] =
          loaded
              ? update_momentum<Dim, true>(s.grid, b, momentum, at_walls[b], s.full_mass, gain2)
              : update_momentum<Dim, false>(s.grid, b, momentum, at_walls[b], s.full_mass, gain2);
      scratch.gain2[b] = gain2;
      if (!(gain2 <= most2)) most2 = gain2;
    }
    scratch.tile[thread].gain2 = most2;
#pragma omp barrier
#pragma omp single
    measure_at_walls();
  }

  /// What the nodes at the walls gain, beside the others of their blocks.
  void measure_at_walls() noexcept {
    scratch.gain2_at_walls = 0.0;
    const auto raise = [](double& most, double gain2) {
      if (!(gain2 <= most)) most = gain2;
    };
    gains_at_walls(s, scratch.light, [&](std::int32_t node, double gain2) {
      raise(scratch.gain2_at_walls, gain2);
      raise(scratch.gain2[node / kBlockNodes<Dim>], gain2);
    });
  }

  /// One thread sees to the walls while the others begin with the tiles that do not touch them.
  void hold_soil(int thread) {
#pragma omp single nowait
    scratch.contact_work = hold_at_walls(s.grid, s.contact, momentum, s.full_mass);
    if (s.settings.transfer == Transfer::fmpm) {
#pragma omp barrier
      approach_full_mass<Dim, Basis>(s, scratch, thread);
    }
  }

  /// Grid to points; with the symplectic update stress and what the next step begins with, too.
  void grid_to_points(int thread) {
    TileScratch<Dim>& mine = scratch.tile[thread];
    // With musl positions stay until the new velocities have been mapped back.
    auto& moved = update == Update::musl ? scratch.moved : s.points.x;
    mine.outside = false;
    take_turns(scratch.groups, thread, [&](std::int32_t i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      gather_points<Dim, Basis>(s, tile, keep, moved, mine);
      const bool stays = in_window<Dim, Basis>(moved, tile, s.grid);
      mine.outside = mine.outside || !stays;
      if (update != Update::symplectic) return;
      // The spans are those of the positions before this step, found when they were scattered.
      mine.average.span = scratch.span.data() + tile.first;
      strain(i, mine);
      if (stays) scatter_points<Dim, Basis>(s, i, scratch, mine);
    });
    const bool keeps =
        s.settings.transfer == Transfer::flip || s.settings.transfer == Transfer::aflip;
    if (sleepers)
      take_turns(scratch.asleep, thread, [&](std::int32_t i) {
        scratch.stress_work[i] =
            hold_asleep<Dim, Basis>(s.tiling.tiles[i], window_of<Dim, Basis>(scratch, i), s.grid,
                                    momentum, keeps ? keep : 0.0, scratch.sleep_work[i]);
      });
    if (update == Update::musl) strain_from_points(thread);
  }

  /// What the velocities on the grid would do to the points near nodes that gain much.
  Way look_ahead() {
    scratch.ways.assign(s.tiling.tiles.size(), {});
#pragma omp parallel num_threads(static_cast <int>(scratch.tile.size()))
    {
      const int thread = omp_get_thread_num();
      TileScratch<Dim>& mine = scratch.tile[thread];
      hold_soil(thread);
#pragma omp barrier
      take_turns(scratch.groups, thread, [&](std::int32_t i) {
        const Tile<Dim>& tile = s.tiling.tiles[i];
        if (tile_gains_little(s, scratch, tile)) return;
        const Node* nodes = s.grid.nodes.data();
        interpolate_tile<Dim, Basis>(s.points, tile, s.grid, nodes, mine);
        gather_gradient<Dim, Basis>(s.points, tile, s.grid, nodes, mine);
        scratch.ways[i] = way_of(mine, tile.last - tile.first, dt, s.grid.h);
      });
    }
    Way most;
    for (const Way& way : scratch.ways) most = farther(most, way);
    return most;
  }
};

template <int Dim, class Basis>
double step(Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  Phases<Dim, Basis> phases{s, scratch};
  const auto threads = static_cast<int>(scratch.tile.size());
  bool doubtful = false;
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    phases.points_to_grid(thread);
    phases.balance_momentum(thread);
    if (gains_little(s, scratch)) {
      phases.hold_soil(thread);
      phases.grid_to_points(thread);
    } else if (thread == 0) {
      doubtful = true;
    }
  }
  if (doubtful) {
    const Absorbing<Dim> absorbing = s.contact.absorbing;
    const double share = allowed_share(s, phases.look_ahead());
    if (share != 1.0) {
      s.contact.absorbing = absorbing;
      scratch.scattered = false;
      return share;
    }
#pragma omp parallel num_threads(threads)
    phases.grid_to_points(omp_get_thread_num());
  }
  scratch.scattered = s.settings.update == Update::symplectic;
  if (s.settings.update == Update::musl) s.points.x.swap(scratch.moved);
  return 1.0;
}

}  // namespace flowslide::mpm
