#include "mpm/walls/contact_solve.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {
namespace {

constexpr int kMostSweeps = 100;
// Largest correction of the last sweep, as a share of what the impulses do in all. Much more would
// let the soil creep into the wall: nothing remembers how far it came.
constexpr double kSweepTolerance = 1e-6;

template <int Dim>
void apply(Contact<Dim>& c, const WallPoint<Dim>& wall,
           const typename Contact<Dim>::Vector& impulse) noexcept {
  for (std::int32_t e = wall.first; e < wall.last; ++e) {
    const double gain = c.weight[e] * c.inverse_mass[c.node[e]];
    for (int d = 0; d < Dim; ++d) c.velocity[c.node[e]][d] += gain * impulse[d];
  }
}

/// A dashpot's turn: P = dt (S - Z (u0 + u)/2) with u the velocity after P, u0 that before the
/// step.
template <int Dim>
double drain(Contact<Dim>& c, std::int32_t p, Ends ends, double dt,
             typename Contact<Dim>::Vector& held) noexcept {
  const WallPoint<Dim>& wall = c.walls[p];
  const Dashpot<Dim>& dashpot = c.absorbing.dashpots[wall.dashpot];
  const double kept = dashpot.kept();
  const std::array<double, Dim> u = surface_velocity(c, wall);
  std::array<double, Dim> change;
  double size = 0.0;
  for (int d = 0; d < Dim; ++d) {
    const double half = 0.5 * dt * (wall.normal[d] != 0.0 ? dashpot.normal : dashpot.shear);
    const double free = u[d] - c.mobility[p] * held[d];
    const double draining =
        (dt * kept * dashpot.support[d] - half * (c.before[wall.dashpot][d] + free)) /
        (1.0 + half * c.mobility[p]);
    const double impulse = ends == Ends::stop ? -free / c.mobility[p] : draining;
    change[d] = impulse - held[d];
    size = std::max(size, std::abs(change[d]) * c.mobility[p]);
    held[d] = impulse;
  }
  apply(c, wall, change);
  return size;
}

/// One wall point's turn: the impulse that stops the soil from entering it, within the friction
/// cone. Returns the size of the velocity correction [m/s].
template <int Dim>
double push(Contact<Dim>& c, std::int32_t p, Hold hold,
            typename Contact<Dim>::Vector& held) noexcept {
  const WallPoint<Dim>& wall = c.walls[p];
  const std::array<double, Dim> u = surface_velocity(c, wall);
  const double inverse = 1.0 / c.mobility[p];
  std::array<double, Dim> wanted;
  double normal = 0.0;
  for (int d = 0; d < Dim; ++d) {
    wanted[d] = held[d] - u[d] * inverse;
    normal += wanted[d] * wall.normal[d];
  }
  const bool roller = wall.kind == WallKind::roller;
  const bool both_ways = roller || hold == Hold::fast;
  const double allowed = both_ways ? normal : std::max(0.0, normal);
  double tangential = 0.0;
  for (int d = 0; d < Dim; ++d) {
    wanted[d] -= normal * wall.normal[d];
    tangential += wanted[d] * wanted[d];
  }
  tangential = std::sqrt(tangential);
  const double most = roller || hold != Hold::contact ? 0.0 : wall.friction * allowed;
  const double keep = tangential > most ? most / tangential : 1.0;
  std::array<double, Dim> change;
  double size = 0.0;
  for (int d = 0; d < Dim; ++d) {
    change[d] = keep * wanted[d] + allowed * wall.normal[d] - held[d];
    size = std::max(size, std::abs(change[d]) * c.mobility[p]);
  }
  for (int d = 0; d < Dim; ++d) held[d] += change[d];
  apply(c, wall, change);
  return size;
}

/// Mass and velocity of the nodes in reach of walls; `first` is the place of what is solved for.
template <int Dim>
void take_nodes(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double floor, int first) {
  using L = NodeLayout<Dim>;
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    const auto& q = nodes[c.nodes[k]].q;
    c.inverse_mass[k] = q[L::mass] > floor ? 1.0 / q[L::mass] : 0.0;
    c.uses[k] = 0;
    for (int d = 0; d < Dim; ++d) c.velocity[k][d] = q[first + d];
  }
}

