#include "mpm/walls/place_terrain.hpp"

namespace flowslide::mpm {
namespace {

/// Heights [cells] of the ground at half steps of the grid, from half a cell before the first node
/// of the active blocks to half a cell after the last.
class HalfSteps {
 public:
  HalfSteps(const Placing<3>& place, const HeightField& field) : low_{place.low} {
    for (int d = 0; d < 2; ++d) count_[d] = 2 * (place.high[d] - place.low[d] + 1) + 1;
    const auto coordinate = [&](int d, int i) {
      return place.grid.origin[d] + place.grid.h * (low_[d] + 0.5 * (i - 1));
    };
    height_.reserve(std::size_t(count_[0]) * count_[1]);
    for (int j = 0; j < count_[1]; ++j)
      for (int i = 0; i < count_[0]; ++i)
        height_.push_back(place.in_cells(2, field.at(coordinate(0, i), coordinate(1, j))));
  }
  [[nodiscard]] int count(int d) const { return count_[d]; }
  [[nodiscard]] double at(int i, int j) const { return height_[std::size_t(j) * count_[0] + i]; }
  /// Place of a node in the table.
  [[nodiscard]] int of_node(int d, std::int32_t node) const { return 2 * (node - low_[d]) + 1; }
  [[nodiscard]] double node_at(int d, double i) const { return low_[d] + 0.5 * (i - 1.0); }
  /// Mean slope over the cell around a place with neighbours on all sides.
  [[nodiscard]] std::array<double, 2> slope(int i, int j) const {
    return {at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1)};
  }

 private:
  Coordinate<3> low_;
  std::array<int, 2> count_{};
  std::vector<double> height_;
};

/// Unit normal of z(x, y) from its slopes.
std::array<double, 3> normal_of(double slope_x, double slope_y) {
  const double length = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  return {-slope_x / length, -slope_y / length, 1.0 / length};
}

/// A plane that crosses the grid line in direction `across` through a node at `height`; `slope` is
/// how it rises along the two other axes, in their order, both within [-1, 1] [cells].
struct Crossing {
  int across;
  Coordinate<3> line;
  double height;
  std::array<double, 2> slope;
};

/// Adds its wall point: the mean over the plane, weighted with the shape functions of the line, of
/// those of the line's nodes. The quarter points are those of a lattice with two points per cell.
template <class Basis>
void add_crossing(Placing<3>& place, const Crossing& c, const WallPoint<3>& wall) {
  constexpr double reach = 0.5 * Basis::nodes;
  constexpr int most = 4 * Basis::nodes;  // 2 reach in each direction, and the support
  const double tilt = reach * (std::abs(c.slope[0]) + std::abs(c.slope[1]));
  const auto lowest = static_cast<std::int32_t>(base_node<Basis>(c.height - tilt));
  std::array<double, most> share{};
  for (double s = 0.25 - reach; s < reach; s += 0.5) {
    for (double t = 0.25 - reach; t < reach; t += 0.5) {
      double w[Basis::nodes], g[Basis::nodes];
      const double at = c.height + c.slope[0] * s + c.slope[1] * t;
      const double base = base_node<Basis>(at);
      Basis::evaluate(at - base, w, g);
      const double area = 0.25 * shape<Basis>(s) * shape<Basis>(t);
      for (int i = 0; i < Basis::nodes; ++i)
        share[static_cast<int>(base) - lowest + i] += area * w[i];
    }
  }
  const std::size_t first = place.grid_node.size();
  std::size_t touching = first;
  Coordinate<3> node = c.line;
  for (const bool near : {true, false}) {
    for (int k = 0; k < most; ++k) {
      const double above = (lowest + k - c.height) * wall.normal[c.across];
      if (!(share[k] > 0.0) || (above < 0.5 + 1e-9) != near) continue;
      node[c.across] = lowest + k;
      place.add_node(node, share[k]);
    }
    if (near) touching = place.grid_node.size();
  }
  place.finish(wall, first, touching);
}

/// Wall points on the grid lines along `across` (0 or 1) where the ground is steep: every pair of
/// neighbours in the table between which it passes a level of the grid.
template <class Basis>
void place_steep(Placing<3>& place, const HalfSteps& table, const WallPoint<3>& like, int across,
                 const std::array<std::int32_t, 2>& lines) {
  const int other = 1 - across;
  const auto at = [&](int i, int j) { return across == 0 ? table.at(i, j) : table.at(j, i); };
  for (std::int32_t line = lines[0]; line <= lines[1]; ++line) {
    const int j = table.of_node(other, line);
    for (int i = 0; i + 1 < table.count(across); ++i) {
      const double a = at(i, j), b = at(i + 1, j), rise = 2.0 * (b - a);
      if (!(std::abs(rise) > 1.0)) continue;
      const double sideways =
          0.5 * (at(i, j + 1) - at(i, j - 1) + at(i + 1, j + 1) - at(i + 1, j - 1));
      const bool faces =
          across == 0 ? std::abs(rise) >= std::abs(sideways) : std::abs(rise) > std::abs(sideways);
      if (!faces) continue;
      WallPoint<3> wall = like;
      wall.normal = across == 0 ? normal_of(rise, sideways) : normal_of(sideways, rise);
      const auto top =
          static_cast<std::int32_t>(std::min<double>(std::floor(std::max(a, b)), place.high[2]));
      auto k = static_cast<std::int32_t>(std::max<double>(std::ceil(std::min(a, b)), place.low[2]));
      for (; k <= top; ++k) {
        if ((a < k) == (b < k)) continue;
        Crossing c{across, {}, table.node_at(across, i + (k - a) / (b - a)), {}};
        c.line[other] = line;
        c.line[2] = k;
        c.slope = {-sideways / rise, 1.0 / rise};
        add_crossing<Basis>(place, c, wall);
      }
    }
  }
}

/// Single nodes below the ground that catch what has slipped through.
void place_terrain_net(Placing<3>& place, const HalfSteps& table, const WallPoint<3>& like) {
  constexpr int B = kBlockWidth<3>;
  for (const auto& block : place.grid.blocks) {
    for (int n = 0; n < kBlockNodes<3>; ++n) {
      const Coordinate<3> node{block[0] * B + n % B, block[1] * B + n / B % B,
                               block[2] * B + n / (B * B)};
      const int i = table.of_node(0, node[0]), j = table.of_node(1, node[1]);
      const auto [slope_x, slope_y] = table.slope(i, j);
      WallPoint<3> wall = like;
      wall.normal = normal_of(slope_x, slope_y);
      const double depth = (table.at(i, j) - node[2]) * wall.normal[2];
      if (!(depth > kNetFrom && depth < kNetTo)) continue;
      const std::size_t first = place.grid_node.size();
      place.add_node(node, 1.0);
      place.finish(wall, first, place.grid_node.size());
    }
  }
}

}  // namespace

