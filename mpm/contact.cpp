#include "mpm/contact.hpp"

#include "mpm/basis.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {
namespace {

// Wall points this far below the soil's side of the ground catch what has slipped through [cells].
constexpr double kNetFrom = 1.5, kNetTo = 4.5;
constexpr int kMostSweeps = 30;
// Largest correction of the last sweep, as a share of what the impulses do in all.
constexpr double kSweepTolerance = 1e-3;

template <int Dim>
std::int32_t find_block(const Grid<Dim>& grid, const Coordinate<Dim>& c) {
  const auto later = [](const Coordinate<Dim>& a, const Coordinate<Dim>& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  };
  const auto at = std::lower_bound(grid.blocks.begin(), grid.blocks.end(), c, later);
  return at != grid.blocks.end() && *at == c ? static_cast<std::int32_t>(at - grid.blocks.begin())
                                             : -1;
}

template <int Dim>
struct Placing {
  const Grid<Dim>& grid;
  const Ground& ground;
  Contact<Dim>& contact;
  std::vector<std::int32_t> grid_node;  ///< per entry

  /// Adds an entry for a node if its block is active.
  void add_node(const Coordinate<Dim>& node, double weight) {
    constexpr int B = kBlockWidth<Dim>;
    Coordinate<Dim> block;
    int local = 0;
    for (int d = Dim - 1; d >= 0; --d) {
      block[d] = node[d] >= 0 ? node[d] / B : -((B - 1 - node[d]) / B);
      local = local * B + (node[d] - block[d] * B);
    }
    const std::int32_t at = find_block<Dim>(grid, block);
    if (at < 0) return;
    grid_node.push_back(at * kBlockNodes<Dim> + local);
    contact.weight.push_back(weight);
  }

  /// Ends the wall point begun at entry `first`, nodes at up to half a cell above the wall first.
  void finish(WallPoint<Dim> wall, std::size_t first, std::size_t touching) {
    wall.first = static_cast<std::int32_t>(first);
    wall.touching = static_cast<std::int32_t>(touching);
    wall.last = static_cast<std::int32_t>(grid_node.size());
    if (wall.last > wall.first) contact.walls.push_back(wall);
  }

  template <class Basis>
  void add(const std::array<double, Dim>& at, WallPoint<Dim> wall) {
    constexpr int N = Basis::nodes;
    double w[Dim][N], g[Dim][N];
    Coordinate<Dim> base;
    for (int d = 0; d < Dim; ++d) {
      const double x = (at[d] - grid.origin[d]) / grid.h;
      const double lowest = base_node<Basis>(x);
      base[d] = static_cast<std::int32_t>(lowest);
      Basis::evaluate(x - lowest, w[d], g[d]);
    }
    const std::size_t first = grid_node.size();
    std::size_t touching = first;
    for (const bool near : {true, false}) {
      for (int n = 0; n < power<Dim>(N); ++n) {
        Coordinate<Dim> node;
        double weight = 1.0, above = 0.0;
        for (int d = 0, rest = n; d < Dim; ++d, rest /= N) {
          node[d] = base[d] + rest % N;
          weight *= w[d][rest % N];
          above += wall.normal[d] * (grid.origin[d] + grid.h * node[d] - at[d]);
        }
        if (weight > 0.0 && (above < 0.5 * grid.h + 1e-9 * grid.h) == near) add_node(node, weight);
      }
      if (near) touching = grid_node.size();
    }
    finish(wall, first, touching);
  }
};

/// Calls f(x) for the quarter points x = origin + (k/2 + 1/4) h between `from` and `to`: those of a
/// lattice with two points per cell and direction, so that pressure at rest balances exactly.
template <class F>
void for_each_quarter(double from, double to, double origin, double h, F&& f) {
  const double first = std::ceil(2.0 * (from - origin) / h - 0.5 - 1e-9);
  const double last = std::floor(2.0 * (to - origin) / h - 0.5 + 1e-9);
  for (double k = first; k <= last; k += 1.0) f(origin + (0.5 * k + 0.25) * h);
}

}  // namespace

