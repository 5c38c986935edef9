#include "fem/anderson.hpp"

#include <algorithm>

#include <Eigen/QR>

namespace flowslide::fem {

Anderson::Anderson(Eigen::VectorXd weights, int depth)
    : weights_(std::move(weights)), dx_(weights_.size(), depth), df_(weights_.size(), depth) {}

Eigen::VectorXd Anderson::next(const Eigen::VectorXd& x, const Eigen::VectorXd& f) {
  const auto depth = static_cast<int>(dx_.cols());
  if (used_ > 0) {
    const int column = (used_ - 1) % depth;
    dx_.col(column) = x - last_x_;
    df_.col(column) = f - last_f_;
  }
  last_x_ = x;
  last_f_ = f;
  const int columns = std::min(used_++, depth);
  if (columns == 0) return x + f;
  const Eigen::MatrixXd weighted = weights_.asDiagonal() * df_.leftCols(columns);
  const Eigen::VectorXd target = weights_.cwiseProduct(f);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weighted);
  // differences that are nearly those of other steps would only amplify rounding
  qr.setThreshold(1e-8);
  const Eigen::VectorXd share = qr.solve(target);
  if (!share.allFinite()) return x + f;
  return x + f - (dx_.leftCols(columns) + df_.leftCols(columns)) * share;
}

}  // namespace flowslide::fem
