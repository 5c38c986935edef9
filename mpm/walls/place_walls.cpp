#include "core/check.hpp"
#include "core/elementary.hpp"
#include "mpm/walls/place_terrain.hpp"

/// Where walls act: wall points on the grid lines that the ground and the rollers cross.
namespace flowslide::mpm {
namespace {

/// A straight piece of the ground; ends may be infinite.
struct Piece {
  double x0, y0, x1, y1;  ///< [m]
  [[nodiscard]] double height(double x) const { return y0 == y1 ? y0 : y0 + (x - x0) * slope(); }
  [[nodiscard]] double slope() const { return y0 == y1 ? 0.0 : (y1 - y0) / (x1 - x0); }
  [[nodiscard]] bool steep() const { return std::abs(y1 - y0) > x1 - x0; }
  [[nodiscard]] std::array<double, 2> normal() const {
    if (y0 == y1) return {0.0, 1.0};
    const double length = hypot(x1 - x0, y1 - y0);
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

/// Wall points of one piece after the other. A grid line that ends one piece and begins the next,
/// which goes on in the same direction, gets one.
template <class Basis, int Dim>
class PiecePlacer {
 public:
  PiecePlacer(Placing<Dim>& place, const Ground& ground, const Rollers& rollers)
      : place_(place),
        friction_(ground.friction),
        first_x_(rollers.left - reach(place.grid.h)),
        last_x_(rollers.right + reach(place.grid.h)) {}

  void add(const Piece& piece) {
    WallPoint<Dim> wall{.friction = friction_};
    const std::array<double, 2> normal = piece.normal();
    wall.normal[0] = normal[0];
    wall.normal[kUp] = normal[1];
    if (piece.steep())
      add_steep(piece, wall);
    else
      add_flat(piece, wall);
  }

 private:
  static constexpr int kUp = Dim - 1;
  /// Grid lines this far behind a roller still carry nodes whose functions reach the soil [m].
  static double reach(double h) { return 0.5 * Basis::nodes * h * (1.0 - 1e-9); }

  void add_flat(const Piece& piece, const WallPoint<Dim>& wall) {
    const Grid<Dim>& grid = place_.grid;
    const std::array<double, 2> normal = piece.normal();
    const auto [first, last] =
        place_.lines(0, std::max(first_x_, piece.x0), std::min(last_x_, piece.x1));
    for (std::int32_t k = first; k <= last; ++k) {
      const bool again = k == last_line_ && normal == last_normal_;  // where pieces meet
      if (!again)
        place_.template add<Basis>(0, kUp, k,
                                   place_.in_cells(kUp, piece.height(grid.origin[0] + grid.h * k)),
                                   piece.slope(), wall);
      last_line_ = k;
      last_normal_ = normal;
    }
  }

  void add_steep(const Piece& piece, const WallPoint<Dim>& wall) {
    const Grid<Dim>& grid = place_.grid;
    const double slope = (piece.x1 - piece.x0) / (piece.y1 - piece.y0);
    const auto [bottom, top] = std::minmax(piece.y0, piece.y1);
    const auto [first, last] = place_.lines(kUp, bottom, top);
    for (std::int32_t k = first; k <= last; ++k) {
      const double x = piece.x0 + (grid.origin[kUp] + grid.h * k - piece.y0) * slope;
      if (x >= first_x_ && x <= last_x_)
        place_.template add<Basis>(kUp, 0, k, place_.in_cells(0, x), slope, wall);
    }
  }

  Placing<Dim>& place_;
  double friction_, first_x_, last_x_;
  std::array<double, 2> last_normal_{};
  std::int32_t last_line_ = 0;
};

/// Wall points at all nodes in a layer below the ground: what slips through is caught there.
template <int Dim>
void place_ground_net(Placing<Dim>& place, const Ground& ground) {
  constexpr int B = kBlockWidth<Dim>, up = Dim - 1;
  const Grid<Dim>& grid = place.grid;
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
      WallPoint<Dim> wall{.friction = ground.friction};
      wall.normal[0] = near.normal[0];
      wall.normal[up] = near.normal[1];
      const std::size_t first = place.grid_node.size();
      place.add_node(node, 1.0);
      place.finish(wall, first, place.grid_node.size());
    }
  }
}

/// Wall points of the ground, a polyline that does not vary along y.
template <class Basis, int Dim>
void place_polyline(Placing<Dim>& place, const Ground& ground, const Rollers& rollers) {
  PiecePlacer<Basis, Dim> placer(place, ground, rollers);
  for (const Piece& piece : pieces(ground)) placer.add(piece);
  place_ground_net(place, ground);
}

/// Wall points of an upright wall at a coordinate [m] of the axis; without it, if it is infinite.
template <class Basis, int Dim>
void place_upright(Placing<Dim>& place, int axis, double at, WallPoint<Dim> wall) {
  constexpr int up = Dim - 1;
  if (!std::isfinite(at)) return;
  for (std::int32_t k = place.low[up]; k <= place.high[up]; ++k)
    place.template add<Basis>(up, axis, k, place.in_cells(axis, at), 0.0, wall);
}

template <class Basis, int Dim>
void place_rollers(Placing<Dim>& place, const Rollers& rollers) {
  const auto pair = [&](int axis, double low, double high, WallPoint<Dim> wall) {
    wall.normal[axis] = 1.0;
    place_upright<Basis>(place, axis, low, wall);
    wall.normal[axis] = -1.0;
    place_upright<Basis>(place, axis, high, wall);
  };
  pair(0, rollers.left, rollers.right, {.kind = WallKind::roller});
  if constexpr (Dim == 3)
    pair(1, rollers.near, rollers.far,
         {.kind = rollers.side_friction > 0.0 ? WallKind::ground : WallKind::roller,
          .friction = rollers.side_friction});
}

template <class Basis, int Dim>
void place_dashpot(Placing<Dim>& place, const Absorbing<Dim>& absorbing, std::int32_t index) {
  const Dashpot<Dim>& dashpot = absorbing.dashpots[index];
  if (!(dashpot.area > 0.0)) return;
  const int axis = dashpot.plane / 2;
  const double at = place.in_cells(axis, absorbing.plane(dashpot.plane));
  WallPoint<Dim> wall{.kind = WallKind::absorbing, .dashpot = index};
  wall.normal[axis] = dashpot.plane % 2 == 0 ? 1.0 : -1.0;
  const auto lowest = static_cast<std::int32_t>(base_node<Basis>(at));
  const std::size_t first = place.grid_node.size();
  std::size_t touching = first;
  Coordinate<Dim> node = dashpot.line;
  for (const bool near : {true, false}) {
    for (std::int32_t k = lowest; k < lowest + Basis::nodes; ++k) {
      const double weight = shape<Basis>(at - k);
      if (((k - at) * wall.normal[axis] < 0.5 + 1e-9) != near || !(weight > 0.0)) continue;
      node[axis] = k;
      place.add_node(node, weight);
    }
    if (near) touching = place.grid_node.size();
  }
  place.finish(wall, first, touching);
}

template <int Dim>
void find_outermost_nodes(Placing<Dim>& place) {
  constexpr int B = kBlockWidth<Dim>;
  place.low.fill(std::numeric_limits<std::int32_t>::max());
  place.high.fill(std::numeric_limits<std::int32_t>::min());
  for (const auto& block : place.grid.blocks) {
    for (int d = 0; d < Dim; ++d) {
      place.low[d] = std::min(place.low[d], block[d] * B);
      place.high[d] = std::max(place.high[d], block[d] * B + B - 1);
    }
  }
}

/// Walls are placed line by line over all that the points span, mostly air where they fly apart.
template <int Dim>
void expect_few_lines(const Placing<Dim>& place) {
  constexpr double kMostLines = 1e8;
  double lines = 1.0, least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < Dim; ++d) {
    const double span = std::max(0.0, double(place.high[d]) - place.low[d]) + 1.0;
    lines *= span;
    least = std::min(least, span);
  }
  lines /= least;
  if (!(lines <= kMostLines))
    throw NumericsError(fmt::format(
        "the soil spans {:.2g} lines of a grid of {:.3g} m (walls are found on at most {:.0g}) use "
        "a larger cell, or an outlet for points that fly away",
        lines, place.grid.h, kMostLines));
}

/// The contact nodes are those of all entries; entries count in them from now on.
template <int Dim>
void number_nodes(const std::vector<std::int32_t>& grid_node, std::size_t blocks, Contact<Dim>& c) {
  c.nodes = grid_node;
  std::sort(c.nodes.begin(), c.nodes.end());
  c.nodes.erase(std::unique(c.nodes.begin(), c.nodes.end()), c.nodes.end());
  for (const std::int32_t node : grid_node)
    c.node.push_back(static_cast<std::int32_t>(
        std::lower_bound(c.nodes.begin(), c.nodes.end(), node) - c.nodes.begin()));
  c.in_block.assign(blocks, 0);
  for (const std::int32_t node : c.nodes)
    c.in_block[node / kBlockNodes<Dim>] |= std::uint64_t{1} << node % kBlockNodes<Dim>;
}

template <int Dim>
void size_buffers(Contact<Dim>& c) {
  c.velocity.resize(c.nodes.size());
  c.given.assign(c.nodes.size(), {});
  c.inverse_mass.resize(c.nodes.size());
  c.mobility.resize(c.walls.size());
  c.fresh.resize(c.walls.size());
  c.before.resize(c.absorbing.dashpots.size());
  c.uses.resize(c.nodes.size());
  c.active.reserve(c.walls.size());
  c.coupled.reserve(c.walls.size());
}

}  // namespace