template <int Dim, class Basis>
void place_walls(const Grid<Dim>& grid, const Ground& ground, const Rollers& rollers,
                 Contact<Dim>& c) {
  constexpr int B = kBlockWidth<Dim>, up = Dim - 1;
  c.walls.clear();
  c.weight.clear();
  c.nodes.clear();
  c.node.clear();
  Placing<Dim> place{grid, ground, c, {}};
  std::array<double, Dim> low, high;
  low.fill(1e300);
  high.fill(-1e300);
  for (const auto& block : grid.blocks) {
    for (int d = 0; d < Dim; ++d) {
      low[d] = std::min(low[d], grid.origin[d] + grid.h * block[d] * B);
      high[d] = std::max(high[d], grid.origin[d] + grid.h * (block[d] * B + B - 1));
    }
  }
  // In 3D everything is repeated along y.
  const auto along = [&](std::array<double, Dim> at, const WallPoint<Dim>& wall) {
    if constexpr (Dim == 2) {
      place.template add<Basis>(at, wall);
    } else {
      for_each_quarter(low[1], high[1], grid.origin[1], grid.h, [&](double y) {
        at[1] = y;
        place.template add<Basis>(at, wall);
      });
    }
  };

  for (const double x : {rollers.left, rollers.right}) {
    if (!std::isfinite(x)) continue;
    WallPoint<Dim> wall;
    wall.normal[0] = x == rollers.left ? 1.0 : -1.0;
    wall.holds = true;
    for_each_quarter(low[up], high[up], grid.origin[up], grid.h, [&](double z) {
      std::array<double, Dim> at{};
      at[0] = x, at[up] = z;
      along(at, wall);
    });
  }
  const double first_x = std::max(low[0], rollers.left), last_x = std::min(high[0], rollers.right);
  WallPoint<Dim> level;
  level.normal[up] = 1.0;
  level.friction = ground.friction;
  const auto add_level = [&](double from, double to, double height) {
    for_each_quarter(from, to, grid.origin[0], grid.h, [&](double x) {
      std::array<double, Dim> at{};
      at[0] = x, at[up] = height;
      along(at, level);
    });
  };
  add_level(first_x, std::min(last_x, ground.x.front()), ground.height.front());
  for (std::size_t i = 0; i + 1 < ground.x.size(); ++i) {
    const double dx = ground.x[i + 1] - ground.x[i], dy = ground.height[i + 1] - ground.height[i];
    const double length = std::hypot(dx, dy);
    if (!(length > 0.0)) continue;
    WallPoint<Dim> wall = level;
    wall.normal[0] = -dy / length;
    wall.normal[up] = dx / length;
    if (std::abs(dy) <= dx) {
      for_each_quarter(std::max(first_x, ground.x[i]), std::min(last_x, ground.x[i + 1]),
                       grid.origin[0], grid.h, [&](double x) {
                         std::array<double, Dim> at{};
                         at[0] = x, at[up] = ground.height[i] + (x - ground.x[i]) * dy / dx;
                         along(at, wall);
                       });
    } else {
      const auto [bottom, top] = std::minmax(ground.height[i], ground.height[i + 1]);
      for_each_quarter(std::max(low[up], bottom), std::min(high[up], top), grid.origin[up], grid.h,
                       [&](double z) {
                         std::array<double, Dim> at{};
                         at[0] = ground.x[i] + (z - ground.height[i]) * dx / dy, at[up] = z;
                         if (at[0] >= first_x && at[0] <= last_x) along(at, wall);
                       });
    }
  }
  add_level(std::max(first_x, ground.x.back()), last_x, ground.height.back());

  for (const auto& block : grid.blocks) {
    const auto middle = [&](int d) { return grid.origin[d] + grid.h * (block[d] + 0.5) * B; };
    const double below = -ground.nearest(middle(0), middle(up)).distance / grid.h;
    if (below < kNetFrom - B || below > kNetTo + B) continue;  // all nodes lie within 0.71 B
    for (int n = 0; n < kBlockNodes<Dim>; ++n) {
      Coordinate<Dim> node;
      for (int d = 0, rest = n; d < Dim; ++d, rest /= B) node[d] = block[d] * B + rest % B;
      const Nearest near =
          ground.nearest(grid.origin[0] + grid.h * node[0], grid.origin[up] + grid.h * node[up]);
      const double depth = -near.distance / grid.h;
      if (!(depth > kNetFrom && depth < kNetTo)) continue;
      WallPoint<Dim> wall = level;
      wall.normal[0] = near.normal[0];
      wall.normal[up] = near.normal[1];
      const std::size_t first = place.grid_node.size();
      place.add_node(node, 1.0);
      place.finish(wall, first, place.grid_node.size());
    }
  }

  c.nodes = place.grid_node;
  std::sort(c.nodes.begin(), c.nodes.end());
  c.nodes.erase(std::unique(c.nodes.begin(), c.nodes.end()), c.nodes.end());
  for (const std::int32_t node : place.grid_node)
    c.node.push_back(static_cast<std::int32_t>(
        std::lower_bound(c.nodes.begin(), c.nodes.end(), node) - c.nodes.begin()));
  c.velocity.resize(c.nodes.size());
  c.inverse_mass.resize(c.nodes.size());
  c.mobility.resize(c.walls.size());
  c.fresh.resize(c.walls.size());
  c.active.reserve(c.walls.size());
}

