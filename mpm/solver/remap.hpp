#pragma once
#include "mpm/grid/take_turns.hpp"
#include "mpm/kernels/g2p.hpp"
#include "mpm/kernels/p2g.hpp"
#include "mpm/solver/simulation.hpp"

/// Sweeps over the grid beside the plain step: velocities of the points mapped to a second set of
/// nodes (usf, musl), and the series of the full mass matrix (fmpm). All are called by every thread
/// of a parallel region and end with a barrier.
namespace flowslide::mpm {

template <int Dim, class Basis>
NodeVector* window_of(StepScratch<Dim>& scratch, std::int32_t tile) noexcept {
  return reinterpret_cast<NodeVector*>(scratch.windows.data() +
                                       std::size_t(tile) * kWindowNodes<Dim, Basis>);
}

/// Velocities of the points as `nodes` see them, boundary conditions included.
template <int Dim, class Basis>
void map_velocities(Simulation<Dim>& s, StepScratch<Dim>& scratch, int thread) {
  using L = NodeLayout<Dim>;
  const auto blocks = static_cast<std::int32_t>(s.grid.blocks.size());
  StaggeredArray<Node>& nodes = scratch.second;
  take_turns(scratch.groups, thread, [&](std::int32_t i) {
    scatter_tile<Dim, Basis, Scatter::momentum>(s.points, s.tiling.tiles[i], nullptr, nullptr,
                                                s.grid, window_of<Dim, Basis>(scratch, i));
  });
  const double floor = kMassFloor * s.full_mass;
#pragma omp for schedule(static)
  for (std::int32_t b = 0; b < blocks; ++b) {
    sum_windows<Dim, Basis>(s.tiling, scratch.windows.data(), b, nodes.data());
    Node* block = nodes.data() + std::size_t(b) * kBlockNodes<Dim>;
    for (int n = 0; n < kBlockNodes<Dim>; ++n) {
      const double inverse = block[n].q[L::mass] > floor ? 1.0 / block[n].q[L::mass] : 0.0;
      for (int d = 0; d < Dim; ++d) block[n].q[L::momentum + d] *= inverse;
    }
  }
#pragma omp single
  {
    push_out(nodes, s.contact, s.full_mass, Hold::contact);
    for (std::size_t k = 0; k < s.contact.nodes.size(); ++k)
      for (int d = 0; d < Dim; ++d)
        nodes[s.contact.nodes[k]].q[L::momentum + d] = s.contact.velocity[k][d];
  }
}

/// Corrects the velocities in `nodes` at the walls; the impulses count in `work`.
template <int Dim>
void keep_to_walls(StaggeredArray<Node>& nodes, Simulation<Dim>& s, Hold hold,
                   GridWork<Dim>& work) {
  using L = NodeLayout<Dim>;
  push_out(nodes, s.contact, s.full_mass, hold);
  for (std::size_t k = 0; k < s.contact.nodes.size(); ++k) {
    auto& q = nodes[s.contact.nodes[k]].q;
    for (int d = 0; d < Dim; ++d) {
      work.boundary_impulse[d] += q[L::mass] * (s.contact.velocity[k][d] - q[L::momentum + d]);
      q[L::momentum + d] = s.contact.velocity[k][d];
    }
  }
}

/// Turns the velocities of grid.nodes, found with the lumped mass m, into
/// v^(k) = sum_{j<k} (Q (I - P))^j v with P v = m^-1 sum_p w m_p sum w v (Nairn & Hammerquist 2021)
/// and Q the walls: every term keeps to them by itself. docs/theory/mpm.md
template <int Dim, class Basis>
void approach_full_mass(Simulation<Dim>& s, StepScratch<Dim>& scratch, int thread) {
  using L = NodeLayout<Dim>;
  const auto blocks = static_cast<std::int32_t>(s.grid.blocks.size());
  StaggeredArray<Node>&rest = scratch.second, &mapped = scratch.third;
  TileScratch<Dim>& mine = scratch.tile[thread];
  const double floor = kMassFloor * s.full_mass;
#pragma omp for schedule(static)
  for (std::int32_t b = 0; b < blocks * kBlockNodes<Dim>; ++b) rest[b] = s.grid.nodes[b];
  for (int term = 1; term < s.settings.fmpm_order; ++term) {
    take_turns(scratch.groups, thread, [&](std::int32_t i) {
      const Tile<Dim>& tile = s.tiling.tiles[i];
      interpolate_tile<Dim, Basis>(s.points, tile, s.grid, rest.data(), mine);
      scatter_tile<Dim, Basis, Scatter::velocity>(s.points, tile, nullptr, &mine.velocity, s.grid,
                                                  window_of<Dim, Basis>(scratch, i));
    });
#pragma omp for schedule(static)
    for (std::int32_t b = 0; b < blocks; ++b) {
      sum_windows<Dim, Basis>(s.tiling, scratch.windows.data(), b, mapped.data());
      const std::size_t first = std::size_t(b) * kBlockNodes<Dim>;
      for (std::size_t n = first; n < first + kBlockNodes<Dim>; ++n) {
        const double m = s.grid.nodes[n].q[L::mass];
        const double inverse = m > floor ? 1.0 / m : 0.0;
        for (int d = 0; d < Dim; ++d) {
          double& r = rest[n].q[L::momentum + d];
          r = m > floor ? r - mapped[n].q[L::momentum + d] * inverse : 0.0;
        }
      }
    }
#pragma omp single
    keep_to_walls(rest, s, Hold::fast, scratch.contact_work);
#pragma omp for schedule(static)
    for (std::int32_t b = 0; b < blocks * kBlockNodes<Dim>; ++b)
      for (int d = 0; d < Dim; ++d)
        s.grid.nodes[b].q[L::momentum + d] += rest[b].q[L::momentum + d];
  }
#pragma omp single
  keep_to_walls(s.grid.nodes, s, Hold::slip, scratch.contact_work);
}

}  // namespace flowslide::mpm
