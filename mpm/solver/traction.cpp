#include "mpm/solver/traction.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide::mpm {

template <int Dim>
void find_points(std::vector<Load<Dim>>& loads, const Points<Dim>& points,
                 const Tiling<Dim>& tiling) {
  if (loads.empty()) return;
  for (Load<Dim>& load : loads) load.point = load.tile = -1;
  for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
    for (std::int32_t q = tiling.tiles[t].first; q < tiling.tiles[t].last; ++q) {
      const std::int32_t index = points.index[q];
      auto load = std::lower_bound(loads.begin(), loads.end(), index,
                                   [](const Load<Dim>& l, std::int32_t i) { return l.index < i; });
      for (; load != loads.end() && load->index == index; ++load) {
        load->point = q;
        load->tile = static_cast<std::int32_t>(t);
      }
    }
  }
}

std::size_t add_traction(const Traction& t, double depth, const Points<2>& p,
                         std::vector<Load<2>>& loads) {
  const double dx = t.to[0] - t.from[0], dy = t.to[1] - t.from[1], length = hypot(dx, dy);
  const std::array<double, 2> along{dx / length, dy / length}, normal{-along[1], along[0]};
  const std::size_t first = loads.size();
  double volume = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double x = p.x[0][q] - t.from[0], y = p.x[1][q] - t.from[1];
    const double s = x * along[0] + y * along[1], below = -(x * normal[0] + y * normal[1]);
    if (!(s >= 0.0 && s <= length && below >= 0.0 && below < depth)) continue;
    Load<2> load{p.index[q], t.begin, std::max(t.ramp, std::numeric_limits<double>::min())};
    load.normal = normal;
    load.above = depth - below;
    for (int d = 0; d < 2; ++d)
      load.force[d] = (t.shear * along[d] - t.pressure * normal[d]) * p.volume[q];
    volume += p.volume[q];
    loads.push_back(load);
  }
  // Where soil fills the depth below the stretch, `volume` is length times depth.
  for (std::size_t i = first; i < loads.size(); ++i)
    for (double& f : loads[i].force) f *= length / volume;
  std::stable_sort(loads.begin(), loads.end(),
                   [](const Load<2>& a, const Load<2>& b) { return a.index < b.index; });
  return loads.size() - first;
}

template void find_points<2>(std::vector<Load<2>>&, const Points<2>&, const Tiling<2>&);
template void find_points<3>(std::vector<Load<3>>&, const Points<3>&, const Tiling<3>&);

}  // namespace flowslide::mpm
