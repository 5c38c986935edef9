#pragma once
#include "mpm/grid.hpp"

#include <cmath>

/// Momentum balance on the grid: v* = (m v + dt (f + m b)) / m, then boundaries.
namespace flowslide::mpm {

/// What the grid did in one step; the sums close the balances of energy and momentum.
template <int Dim>
struct GridWork {
  double internal_start = 0.0;                 ///< dt sum f.v with velocities before the step [J]
  double internal_end = 0.0;                   ///< dt sum f.v* with velocities after it [J]
  double gravity = 0.0;                        ///< work of gravity [J]
  double damping = 0.0;                        ///< work of artificial damping, <= 0 [J]
  double boundary = 0.0;                       ///< work of boundary impulses, <= 0 [J]
  std::array<double, Dim> gravity_impulse{};   ///< [N s]
  std::array<double, Dim> boundary_impulse{};  ///< impulse of boundaries and damping [N s]
  void add(const GridWork& o) {
    internal_start += o.internal_start;
    internal_end += o.internal_end;
    gravity += o.gravity;
    damping += o.damping;
    boundary += o.boundary;
    for (int d = 0; d < Dim; ++d) {
      gravity_impulse[d] += o.gravity_impulse[d];
      boundary_impulse[d] += o.boundary_impulse[d];
    }
  }
};

struct MomentumSettings {
  double dt;                      ///< [s]
  std::array<double, 3> gravity;  ///< [m/s2]
  double cundall;                 ///< local non-viscous damping factor [-]
};

/// Nodes lighter than this share of a full cell's mass carry no velocity: their quotient is noise,
/// and the points near them weigh them with w -> 0 anyway.
inline constexpr double kMassFloor = 1e-18;

/// Local non-viscous damping opposes the motion with a share of the force (Cundall 1987).
inline double damping_force(double factor, double force, double velocity) noexcept {
  return factor == 0.0 ? 0.0 : -factor * std::copysign(std::abs(force), velocity);
}

/// Velocity after a boundary condition: a roller keeps the tangential part, the ground pushes with
/// an impulse m |v_n| and rubs with at most mu times that.
template <int Dim>
std::array<double, Dim> constrained(const BoundaryNode<Dim>& node,
                                    std::array<double, Dim> v) noexcept {
  double normal = 0.0, speed = 0.0;
  for (int d = 0; d < Dim; ++d) normal += v[d] * node.normal[d];
  if (node.kind == 0 && normal >= 0.0) return v;
  for (int d = 0; d < Dim; ++d) {
    v[d] -= normal * node.normal[d];
    speed += v[d] * v[d];
  }
  if (node.kind != 0) return v;
  speed = std::sqrt(speed);
  const double keep =
      speed > 0.0 ? std::max(0.0, 1.0 - node.friction * std::abs(normal) / speed) : 0.0;
  for (double& component : v) component *= keep;
  return v;
}

/// Velocities of a block's nodes before the step [m/s].
template <int Dim>
using BlockVelocity = std::array<std::array<double, kBlockNodes<Dim>>, Dim>;

/// Applies the boundary conditions of a block and moves the work of all forces to the constrained
/// path: over a step a force f does f (v + v*)/2 dt with v* the velocity after constraints.
template <int Dim>
void constrain(Grid<Dim>& grid, std::size_t block, const MomentumSettings& s, double mass_floor,
               const BlockVelocity<Dim>& before, GridWork<Dim>& work) noexcept {
  using L = NodeLayout<Dim>;
  Node* nodes = grid.nodes.data() + block * kBlockNodes<Dim>;
  const std::int32_t end = grid.boundary_first[block + 1];
  for (std::int32_t b = grid.boundary_first[block]; b < end;) {
    const std::int32_t local = grid.boundary[b].local;
    auto& q = nodes[local].q;
    const double m = q[L::mass];
    std::array<double, Dim> free{};
    for (int d = 0; d < Dim; ++d) free[d] = q[L::momentum + d];
    std::array<double, Dim> held = free;
    for (; b < end && grid.boundary[b].local == local; ++b)
      held = constrained<Dim>(grid.boundary[b], held);
    if (!(m > mass_floor)) continue;
    for (int d = 0; d < Dim; ++d) {
      const double change = held[d] - free[d], f = q[L::force + d], weight = m * s.gravity[d];
      const double drag = damping_force(s.cundall, f + weight, before[d][local]);
      work.internal_end += s.dt * f * change;
      work.gravity += 0.5 * s.dt * weight * change;
      work.damping += 0.5 * s.dt * drag * change;
      work.boundary += 0.5 * m * change * (before[d][local] + held[d]);
      work.boundary_impulse[d] += m * change;
      q[L::momentum + d] = held[d];
    }
  }
}

template <int Dim>
GridWork<Dim> update_momentum(Grid<Dim>& grid, std::size_t block, const MomentumSettings& s,
                              double full_mass) noexcept {
  using L = NodeLayout<Dim>;
  GridWork<Dim> work;
  BlockVelocity<Dim> before;
  Node* nodes = grid.nodes.data() + block * kBlockNodes<Dim>;
  const double floor = kMassFloor * full_mass;
  for (int n = 0; n < kBlockNodes<Dim>; ++n) {
    auto& q = nodes[n].q;
    const double m = q[L::mass];
    const bool real = m > floor;
    const double inverse = real ? 1.0 / m : 0.0;
    for (int d = 0; d < Dim; ++d) {
      const double v = q[L::momentum + d] * inverse;
      const double f = real ? q[L::force + d] : 0.0;
      const double weight = real ? m * s.gravity[d] : 0.0;
      const double drag = damping_force(s.cundall, f + weight, v);
      const double v_new = v + s.dt * (f + weight + drag) * inverse;
      const double path = 0.5 * s.dt * (v + v_new);
      work.internal_start += s.dt * f * v;
      work.internal_end += s.dt * f * v_new;
      work.gravity += weight * path;
      work.damping += drag * path;
      work.gravity_impulse[d] += weight * s.dt;
      work.boundary_impulse[d] += (f + drag) * s.dt;
      before[d][n] = v;
      q[L::momentum + d] = v_new;
    }
  }
  constrain<Dim>(grid, block, s, floor, before, work);
  for (int n = 0; n < kBlockNodes<Dim>; ++n)
    for (int d = 0; d < Dim; ++d)
      nodes[n].q[L::force + d] = nodes[n].q[L::momentum + d] - before[d][n];
  return work;
}

}  // namespace flowslide::mpm
