#include "fem/stiffness.hpp"

namespace flowslide::fem {

Eigen::Matrix<double, 3, 8> strain_matrix(const Elements& g, std::size_t e) {
  Eigen::Matrix<double, 3, 8> B = Eigen::Matrix<double, 3, 8>::Zero();
  for (int i = 0; i < 4; ++i) {
    B(0, 2 * i) = B(2, 2 * i + 1) = g.bx[i][e];
    B(1, 2 * i + 1) = B(2, 2 * i) = g.by[i][e];
  }
  return B;
}

Eigen::Matrix3d plane_strain(const Elasticity& c) {
  const double lambda = c.bulk - 2.0 / 3.0 * c.shear;
  Eigen::Matrix3d C;
  C << lambda + 2.0 * c.shear, lambda, 0.0, lambda, lambda + 2.0 * c.shear, 0.0, 0.0, 0.0, c.shear;
  return C;
}

Eigen::Matrix<double, 8, 8> stiffness(const Solver& s, std::size_t e, const Elasticity& c) {
  const Elements& g = s.layout.elements;
  const auto B = strain_matrix(g, e);
  Eigen::Matrix<double, 8, 8> K = g.volume[e] * B.transpose() * plane_strain(c) * B;
  const double G = s.hourglass_shear[e];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double gg = G * g.gamma[i][e] * g.gamma[j][e];
      K(2 * i, 2 * j) += gg * g.hss[e];
      K(2 * i, 2 * j + 1) -= gg * g.hst[e];
      K(2 * i + 1, 2 * j) -= gg * g.hst[e];
      K(2 * i + 1, 2 * j + 1) += gg * g.htt[e];
    }
  }
  return K;
}

}  // namespace flowslide::fem
