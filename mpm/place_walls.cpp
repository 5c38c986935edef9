#include "mpm/basis.hpp"
#include "mpm/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// Where walls act: wall points on the grid lines that the ground and the rollers cross.
namespace flowslide::mpm {
namespace {

// Wall points this far below the soil's side of the ground catch what has slipped through [cells].
constexpr double kNetFrom = 1.5, kNetTo = 4.5;

template <int Dim>
std::int32_t find_block(const Grid<Dim>& grid, const Coordinate<Dim>& c) {
  const auto later = [](const Coordinate<Dim>& a, const Coordinate<Dim>& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  };
  const auto at = std::lower_bound(grid.blocks.begin(), grid.blocks.end(), c, later);
  return at != grid.blocks.end() && *at == c ? static_cast<std::int32_t>(at - grid.blocks.begin())
                                             : -1;
}

/// A node's shape function at the distance t [cells].
template <class Basis>
double shape(double t) {
  double w[Basis::nodes], g[Basis::nodes];
  const double lowest = base_node<Basis>(t);
  Basis::evaluate(t - lowest, w, g);
  return lowest <= 0.0 && lowest > -Basis::nodes ? w[static_cast<int>(-lowest)] : 0.0;
}

template <int Dim>
struct Placing {
  const Grid<Dim>& grid;
  Contact<Dim>& contact;
  Coordinate<Dim> low, high;            ///< outermost nodes of the active blocks
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

  /// Wall points where a straight wall crosses the grid lines in direction `across` that stand at
  /// node `line` of the axis `along`: `height` is where, `slope` how the wall rises from line to
  /// line [cells]. In 3D the wall does not vary along the third axis: one for every node there.
  template <class Basis>
  void add(int along, int across, std::int32_t line, double height, double slope,
           const WallPoint<Dim>& wall) {
    const int third = Dim == 3 ? 3 - along - across : 0;
    // Mean of the shape functions of the line's nodes over the wall, weighted with the line's own:
    // the share of each in a uniform pressure.
    const double reach = 0.5 * Basis::nodes, tilt = std::abs(slope) * reach;
    const auto first_node = static_cast<std::int32_t>(base_node<Basis>(height - tilt));
    const auto last_node =
        static_cast<std::int32_t>(base_node<Basis>(height + tilt)) + Basis::nodes;
    Coordinate<Dim> node;
    node[along] = line;
    for (int j = Dim == 3 ? low[third] : 0; j <= (Dim == 3 ? high[third] : 0); ++j) {
      if constexpr (Dim == 3) node[third] = j;
      const std::size_t first = grid_node.size();
      std::size_t touching = first;
      for (const bool near : {true, false}) {
        for (std::int32_t k = first_node; k < last_node; ++k) {
          const double above = (k - height) * wall.normal[across];
          if ((above < 0.5 + 1e-9) != near) continue;
          double weight = 0.0;
          for (double s = 0.25 - reach; s < reach; s += 0.5)
            weight += 0.5 * shape<Basis>(s) * shape<Basis>(height + slope * s - k);
          node[across] = k;
          if (weight > 0.0) add_node(node, weight);
        }
        if (near) touching = grid_node.size();
      }
      finish(wall, first, touching);
    }
  }

  /// The grid lines between two coordinates [m], both included.
  [[nodiscard]] std::array<std::int32_t, 2> lines(int axis, double from, double to) const {
    const double first = std::ceil((from - grid.origin[axis]) / grid.h - 1e-9);
    const double last = std::floor((to - grid.origin[axis]) / grid.h + 1e-9);
    return {static_cast<std::int32_t>(std::max<double>(first, low[axis])),
            static_cast<std::int32_t>(std::min<double>(last, high[axis]))};
  }
};

/// A straight piece of the ground; ends may be infinite.
struct Piece {
  double x0, y0, x1, y1;  ///< [m]
  [[nodiscard]] double height(double x) const { return y0 == y1 ? y0 : y0 + (x - x0) * slope(); }
  [[nodiscard]] double slope() const { return y0 == y1 ? 0.0 : (y1 - y0) / (x1 - x0); }
  [[nodiscard]] bool steep() const { return std::abs(y1 - y0) > x1 - x0; }
  [[nodiscard]] std::array<double, 2> normal() const {
    if (y0 == y1) return {0.0, 1.0};
    const double length = std::hypot(x1 - x0, y1 - y0);
    return {(y0 - y1) / length, (x1 - x0) / length};
  }
};

std::vector<Piece> pieces(const Ground& g) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<Piece> all{{-far, g.height.front(), g.x.front(), g.height.front()}};
  for (std::size_t i = 0; i + 1 < g.x.size(); ++i)
    if (g.x[i] != g.x[i + 1] || g.height[i] != g.height[i + 1])
      all.push_back({g.x[i], g.height[i], g.x[i + 1], g.height[i + 1]});
  all.push_back({g.x.back(), g.height.back(), far, g.height.back()});
  return all;
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
  Placing<Dim> place{grid, c, {}, {}, {}};
  place.low.fill(std::numeric_limits<std::int32_t>::max());
  place.high.fill(std::numeric_limits<std::int32_t>::min());
  for (const auto& block : grid.blocks) {
    for (int d = 0; d < Dim; ++d) {
      place.low[d] = std::min(place.low[d], block[d] * B);
      place.high[d] = std::max(place.high[d], block[d] * B + B - 1);
    }
  }
  const auto in_cells = [&](int axis, double x) { return (x - grid.origin[axis]) / grid.h; };

