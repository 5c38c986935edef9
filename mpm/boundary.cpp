#include "mpm/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {

double Ground::level(double at) const {
  if (at <= x.front()) return height.front();
  if (at >= x.back()) return height.back();
  const auto right = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const double t = (at - x[right - 1]) / (x[right] - x[right - 1]);
  return height[right - 1] + t * (height[right] - height[right - 1]);
}

double Ground::slope(double at) const {
  if (at <= x.front() || at >= x.back()) return 0.0;
  const auto right = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  return (height[right] - height[right - 1]) / (x[right] - x[right - 1]);
}

template <int Dim>
void list_boundary_nodes(Grid<Dim>& grid, const Ground& ground, const Rollers& rollers) {
  constexpr int B = kBlockWidth<Dim>;
  const double tolerance = 1e-9 * grid.h;
  grid.boundary.clear();
  grid.boundary_first.clear();
  for (const Coordinate<Dim>& block : grid.blocks) {
    grid.boundary_first.push_back(static_cast<std::int32_t>(grid.boundary.size()));
    for (int n = 0; n < kBlockNodes<Dim>; ++n) {
      std::array<double, Dim> at{};
      for (int d = 0, rest = n; d < Dim; ++d, rest /= B)
        at[d] = grid.origin[d] + grid.h * (block[d] * B + rest % B);
      const bool wall = at[0] <= rollers.left + tolerance || at[0] >= rollers.right - tolerance;
      // The wall first: where it meets the ground, both conditions act one after the other.
      if (wall) {
        BoundaryNode<Dim> node{n, 1, {}, 0.0};
        node.normal[0] = 1.0;
        grid.boundary.push_back(node);
      }
      if (at[Dim - 1] <= ground.level(at[0]) + tolerance) {
        const double slope = ground.slope(at[0]), length = std::sqrt(1.0 + slope * slope);
        BoundaryNode<Dim> node{n, 0, {}, ground.friction};
        node.normal[0] = wall ? 0.0 : -slope / length;
        node.normal[Dim - 1] = wall ? 1.0 : 1.0 / length;
        grid.boundary.push_back(node);
      }
    }
  }
  grid.boundary_first.push_back(static_cast<std::int32_t>(grid.boundary.size()));
}

template void list_boundary_nodes<2>(Grid<2>&, const Ground&, const Rollers&);
template void list_boundary_nodes<3>(Grid<3>&, const Ground&, const Rollers&);

}  // namespace flowslide::mpm
