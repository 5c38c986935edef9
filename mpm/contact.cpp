#include "mpm/contact.hpp"

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

/// One wall point's turn: the impulse that stops the soil from entering it, within the friction
/// cone. Returns the size of the velocity correction [m/s].
template <int Dim>
double push(Contact<Dim>& c, std::int32_t p, Hold hold,
            typename Contact<Dim>::Vector& held) noexcept {
  const WallPoint<Dim>& wall = c.walls[p];
  std::array<double, Dim> u{};
  for (std::int32_t e = wall.first; e < wall.last; ++e)
    for (int d = 0; d < Dim; ++d) u[d] += c.weight[e] * c.velocity[c.node[e]][d];
  const double inverse = 1.0 / c.mobility[p];
  std::array<double, Dim> wanted;
  double normal = 0.0;
  for (int d = 0; d < Dim; ++d) {
    wanted[d] = held[d] - u[d] * inverse;
    normal += wanted[d] * wall.normal[d];
  }
  const bool both_ways = wall.holds || hold == Hold::fast;
  const double allowed = both_ways ? normal : std::max(0.0, normal);
  double tangential = 0.0;
  for (int d = 0; d < Dim; ++d) {
    wanted[d] -= normal * wall.normal[d];
    tangential += wanted[d] * wanted[d];
  }
  tangential = std::sqrt(tangential);
  const double most = wall.holds || hold != Hold::contact ? 0.0 : wall.friction * allowed;
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

/// Impulses of all wall points that soil touches. A point that shares no node with another has its
/// answer at once; the others are swept until the corrections are small, from the impulses as they
/// are.
template <int Dim>
void solve(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double full_mass, Hold hold,
           std::vector<typename Contact<Dim>::Vector>& impulse) noexcept {
  using L = NodeLayout<Dim>;
  const double floor = kMassFloor * full_mass;
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    const auto& q = nodes[c.nodes[k]].q;
    c.inverse_mass[k] = q[L::mass] > floor ? 1.0 / q[L::mass] : 0.0;
    c.uses[k] = 0;
    for (int d = 0; d < Dim; ++d) c.velocity[k][d] = q[L::momentum + d];
  }
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
    if (touched > 0.0 && (hold != Hold::fast || wall.holds || pushed > 0.0)) {
      c.active.push_back(static_cast<std::int32_t>(p));
      for (std::int32_t e = wall.first; e < wall.last; ++e) ++c.uses[c.node[e]];
    } else {
      impulse[p] = {};
    }
  }
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
      push(c, p, hold, impulse[p]);
    }
  }
  const auto n = static_cast<std::int32_t>(c.coupled.size());
  double tolerance = 0.0;
  for (int count = 0; count < kMostSweeps; ++count) {
    double largest = 0.0;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t p = c.coupled[count % 2 == 0 ? i : n - 1 - i];
      largest = std::max(largest, push(c, p, hold, impulse[p]));
    }
    if (count == 0)
      for (const std::int32_t p : c.coupled)
        for (int d = 0; d < Dim; ++d)
          tolerance =
              std::max(tolerance, kSweepTolerance * c.mobility[p] * std::abs(impulse[p][d]));
    if (largest <= tolerance) break;
  }
}

}  // namespace

template <int Dim>
void push_out(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double full_mass,
              Hold hold) noexcept {
  std::fill(c.fresh.begin(), c.fresh.end(), typename Contact<Dim>::Vector{});
  solve(nodes, c, full_mass, hold, c.fresh);
}

namespace {

/// Takes the local damping of the free step back: it opposes forces that walls have yet to balance.
template <int Dim>
void take_back_damping(Grid<Dim>& grid, const Contact<Dim>& c, const MomentumSettings& s,
                       double floor, GridWork<Dim>& work) noexcept {
  using L = NodeLayout<Dim>;
  for (const std::int32_t node : c.nodes) {
    auto& q = grid.nodes[node].q;
    const double m = q[L::mass];
    if (!(m > floor)) continue;
    for (int d = 0; d < Dim; ++d) {
      const double old = q[L::momentum + d], before = old - q[L::force + d];
      const double total = m * q[L::force + d] / s.dt, weight = m * s.gravity[d];
      const double load = load_on<Dim>(q, d);
      const double pull = total / (1.0 - std::copysign(s.cundall, total * before));
      const double change = s.dt * (pull - total) / m;
      work.internal_end += s.dt * (pull - weight - load) * change;
      work.gravity += 0.5 * s.dt * weight * change;
      work.load += 0.5 * s.dt * load * change;
      work.damping -= 0.5 * s.dt * (total - pull) * (before + old);
      work.boundary_impulse[d] -= s.dt * (total - pull);
      q[L::momentum + d] += change;
      q[L::force + d] += change;
    }
  }
}

}  // namespace

template <int Dim>
GridWork<Dim> hold_at_walls(Grid<Dim>& grid, Contact<Dim>& c, const MomentumSettings& s,
                            double full_mass) noexcept {
  using L = NodeLayout<Dim>;
  GridWork<Dim> work;
  if (s.cundall > 0.0) take_back_damping(grid, c, s, kMassFloor * full_mass, work);
  solve(grid.nodes, c, full_mass, Hold::contact, c.impulse);
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    if (!(c.inverse_mass[k] > 0.0)) continue;
    auto& q = grid.nodes[c.nodes[k]].q;
    const double m = q[L::mass];
    for (int d = 0; d < Dim; ++d) {
      const double free = q[L::momentum + d], before = free - q[L::force + d];
      const double held = c.velocity[k][d], weight = m * s.gravity[d];
      const double load = load_on<Dim>(q, d);
      const double drag = damping_force(s.cundall, m * (held - before) / s.dt, before);
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

#define FLOWSLIDE_CONTACT(DIM)                                                                    \
  template void push_out<DIM>(const StaggeredArray<Node>&, Contact<DIM>&, double, Hold) noexcept; \
  template GridWork<DIM> hold_at_walls<DIM>(Grid<DIM>&, Contact<DIM>&, const MomentumSettings&,   \
                                            double) noexcept;
FLOWSLIDE_CONTACT(2)
FLOWSLIDE_CONTACT(3)
#undef FLOWSLIDE_CONTACT

}  // namespace flowslide::mpm