namespace {

template <int Dim>
void apply(Contact<Dim>& c, const WallPoint<Dim>& wall,
           const typename Contact<Dim>::Vector& impulse) noexcept {
  for (std::int32_t e = wall.first; e < wall.last; ++e) {
    const double gain = c.weight[e] * c.inverse_mass[c.node[e]];
    for (int d = 0; d < Dim; ++d) c.velocity[c.node[e]][d] += gain * impulse[d];
  }
}

/// One wall point's turn: the impulse that stops the soil from entering it, within the friction
/// cone. Returns the size of the velocity correction [m/s]; one below `least` is left undone.
template <int Dim>
double push(Contact<Dim>& c, std::int32_t p, bool slip, double least,
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
  const double allowed = wall.holds ? normal : std::max(0.0, normal);
  double tangential = 0.0;
  for (int d = 0; d < Dim; ++d) {
    wanted[d] -= normal * wall.normal[d];
    tangential += wanted[d] * wanted[d];
  }
  tangential = std::sqrt(tangential);
  const double most = wall.holds || slip ? 0.0 : wall.friction * allowed;
  const double keep = tangential > most ? most / tangential : 1.0;
  std::array<double, Dim> change;
  double size = 0.0;
  for (int d = 0; d < Dim; ++d) {
    change[d] = keep * wanted[d] + allowed * wall.normal[d] - held[d];
    size = std::max(size, std::abs(change[d]) * c.mobility[p]);
  }
  if (size > least) {
    for (int d = 0; d < Dim; ++d) held[d] += change[d];
    apply(c, wall, change);
  }
  return size;
}

/// Sweeps over the wall points until the corrections are small, from the impulses as they are.
template <int Dim>
void sweep(const std::vector<Node>& nodes, Contact<Dim>& c, double full_mass, bool slip,
           std::vector<typename Contact<Dim>::Vector>& impulse) noexcept {
  using L = NodeLayout<Dim>;
  const double floor = kMassFloor * full_mass;
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    const auto& q = nodes[c.nodes[k]].q;
    c.inverse_mass[k] = q[L::mass] > floor ? 1.0 / q[L::mass] : 0.0;
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
    if (touched > 0.0) {
      c.active.push_back(static_cast<std::int32_t>(p));
      apply(c, wall, impulse[p]);
    } else {
      impulse[p] = {};
    }
  }
  double tolerance = 0.0;
  for (int count = 0; count < kMostSweeps; ++count) {
    const auto n = static_cast<std::int32_t>(c.active.size());
    double largest = 0.0;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t p = c.active[count % 2 == 0 ? i : n - 1 - i];
      largest = std::max(largest, push(c, p, slip, 0.1 * tolerance, impulse[p]));
    }
    if (count == 0)
      for (const std::int32_t p : c.active)
        for (int d = 0; d < Dim; ++d)
          tolerance =
              std::max(tolerance, kSweepTolerance * c.mobility[p] * std::abs(impulse[p][d]));
    if (largest <= tolerance) break;
  }
}

}  // namespace

template <int Dim>
void push_out(const std::vector<Node>& nodes, Contact<Dim>& c, double full_mass,
              bool slip) noexcept {
  std::fill(c.fresh.begin(), c.fresh.end(), typename Contact<Dim>::Vector{});
  sweep(nodes, c, full_mass, slip, c.fresh);
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
      const double pull = total / (1.0 - std::copysign(s.cundall, total * before));
      const double change = s.dt * (pull - total) / m;
      work.internal_end += s.dt * (pull - weight) * change;
      work.gravity += 0.5 * s.dt * weight * change;
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
  sweep(grid.nodes, c, full_mass, false, c.impulse);
  for (std::size_t k = 0; k < c.nodes.size(); ++k) {
    if (!(c.inverse_mass[k] > 0.0)) continue;
    auto& q = grid.nodes[c.nodes[k]].q;
    const double m = q[L::mass];
    for (int d = 0; d < Dim; ++d) {
      const double free = q[L::momentum + d], before = free - q[L::force + d];
      const double held = c.velocity[k][d], weight = m * s.gravity[d];
      const double drag = damping_force(s.cundall, m * (held - before) / s.dt, before);
      const double after = held + s.dt * drag / m, change = after - free;
      work.internal_end += (m * q[L::force + d] - s.dt * weight) * change;
      work.gravity += 0.5 * s.dt * weight * change;
      work.damping += 0.5 * s.dt * drag * (before + after);
      work.boundary += 0.5 * m * (held - free) * (before + after);
      work.boundary_impulse[d] += m * change;
      q[L::momentum + d] = after;
      q[L::force + d] += change;
    }
  }
  return work;
}

#define FLOWSLIDE_PLACE(DIM, BASIS)                                                      \
  template void place_walls<DIM, BASIS>(const Grid<DIM>&, const Ground&, const Rollers&, \
                                        Contact<DIM>&);
#define FLOWSLIDE_CONTACT(DIM)                                                                  \
  FLOWSLIDE_PLACE(DIM, Linear)                                                                  \
  FLOWSLIDE_PLACE(DIM, Gimp)                                                                    \
  FLOWSLIDE_PLACE(DIM, QuadraticBSpline)                                                        \
  FLOWSLIDE_PLACE(DIM, CubicBSpline)                                                            \
  template void push_out<DIM>(const std::vector<Node>&, Contact<DIM>&, double, bool) noexcept;  \
  template GridWork<DIM> hold_at_walls<DIM>(Grid<DIM>&, Contact<DIM>&, const MomentumSettings&, \
                                            double) noexcept;
FLOWSLIDE_CONTACT(2)
FLOWSLIDE_CONTACT(3)
#undef FLOWSLIDE_CONTACT
#undef FLOWSLIDE_PLACE

}  // namespace flowslide::mpm
