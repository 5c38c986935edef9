#include "mpm/walls/absorbing.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace flowslide::mpm {
namespace {

template <int Dim>
bool before(const Dashpot<Dim>& a, const Dashpot<Dim>& b) {
  return std::tie(a.plane, a.line) < std::tie(b.plane, b.line);
}

/// Adds what a point near a plane gives to the lines around it, as dashpots of their own.
template <int Dim, class Basis>
void add_point(const Grid<Dim>& grid, const Points<Dim>& p, std::size_t q, const Elasticity& e,
               std::int32_t plane, std::vector<Dashpot<Dim>>& parts) {
  const int axis = plane / 2;
  const double density = p.mass[q] / p.volume[q], area = p.volume[q] / grid.h;
  const double normal = std::sqrt(density * (e.bulk + 4.0 / 3.0 * e.shear));
  const double shear = std::sqrt(density * e.shear);
  double w[Dim][Basis::nodes], g[Basis::nodes];
  std::array<std::int32_t, Dim> first{};
  for (int d = 0; d < Dim; ++d) {
    if (d == axis) continue;
    const double x = (p.x[d][q] - grid.origin[d]) / grid.h, base = base_node<Basis>(x);
    Basis::evaluate(x - base, w[d], g);
    first[d] = static_cast<std::int32_t>(base);
  }
  for (int n = 0; n < power<Dim - 1>(Basis::nodes); ++n) {
    Dashpot<Dim> part;
    part.plane = plane;
    double share = area;
    int rest = n;
    for (int d = 0; d < Dim; ++d) {
      if (d == axis) continue;
      part.line[d] = first[d] + rest % Basis::nodes;
      share *= w[d][rest % Basis::nodes];
      rest /= Basis::nodes;
    }
    part.area = share;
    part.normal = share * normal;
    part.shear = share * shear;
    parts.push_back(part);
  }
}

}  // namespace

template <int Dim, class Basis>
void measure_dashpots(const Grid<Dim>& grid, const Points<Dim>& p,
                      const std::vector<SolverMaterial>& materials, Absorbing<Dim>& absorbing) {
  std::vector<Dashpot<Dim>> parts;
  for (std::int32_t plane = 0; plane < 2 * Dim; ++plane) {
    const double at = absorbing.plane(plane), inward = plane % 2 == 0 ? 1.0 : -1.0;
    if (!std::isfinite(at)) continue;
    for (std::size_t q = 0; q < p.size(); ++q)
      if ((p.x[plane / 2][q] - at) * inward < grid.h)
        add_point<Dim, Basis>(grid, p, q, materials[p.material[q]].elastic, plane, parts);
  }
  std::stable_sort(parts.begin(), parts.end(), before<Dim>);
  std::vector<Dashpot<Dim>> now;
  for (const Dashpot<Dim>& part : parts) {
    if (now.empty() || before(now.back(), part)) now.push_back({part.plane, part.line});
    now.back().area += part.area;
    now.back().normal += part.normal;
    now.back().shear += part.shear;
  }
  if (!absorbing.supported) {
    for (Dashpot<Dim>& d : now) d.area_start = d.area;
    absorbing.dashpots.swap(now);
    return;
  }
  // Lines that lost their soil keep their place: it may come back.
  std::vector<Dashpot<Dim>> all;
  auto old = absorbing.dashpots.begin();
  const auto last = absorbing.dashpots.end();
  const auto keep_bare = [&](const Dashpot<Dim>& d) {
    all.push_back(d);
    all.back().area = all.back().normal = all.back().shear = 0.0;
  };
  for (Dashpot<Dim>& d : now) {
    for (; old != last && before(*old, d); ++old) keep_bare(*old);
    if (old != last && !before(d, *old)) {
      d.area_start = old->area_start;
      d.support = old->support;
      ++old;
    }
    all.push_back(d);
  }
  for (; old != last; ++old) keep_bare(*old);
  absorbing.dashpots.swap(all);
}

#define FLOWSLIDE_MEASURE(DIM, BASIS)                                              \
  template void measure_dashpots<DIM, BASIS>(const Grid<DIM>&, const Points<DIM>&, \
                                             const std::vector<SolverMaterial>&, Absorbing<DIM>&);
FLOWSLIDE_MEASURE(2, Linear)
FLOWSLIDE_MEASURE(2, Gimp)
FLOWSLIDE_MEASURE(2, QuadraticBSpline)
FLOWSLIDE_MEASURE(2, CubicBSpline)
FLOWSLIDE_MEASURE(2, MovingLeastSquares)
FLOWSLIDE_MEASURE(3, Linear)
FLOWSLIDE_MEASURE(3, Gimp)
FLOWSLIDE_MEASURE(3, QuadraticBSpline)
FLOWSLIDE_MEASURE(3, CubicBSpline)
FLOWSLIDE_MEASURE(3, MovingLeastSquares)
#undef FLOWSLIDE_MEASURE

}  // namespace flowslide::mpm