  for (const double x : {rollers.left, rollers.right}) {
    if (!std::isfinite(x)) continue;
    WallPoint<Dim> wall;
    wall.normal[0] = x == rollers.left ? 1.0 : -1.0;
    wall.holds = true;
    for (std::int32_t k = place.low[up]; k <= place.high[up]; ++k)
      place.template add<Basis>(up, 0, k, in_cells(0, x), 0.0, wall);
  }
  if constexpr (Dim == 3) {
    for (const double y : {rollers.near, rollers.far}) {
      if (!std::isfinite(y)) continue;
      WallPoint<Dim> wall;
      wall.normal[1] = y == rollers.near ? 1.0 : -1.0;
      wall.holds = true;
      for (std::int32_t k = place.low[up]; k <= place.high[up]; ++k)
        place.template add<Basis>(up, 1, k, in_cells(1, y), 0.0, wall);
    }
  }
  // Grid lines behind a roller still carry nodes whose functions reach the soil.
  const double reach = 0.5 * Basis::nodes * grid.h * (1.0 - 1e-9);
  const double first_x = rollers.left - reach, last_x = rollers.right + reach;
  WallPoint<Dim> level;
  level.normal[up] = 1.0;
  level.friction = ground.friction;
  std::array<double, 2> last_normal{};
  std::int32_t last_line = 0;
  for (const Piece& piece : pieces(ground)) {
    WallPoint<Dim> wall = level;
    const std::array<double, 2> normal = piece.normal();
    wall.normal[0] = normal[0];
    wall.normal[up] = normal[1];
    if (!piece.steep()) {
      const auto [first, last] =
          place.lines(0, std::max(first_x, piece.x0), std::min(last_x, piece.x1));
      for (std::int32_t k = first; k <= last; ++k) {
        const bool again = k == last_line && normal == last_normal;  // where pieces meet
        if (!again)
          place.template add<Basis>(0, up, k,
                                    in_cells(up, piece.height(grid.origin[0] + grid.h * k)),
                                    piece.slope(), wall);
        last_line = k;
        last_normal = normal;
      }
    } else {
      const double slope = (piece.x1 - piece.x0) / (piece.y1 - piece.y0);
      const auto [bottom, top] = std::minmax(piece.y0, piece.y1);
      const auto [first, last] = place.lines(up, bottom, top);
      for (std::int32_t k = first; k <= last; ++k) {
        const double x = piece.x0 + (grid.origin[up] + grid.h * k - piece.y0) * slope;
        if (x >= first_x && x <= last_x)
          place.template add<Basis>(up, 0, k, in_cells(0, x), slope, wall);
      }
    }
  }

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
  c.uses.resize(c.nodes.size());
  c.active.reserve(c.walls.size());
  c.coupled.reserve(c.walls.size());
}

#define FLOWSLIDE_PLACE(DIM, BASIS)                                                      \
  template void place_walls<DIM, BASIS>(const Grid<DIM>&, const Ground&, const Rollers&, \
                                        Contact<DIM>&);
FLOWSLIDE_PLACE(2, Linear)
FLOWSLIDE_PLACE(2, Gimp)
FLOWSLIDE_PLACE(2, QuadraticBSpline)
FLOWSLIDE_PLACE(2, CubicBSpline)
FLOWSLIDE_PLACE(3, Linear)
FLOWSLIDE_PLACE(3, Gimp)
FLOWSLIDE_PLACE(3, QuadraticBSpline)
FLOWSLIDE_PLACE(3, CubicBSpline)
#undef FLOWSLIDE_PLACE

}  // namespace flowslide::mpm