template <class Basis>
void place_terrain(Placing<3>& place, const HeightField& field, double friction,
                   const Rollers& rollers) {
  if (place.grid.blocks.empty()) return;
  const HalfSteps table(place, field);
  // Grid lines behind a roller still carry nodes whose functions reach the soil.
  const double reach = 0.5 * Basis::nodes * place.grid.h * (1.0 - 1e-9);
  const auto in_x = place.lines(0, rollers.left - reach, rollers.right + reach);
  const auto in_y = place.lines(1, rollers.near - reach, rollers.far + reach);
  WallPoint<3> like;
  like.friction = friction;
  for (std::int32_t j = in_y[0]; j <= in_y[1]; ++j) {
    for (std::int32_t i = in_x[0]; i <= in_x[1]; ++i) {
      const int column = table.of_node(0, i), row = table.of_node(1, j);
      const auto slope = table.slope(column, row);
      // Written so that no data give no wall.
      if (!(std::abs(slope[0]) <= 1.0 && std::abs(slope[1]) <= 1.0)) continue;
      WallPoint<3> wall = like;
      wall.normal = normal_of(slope[0], slope[1]);
      const double height = table.at(column, row);
      if (!(height > place.low[2] - 4.0 * Basis::nodes &&
            height < place.high[2] + 4.0 * Basis::nodes))
        continue;
      add_crossing<Basis>(place, {2, {i, j, 0}, height, slope}, wall);
    }
  }
  place_steep<Basis>(place, table, like, 0, in_y);
  place_steep<Basis>(place, table, like, 1, in_x);
  place_terrain_net(place, table, like);
}

#define FLOWSLIDE_PLACE(BASIS) \
  template void place_terrain<BASIS>(Placing<3>&, const HeightField&, double, const Rollers&);
FLOWSLIDE_PLACE(Linear)
FLOWSLIDE_PLACE(Gimp)
FLOWSLIDE_PLACE(QuadraticBSpline)
FLOWSLIDE_PLACE(CubicBSpline)
FLOWSLIDE_PLACE(MovingLeastSquares)
#undef FLOWSLIDE_PLACE

}  // namespace flowslide::mpm
