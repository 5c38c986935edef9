#include "fem/anderson.hpp"

#include <algorithm>

namespace flowslide::fem {

Anderson::Anderson(Eigen::VectorXd weights, int depth)
    : weights_(std::move(weights)),
      dx_(weights_.size(), depth),
      df_(weights_.size(), depth),
      sum_(weights_.size(), depth),
      share_(depth),
      correction_(weights_.size()),
      work_(1) {
  for (int columns = 0; columns <= depth; ++columns) qr_.emplace_back(weights_.size(), columns);
}

bool Anderson::find_shares(Eigen::Index columns, const Eigen::VectorXd& f) {
  auto& qr = qr_[static_cast<std::size_t>(columns)];
  qr.compute(weights_.asDiagonal() * df_.leftCols(columns));
  target_ = weights_.cwiseProduct(f);
  const Eigen::Index pivots = qr.nonzeroPivots();
  const Eigen::Index n = target_.size();
  for (Eigen::Index k = 0; k < pivots; ++k)
    target_.bottomRightCorner(n - k, 1).applyHouseholderOnTheLeft(
        qr.matrixQR().block<Eigen::Dynamic, 1>(k + 1, k, n - k - 1, 1), qr.hCoeffs()[k],
        work_.data());
  qr.matrixQR()
      .topLeftCorner(pivots, pivots)
      .triangularView<Eigen::Upper>()
      .solveInPlace(target_.head(pivots));
  share_.head(columns).setZero();
  const auto& place = qr.colsPermutation().indices();
  for (Eigen::Index i = 0; i < pivots; ++i) share_[place[i]] = target_[i];
  return share_.head(columns).allFinite();
}

void Anderson::advance(Eigen::VectorXd& x, const Eigen::VectorXd& f) {
  const auto depth = static_cast<int>(dx_.cols());
  if (used_ > 0) {
    const int column = (used_ - 1) % depth;
    dx_.col(column) = x - last_x_;
    df_.col(column) = f - last_f_;
  }
  last_x_ = x;
  last_f_ = f;
  const int columns = std::min(used_++, depth);
  if (columns == 0 || !find_shares(columns, f)) {
    x += f;
    return;
  }
  sum_.leftCols(columns) = dx_.leftCols(columns) + df_.leftCols(columns);
  correction_.noalias() = sum_.leftCols(columns) * share_.head(columns);
  x += f;
  x -= correction_;
}

}  // namespace flowslide::fem
