#pragma once
#include "mpm/kernels/basis.hpp"
#include "mpm/walls/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// How wall points are linked to the nodes of the active blocks; shared by the files that place
/// them. docs/theory/contact.md
namespace flowslide::mpm {

// Wall points this far below the soil's side of the ground catch what has slipped through [cells].
inline constexpr double kNetFrom = 1.5, kNetTo = 4.5;

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

  [[nodiscard]] double in_cells(int axis, double x) const {
    return (x - grid.origin[axis]) / grid.h;
  }

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

}  // namespace flowslide::mpm