template <int Dim, class Basis>
void place_walls(const Grid<Dim>& grid, const Ground& ground, const Rollers& rollers,
                 Contact<Dim>& c) {
  c.walls.clear();
  c.weight.clear();
  c.nodes.clear();
  c.node.clear();
  Placing<Dim> place{grid, c, {}, {}, {}};
  find_outermost_nodes(place);
  expect_few_lines(place);
  place_rollers<Basis>(place, rollers);
  if constexpr (Dim == 3) {
    if (ground.field)
      place_terrain<Basis>(place, *ground.field, ground.friction, rollers);
    else
      place_polyline<Basis>(place, ground, rollers);
  } else {
    place_polyline<Basis>(place, ground, rollers);
  }
  for (std::size_t i = 0; i < c.absorbing.dashpots.size(); ++i)
    place_dashpot<Basis>(place, c.absorbing, static_cast<std::int32_t>(i));
  number_nodes(place.grid_node, grid.blocks.size(), c);
  size_buffers(c);
}

#define FLOWSLIDE_PLACE(DIM, BASIS)                                                      \
  template void place_walls<DIM, BASIS>(const Grid<DIM>&, const Ground&, const Rollers&, \
                                        Contact<DIM>&);
FLOWSLIDE_PLACE(2, Linear)
FLOWSLIDE_PLACE(2, Gimp)
FLOWSLIDE_PLACE(2, QuadraticBSpline)
FLOWSLIDE_PLACE(2, CubicBSpline)
FLOWSLIDE_PLACE(2, MovingLeastSquares)
FLOWSLIDE_PLACE(3, Linear)
FLOWSLIDE_PLACE(3, Gimp)
FLOWSLIDE_PLACE(3, QuadraticBSpline)
FLOWSLIDE_PLACE(3, CubicBSpline)
FLOWSLIDE_PLACE(3, MovingLeastSquares)
#undef FLOWSLIDE_PLACE

}  // namespace flowslide::mpm