/// Does a wall point that soil touches act in a solution? `pushed` is the normal impulse of the
/// last step.
bool acts(WallKind kind, double pushed, Hold hold, Ends ends) noexcept {
  switch (kind) {
    case WallKind::ground:
      return hold != Hold::fast || pushed > 0.0;
    case WallKind::roller:
      return true;
    case WallKind::absorbing:
      return ends != Ends::idle;
  }
  return false;
}

/// Wall points that soil touches and that act; the impulse of others is zero.
template <int Dim>
void find_active(Contact<Dim>& c, Hold hold, Ends ends,
                 std::vector<typename Contact<Dim>::Vector>& impulse) {
  c.active.clear();
  for (std::size_t p = 0; p < c.walls.size(); ++p) {
    const WallPoint<Dim>& wall = c.walls[p];
    double mobility = 0.0, touched = 0.0;
    for (std::int32_t e = wall.first; e < wall.last; ++e) {
      mobility += c.weight[e] * c.weight[e] * c.inverse_mass[c.node[e]];
      if (e < wall.touching) touched = mobility;
    }
    c.mobility[p] = mobility;
    double pushed = 0.0;
    for (int d = 0; d < Dim; ++d) pushed += c.impulse[p][d] * wall.normal[d];
    if (touched > 0.0 && acts(wall.kind, pushed, hold, ends)) {
      c.active.push_back(static_cast<std::int32_t>(p));
      for (std::int32_t e = wall.first; e < wall.last; ++e) ++c.uses[c.node[e]];
    } else {
      impulse[p] = {};
    }
  }
}

}  // namespace

/// Impulses of all wall points that soil touches. A point that shares no node with another has its
/// answer at once; the others are swept until the corrections are small, from the impulses as they
/// are.
template <int Dim>
void solve(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double full_mass, Hold hold,
           std::vector<typename Contact<Dim>::Vector>& impulse, Ends ends, double dt) noexcept {
  using L = NodeLayout<Dim>;
  const auto turn = [&](std::int32_t p) {
    return c.walls[p].kind == WallKind::absorbing ? drain(c, p, ends, dt, impulse[p])
                                                  : push(c, p, hold, impulse[p]);
  };
  // changes, or velocities
  take_nodes(nodes, c, kMassFloor * full_mass, ends == Ends::stop ? L::force : L::momentum);
  find_active(c, hold, ends, impulse);
  c.coupled.clear();
  for (const std::int32_t p : c.active) {
    const WallPoint<Dim>& wall = c.walls[p];
    bool shares = false;
    for (std::int32_t e = wall.first; e < wall.last; ++e)
      shares = shares || (c.uses[c.node[e]] > 1 && c.inverse_mass[c.node[e]] > 0.0);
    if (shares) {
      c.coupled.push_back(p);
      apply(c, wall, impulse[p]);
    } else {
      impulse[p] = {};
      turn(p);
    }
  }
  const auto n = static_cast<std::int32_t>(c.coupled.size());
  double tolerance = 0.0;
  for (int count = 0; count < kMostSweeps; ++count) {
    double largest = 0.0;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t p = c.coupled[count % 2 == 0 ? i : n - 1 - i];
      largest = std::max(largest, turn(p));
    }
    if (count == 0)
      for (const std::int32_t p : c.coupled)
        for (int d = 0; d < Dim; ++d)
          tolerance =
              std::max(tolerance, kSweepTolerance * c.mobility[p] * std::abs(impulse[p][d]));
    if (largest <= tolerance) break;
  }
}

template <int Dim>
void push_out(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double full_mass,
              Hold hold) noexcept {
  std::fill(c.fresh.begin(), c.fresh.end(), typename Contact<Dim>::Vector{});
  solve(nodes, c, full_mass, hold, c.fresh);
}

#define FLOWSLIDE_CONTACT(DIM)                                                                  \
  template void solve<DIM>(const StaggeredArray<Node>&, Contact<DIM>&, double, Hold,            \
                           std::vector<typename Contact<DIM>::Vector>&, Ends, double) noexcept; \
  template void push_out<DIM>(const StaggeredArray<Node>&, Contact<DIM>&, double, Hold) noexcept;
FLOWSLIDE_CONTACT(2)
FLOWSLIDE_CONTACT(3)
#undef FLOWSLIDE_CONTACT

}  // namespace flowslide::mpm
