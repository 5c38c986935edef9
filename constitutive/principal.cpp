#include "constitutive/principal.hpp"

namespace flowslide {

Eigen3 eigen_symmetric(const Stress<3>& s) noexcept {
  double a[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  // Cyclic Jacobi converges quadratically; six sweeps reach round-off for any symmetric 3 x 3.
  for (int sweep = 0; sweep < 6; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t =
            std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), sn = t * c;
        for (auto& row : a) {
          const double x = row[p], y = row[q];
          row[p] = c * x - sn * y;
          row[q] = sn * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - sn * y;
          a[q][k] = sn * x + c * y;
        }
        for (auto& row : v) {
          const double x = row[p], y = row[q];
          row[p] = c * x - sn * y;
          row[q] = sn * x + c * y;
        }
      }
    }
  }
  Eigen3 e{};
  for (int i = 0; i < 3; ++i) {
    e.value[i] = a[i][i];
    for (int k = 0; k < 3; ++k) e.vector[i][k] = v[k][i];
  }
  return e;
}

}  // namespace flowslide
