#pragma once
#include "mpm/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// Momentum balance on the grid: v* = (m v + dt (f + m b)) / m; contact.hpp then holds it at walls.
namespace flowslide::mpm {

/// What the grid did in one step; the sums close the balances of energy and momentum.
template <int Dim>
struct GridWork {
  double internal_start = 0.0;                 ///< dt sum f.v with velocities before the step [J]
  double internal_end = 0.0;                   ///< dt sum f.v* with velocities after it [J]
  double gravity = 0.0;                        ///< work of gravity [J]
  double load = 0.0;                           ///< work of tractions [J]
  double damping = 0.0;                        ///< work of artificial damping, <= 0 [J]
  double boundary = 0.0;                       ///< work of boundary impulses [J]
  double absorbed = 0.0;                       ///< of that, what left through absorbing planes [J]
  std::array<double, Dim> gravity_impulse{};   ///< [N s]
  std::array<double, Dim> load_impulse{};      ///< of tractions [N s]
  std::array<double, Dim> boundary_impulse{};  ///< impulse of boundaries and damping [N s]
  void add(const GridWork& o) {
    internal_start += o.internal_start;
    internal_end += o.internal_end;
    gravity += o.gravity;
    load += o.load;
    damping += o.damping;
    boundary += o.boundary;
    absorbed += o.absorbed;
    for (int d = 0; d < Dim; ++d) {
      gravity_impulse[d] += o.gravity_impulse[d];
      load_impulse[d] += o.load_impulse[d];
      boundary_impulse[d] += o.boundary_impulse[d];
    }
  }
};

struct MomentumSettings {
  double dt;                      ///< [s]
  std::array<double, 3> gravity;  ///< [m/s2]
  double cundall;                 ///< local non-viscous damping factor [-]
  double light = 0.0;             ///< mass up to which nodes hardly move points [kg]; way.hpp
};

/// Nodes lighter than this share of a full cell's mass carry no velocity: their quotient is noise,
/// and the points near them weigh them with w -> 0 anyway.
inline constexpr double kMassFloor = 1e-18;

/// Local non-viscous damping opposes the motion with a share of the force (Cundall 1987); what
/// rests it keeps from starting.
inline double damping_force(double factor, double force, double velocity) noexcept {
  if (factor == 0.0) return 0.0;
  return -factor * (velocity == 0.0 ? force : std::copysign(std::abs(force), velocity));
}

/// Force of tractions on a node [N].
template <int Dim>
double load_on(const std::array<double, 8>& q, int d) noexcept {
  if constexpr (NodeLayout<Dim>::load > 0)
    return q[NodeLayout<Dim>::load + d];
  else
    return 0.0;
}

/// Velocities of a block's nodes after the step, and their change in place of the force. Without
/// tractions where not `kLoaded`. Nodes in `at_walls`, one bit each, are damped by hold_at_walls,
/// when all forces on them are known. `gain2` is raised to the largest square of a change of the
/// others, times (m / light)^2 for light nodes [m2/s2].
template <int Dim, bool kLoaded>
GridWork<Dim> update_momentum(Grid<Dim>& grid, std::size_t block, const MomentumSettings& s,
                              std::uint64_t at_walls, double full_mass, double& gain2) noexcept {
  static_assert(kBlockNodes<Dim> <= 64);
  using L = NodeLayout<Dim>;
  GridWork<Dim> work;
  Node* nodes = grid.nodes.data() + block * kBlockNodes<Dim>;
  const double floor = kMassFloor * full_mass;
  const double per_light = s.light > 0.0 ? 1.0 / s.light : 0.0;
  double largest2 = 0.0;
  for (int n = 0; n < kBlockNodes<Dim>; ++n) {
    auto& q = nodes[n].q;
    const double m = q[L::mass];
    if (!(m > floor)) {
      for (int d = 0; d < Dim; ++d) q[L::momentum + d] = q[L::force + d] = 0.0;
      continue;
    }
    const double inverse = 1.0 / m;
    const double cundall = s.cundall == 0.0 || (at_walls >> n & 1) ? 0.0 : s.cundall;
    double change2 = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const double v = q[L::momentum + d] * inverse;
      const double f = q[L::force + d];
      const double weight = m * s.gravity[d];
      const double load = kLoaded ? load_on<Dim>(q, d) : 0.0;
      const double drag = damping_force(cundall, kLoaded ? f + weight + load : f + weight, v);
      const double outer = kLoaded ? weight + load : weight;
      const double v_new = v + s.dt * (f + outer + drag) * inverse;
      const double path = 0.5 * s.dt * (v + v_new);
      work.internal_start += s.dt * f * v;
      work.internal_end += s.dt * f * v_new;
      work.gravity += weight * path;
      if constexpr (kLoaded) {
        work.load += load * path;
        work.load_impulse[d] += load * s.dt;
      }
      work.damping += drag * path;
      work.gravity_impulse[d] += weight * s.dt;
      work.boundary_impulse[d] += (f + drag) * s.dt;
      q[L::momentum + d] = v_new;
      const double change = v_new - v;
      q[L::force + d] = change;
      change2 += change * change;
    }
    if (at_walls >> n & 1) continue;
    const double share = std::min(1.0, m * per_light);
    // Written so that a change that is not a number counts.
    if (!(share * share * change2 <= largest2)) largest2 = share * share * change2;
  }
  if (!(largest2 <= gain2)) gain2 = largest2;
  return work;
}

}  // namespace flowslide::mpm
