#include "mpm/solver/outlet.hpp"

namespace flowslide::mpm {

template <int Dim>
bool any_beyond(const Outlet<Dim>& outlet, const Points<Dim>& points) {
  for (int d = 0; d < Dim; ++d)
    for (const double x : points.x[d])
      if (x < outlet.low[d] || x > outlet.high[d]) return true;
  return false;
}

template <int Dim>
void let_out(const Outlet<Dim>& outlet, Points<Dim>& points, Points<Dim>& gone) {
  if (!any_beyond(outlet, points)) return;
  const std::size_t n = points.size();
  std::vector<bool> beyond(n, false);
  for (int d = 0; d < Dim; ++d) {
    for (std::size_t q = 0; q < n; ++q) {
      const double x = points.x[d][q];
      if (x < outlet.low[d] || x > outlet.high[d]) beyond[q] = true;
    }
  }
  visit_arrays(points, gone, [&](auto& from, auto& to) {
    std::size_t kept = 0;
    for (std::size_t q = 0; q < n; ++q) {
      if (beyond[q])
        to.push_back(from[q]);
      else
        from[kept++] = from[q];
    }
    from.resize(kept);
  });
}

template bool any_beyond<2>(const Outlet<2>&, const Points<2>&);
template bool any_beyond<3>(const Outlet<3>&, const Points<3>&);
template void let_out<2>(const Outlet<2>&, Points<2>&, Points<2>&);
template void let_out<3>(const Outlet<3>&, Points<3>&, Points<3>&);

}  // namespace flowslide::mpm
