#include "section/transfinite.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"

namespace flowslide {
std::vector<double> length_shares(const std::vector<Vec2>& line) {
  std::vector<double> s(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) s[i] = s[i - 1] + distance(line[i - 1], line[i]);
  for (double& x : s) x /= s.back();
  return s;
}

std::vector<Vec2> transfinite(const GridSides& g) {
  FLOWSLIDE_EXPECT(g.bottom.size() == g.top.size() && g.left.size() == g.right.size());
  const std::size_t nx = g.bottom.size(), ny = g.left.size();
  const std::vector<double> ub = length_shares(g.bottom), ut = length_shares(g.top);
  const std::vector<double> vl = length_shares(g.left), vr = length_shares(g.right);
  std::vector<Vec2> points;
  points.reserve(nx * ny);
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      // Where the line from bottom i to top i meets that from left j to right j in the unit square.
      const double du = ut[i] - ub[i], dv = vr[j] - vl[j];
      const double u = (ub[i] + vl[j] * du) / (1.0 - du * dv);
      const double v = vl[j] + u * dv;
      Vec2 p{};
      for (std::size_t k = 0; k < 2; ++k)
        p[k] = (1 - v) * g.bottom[i][k] + v * g.top[i][k] + (1 - u) * g.left[j][k] +
               u * g.right[j][k] - (1 - u) * (1 - v) * g.bottom[0][k] -
               u * (1 - v) * g.bottom[nx - 1][k] - (1 - u) * v * g.top[0][k] -
               u * v * g.top[nx - 1][k];
      points.push_back(p);
    }
  return points;
}

}  // namespace flowslide
