#include "transfer/sordo2024/radial.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace flowslide {
namespace {

constexpr std::size_t kMaxCentres = 20000;
constexpr double kResidual = 1e-6;

double multiquadric(const Vec2& a, const Vec2& b, double epsilon) {
  const double x = a[0] - b[0];
  const double y = a[1] - b[1];
  const double r = std::sqrt(x * x + y * y) / epsilon;
  return std::sqrt(r * r + 1.0);
}

Eigen::MatrixXd weights(const std::vector<Vec2>& centres, const Eigen::MatrixXd& values,
                        double epsilon) {
  const auto n = static_cast<Eigen::Index>(centres.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i)
      matrix(i, j) = multiquadric(centres[i], centres[j], epsilon);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
  Eigen::MatrixXd w = lu.solve(values);
  const Eigen::MatrixXd residual = matrix * w - values;
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const double largest = values.col(k).cwiseAbs().maxCoeff();
    // Coincident centres leave NaN, or weights so large that the residual shows them.
    if (!(residual.col(k).cwiseAbs().maxCoeff() <= kResidual * largest)) {
      throw NumericsError(
          fmt::format("the multiquadric interpolation of field {} through {} element centres "
                      "failed (two elements at one place make its matrix singular) look for "
                      "duplicate elements in the mesh",
                      k + 1, centres.size()));
    }
  }
  return w;
}

}  // namespace

double multiquadric_epsilon(const std::vector<Vec2>& centres) {
  validate(!centres.empty(), "no centres to interpolate from (the mesh has no elements)");
  double product = 1.0;
  int edges = 0;
  for (int d = 0; d < 2; ++d) {
    const auto [low, high] = std::minmax_element(
        centres.begin(), centres.end(), [d](const Vec2& a, const Vec2& b) { return a[d] < b[d]; });
    const double edge = (*high)[d] - (*low)[d];
    if (edge != 0.0) {
      product *= edge;
      ++edges;
    }
  }
  validate(edges > 0, "all {} element centres lie in one point (no spacing can be found)",
           centres.size());
  return pow(product / static_cast<double>(centres.size()), 1.0 / edges);
}

Eigen::MatrixXd interpolate_multiquadric(const std::vector<Vec2>& centres,
                                         const Eigen::MatrixXd& values,
                                         const std::vector<Vec2>& targets) {
  FLOWSLIDE_EXPECT(static_cast<std::size_t>(values.rows()) == centres.size());
  validate(centres.size() <= kMaxCentres,
           "{} elements are too many for the dense multiquadric interpolation (its matrix would "
           "take {:.0f} GB) use another mapping method, or a mesh of at most {} elements",
           centres.size(), 8e-9 * static_cast<double>(centres.size() * centres.size()),
           kMaxCentres);
  validate(values.allFinite(),
           "the fields to interpolate hold values that are not finite (one would spoil all) check "
           "the stress and strain of the imported frame");
  const double epsilon = multiquadric_epsilon(centres);
  const Eigen::MatrixXd w = weights(centres, values, epsilon);
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(targets.size()), w.cols());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < w.rows(); ++j)
      result.row(i) += multiquadric(targets[i], centres[j], epsilon) * w.row(j);
  }
  return result;
}

}  // namespace flowslide
