#include "core/elementary.hpp"
#include "mpm/walls/contact_solve.hpp"

#include <algorithm>
#include <cmath>

/// The walls' part of the momentum step, with the work that all forces do along its corrections.
namespace flowslide::mpm {
namespace {

/// Calls f(wall point, its impulse) for every dashpot.
template <int Dim, class F>
void for_each_dashpot(Contact<Dim>& c, F&& f) {
  for (std::size_t p = 0; p < c.walls.size(); ++p)
    if (c.walls[p].kind == WallKind::absorbing) f(c.walls[p], c.impulse[p]);
}

/// Velocities before the step where the dashpots are; and, in the first step, the forces with which
/// the soil there would not move.
template <int Dim>
void ready_dashpots(const Grid<Dim>& grid, Contact<Dim>& c, double dt, double full_mass) noexcept {
  using L = NodeLayout<Dim>;
  if (!c.absorbing.supported) {
    solve(grid.nodes, c, full_mass, Hold::contact, c.impulse, Ends::stop);
    for_each_dashpot(c, [&](const WallPoint<Dim>& wall, const auto& impulse) {
      for (int d = 0; d < Dim; ++d) c.absorbing.dashpots[wall.dashpot].support[d] = impulse[d] / dt;
    });
    std::fill(c.impulse.begin(), c.impulse.end(), typename Contact<Dim>::Vector{});
    c.absorbing.supported = true;
  }
  for_each_dashpot(c, [&](const WallPoint<Dim>& wall, const auto&) {
    auto& before = c.before[wall.dashpot];
    before = {};
    for (std::int32_t e = wall.first; e < wall.last; ++e) {
      const auto& q = grid.nodes[c.nodes[c.node[e]]].q;
      for (int d = 0; d < Dim; ++d)
        before[d] += c.weight[e] * (q[L::momentum + d] - q[L::force + d]);
    }
  });
}

/// Twice the diagonal of the active blocks [m]: springs so soft that waves hardly meet them.
template <int Dim>
double radius(const Grid<Dim>& grid) noexcept {
  Coordinate<Dim> low = grid.blocks.front(), high = low;
  for (const auto& block : grid.blocks) {
    for (int d = 0; d < Dim; ++d) {
      low[d] = std::min(low[d], block[d]);
      high[d] = std::max(high[d], block[d]);
    }
  }
  double square = 0.0;
  for (int d = 0; d < Dim; ++d) square += pow(high[d] - low[d] + 1, 2);
  return 2.0 * kBlockWidth<Dim> * grid.h * std::sqrt(square);
}

/// Energy that left through the dashpots; and what the soil beyond takes up as it is pushed aside,
/// G/R and G/2R per area (docs/theory/contact.md), without which the soil would creep for ever.
template <int Dim>
void settle_dashpots(const Grid<Dim>& grid, Contact<Dim>& c, double dt, double full_mass,
                     GridWork<Dim>& work) noexcept {
  const double density = full_mass / pow(grid.h, Dim), r = radius(grid);
  for_each_dashpot(c, [&](const WallPoint<Dim>& wall, const auto& impulse) {
    Dashpot<Dim>& dashpot = c.absorbing.dashpots[wall.dashpot];
    const auto after = surface_velocity(c, wall);
    const double stiffness = dashpot.shear * dashpot.shear / (dashpot.area * density * r);
    for (int d = 0; d < Dim; ++d) {
      const double way = 0.5 * dt * (c.before[wall.dashpot][d] + after[d]);
      work.absorbed -= impulse[d] / dt * way;
      dashpot.support[d] -= (wall.normal[d] != 0.0 ? 1.0 : 0.5) * stiffness * way;
    }
  });
}

/// Damping of a node that the walls have given the velocity `held`. It slows at most to rest: the
/// impulse that stops soil is no force of which a share could push it back.
double damping_at_wall(const MomentumSettings& s, double m, double before, double held) noexcept {
  const double drag = damping_force(s.cundall, m * (held - before) / s.dt, before);
  const double after = held + s.dt * drag / m;
  const double slowed = std::clamp(after, std::min(0.0, held), std::max(0.0, held));
  return slowed == after ? drag : (slowed - held) * m / s.dt;
}

}  // namespace

template <int Dim>
GridWork<Dim> hold_at_walls(Grid<Dim>& grid, Contact<Dim>& c, const MomentumSettings& s,
                            double full_mass) noexcept {
  using L = NodeLayout<Dim>;
  GridWork<Dim> work;
  const bool absorbs = !c.absorbing.dashpots.empty();
  if (absorbs) ready_dashpots(grid, c, s.dt, full_mass);
  solve(grid.nodes, c, full_mass, Hold::contact, c.impulse, absorbs ? Ends::drain : Ends::idle,
        s.dt);
  if (absorbs) settle_dashpots(grid, c, s.dt, full_mass, work);
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    c.given[k] = {};
    if (!(c.inverse_mass[k] > 0.0)) continue;
    auto& q = grid.nodes[c.nodes[k]].q;
    const double m = q[L::mass];
    for (int d = 0; d < Dim; ++d) {
      const double free = q[L::momentum + d], before = free - q[L::force + d];
      const double held = c.velocity[k][d], weight = m * s.gravity[d];
      c.given[k][d] = m * (held - free);
      const double load = load_on<Dim>(q, d);
      const double drag = damping_at_wall(s, m, before, held);
      const double after = held + s.dt * drag / m, change = after - free;
      work.internal_end += (m * q[L::force + d] - s.dt * (weight + load)) * change;
      work.gravity += 0.5 * s.dt * weight * change;
      work.load += 0.5 * s.dt * load * change;
      work.damping += 0.5 * s.dt * drag * (before + after);
      work.boundary += 0.5 * m * (held - free) * (before + after);
      work.boundary_impulse[d] += m * change;
      q[L::momentum + d] = after;
      q[L::force + d] += change;
    }
  }
  return work;
}

template GridWork<2> hold_at_walls<2>(Grid<2>&, Contact<2>&, const MomentumSettings&,
                                      double) noexcept;
template GridWork<3> hold_at_walls<3>(Grid<3>&, Contact<3>&, const MomentumSettings&,
                                      double) noexcept;

}  // namespace flowslide::mpm
