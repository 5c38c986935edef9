#include "fem/time_step.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace flowslide::fem {
namespace {

/// B M^-1 B^T times volume, with the unknowns that are held left out.
Eigen::Matrix3d compliance(const Solver& s, std::size_t e) {
  const Elements& g = s.layout.elements;
  const double m = s.model.materials[s.layout.material[e]].density;
  Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d x{g.bx[i][e], 0.0, g.by[i][e]}, y{0.0, g.by[i][e], g.bx[i][e]};
    r += (x * x.transpose() + y * y.transpose()) / (m * g.share[i][e]);
  }
  return r;
}

/// Square of the largest angular frequency of an element by itself [1/s2].
double element_frequency(const Solver& s, std::size_t e) {
  const Elements& g = s.layout.elements;
  const Eigen::Matrix3d W = compliance(s, e);
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  C.topLeftCorner<2, 2>().setConstant(s.lambda[e]);
  C(0, 0) += 2.0 * s.shear[e];
  C(1, 1) += 2.0 * s.shear[e];
  C(2, 2) = s.shear[e];
  const double density = s.model.materials[s.layout.material[e]].density;
  double gg = 0.0;
  for (int i = 0; i < 4; ++i)
    gg += g.gamma[i][e] * g.gamma[i][e] / (density * g.volume[e] * g.share[i][e]);
  const double spread = hypot(g.hss[e] - g.htt[e], 2.0 * g.hst[e]);
  const double hourglass = 0.5 * (g.hss[e] + g.htt[e] + spread) * s.hourglass_shear[e] * gg;
  // On parallelograms the two kinds of motion are orthogonal; elsewhere nearly so.
  return std::max(largest_eigenvalue(C * W), hourglass);
}

}  // namespace

double largest_eigenvalue(const Eigen::Matrix3d& matrix) {
  const double t = matrix.trace();
  // Without its mean, the polynomial has no terms that cancel where the roots nearly coincide.
  const Eigen::Matrix3d m = matrix - t / 3.0 * Eigen::Matrix3d::Identity();
  const auto minor = [&m](int i, int j) { return m(i, i) * m(j, j) - m(i, j) * m(j, i); };
  const double q = minor(0, 1) + minor(0, 2) + minor(1, 2), d = m.determinant();
  double x = 2.0 / 3.0 * t;
  for (int i = 0; i < 80; ++i) {
    const double way = ((x * x + q) * x - d) / (3.0 * x * x + q);
    if (!(way > 0.0)) break;
    x -= way;
    if (way <= 1e-6 * (t / 3.0 + x)) break;
  }
  return t / 3.0 + x;
}

double soil_frequency(const Solver& s) {
  double worst = 0.0;
#pragma omp parallel for schedule(static) reduction(max : worst)
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
    worst = std::max(worst, element_frequency(s, e));
  return worst;
}

void limit_stiffness_damping(Solver& s, double largest_ratio) {
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) {
    const double most = 2.0 * largest_ratio / std::sqrt(element_frequency(s, e));
    s.stiffness_damping[e] = std::min(s.stiffness_damping[e], most);
  }
}

double water_frequency(Solver& s) {
  const Layout& l = s.layout;
  const Elements& g = l.elements;
  if (s.water.num_equations == 0) return 0.0;
  factorise(s.water, l, 0.0);
  std::vector<double> v(s.model.num_dofs + 1), f(8 * g.size()), q(4 * g.size(), 0.0);
  std::vector<double> p(s.water.num_equations + 1, 0.0);
  // a fixed start that holds all wave lengths
  std::uint64_t random = 1;
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    v[u] = static_cast<double>(random >> 40) / 16777216.0 - 0.5;
  }
  for (std::int32_t u : s.model.base_dofs) v[u] = 0.0;
  double lambda = 0.0;
  for (int pass = 0; pass < 60; ++pass) {
    double norm = 0.0;
    for (std::int32_t u = 0; u < s.model.num_dofs; ++u) norm += l.mass[u] * v[u] * v[u];
    norm = std::sqrt(norm);
    if (!(norm > 0.0)) return 0.0;
    for (double& x : v) x /= norm;
    v[s.model.num_dofs] = 0.0;
    for (std::size_t e = 0; e < g.size(); ++e) {
      double volumetric = 0.0;
      for (int i = 0; i < 4; ++i)
        volumetric += g.bx[i][e] * v[l.dofs[e][2 * i]] + g.by[i][e] * v[l.dofs[e][2 * i + 1]];
      if (!l.saturated[e]) continue;
      for (int i = 0; i < 4; ++i) q[4 * e + i] = 0.25 * g.volume[e] * volumetric;
    }
    for (std::int32_t i = 0; i < s.water.num_equations; ++i) p[i] = s.water.flow.sum(i, q.data());
    s.water.factor.solve(p.data());
    p[s.water.num_equations] = 0.0;
    for (std::size_t e = 0; e < g.size(); ++e) {
      double u = 0.0;
      if (l.saturated[e])
        for (const std::int32_t node : l.nodes[e]) u += 0.25 * p[s.water.equation[node]];
      for (int i = 0; i < 4; ++i) {
        f[8 * e + 2 * i] = g.volume[e] * g.bx[i][e] * u;
        f[8 * e + 2 * i + 1] = g.volume[e] * g.by[i][e] * u;
      }
    }
    lambda = 0.0;
    for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
      const double force = l.forces.sum(u, f.data());
      lambda += force * v[u];
      v[u] = force / l.mass[u];
    }
    for (std::int32_t u : s.model.base_dofs) v[u] = 0.0;
  }
  return 1.05 * lambda;
}

double stable_step(const Frequencies& f, double beta) {
  const double a = 0.25 * (f.soil + f.water), b = 0.5 * beta * f.soil;
  return 2.0 / (b + std::sqrt(b * b + 4.0 * a));
}

double stable_step(const Solver& s, double water) {
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : least)
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
    least = std::min(least, stable_step({element_frequency(s, e), water}, s.stiffness_damping[e]));
  return least;
}

}  // namespace flowslide::fem
