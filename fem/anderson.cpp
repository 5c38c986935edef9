#include "fem/anderson.hpp"

#include <algorithm>

namespace flowslide::fem {
namespace {

/// One of the reflections of a factorisation: I - tau v v^T with v = (1, essential) from row k on.
template <class V>
void reflect(const V& essential, double tau, Eigen::Index k, Eigen::VectorXd& x) {
  if (tau == 0.0) return;
  const double along = essential.dot(x.tail(essential.size())) + x[k];
  x[k] -= tau * along;
  x.tail(essential.size()) -= along * (tau * essential);
}

}  // namespace

Anderson::Anderson(Eigen::VectorXd weights, int depth)
    : weights_(std::move(weights)),
      dx_(weights_.size(), depth),
      df_(weights_.size(), depth),
      share_(depth) {
  for (int columns = 0; columns <= depth; ++columns) qr_.emplace_back(weights_.size(), columns);
}

bool Anderson::find_shares(Eigen::Index columns, const Eigen::VectorXd& f) {
  auto& qr = qr_[static_cast<std::size_t>(columns)];
  qr.compute(weights_.asDiagonal() * df_.leftCols(columns));
  target_ = weights_.cwiseProduct(f);
  const Eigen::Index pivots = qr.nonzeroPivots();
  for (Eigen::Index k = 0; k < pivots; ++k)
    reflect(qr.matrixQR().col(k).tail(target_.size() - k - 1), qr.hCoeffs()[k], k, target_);
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
  x += f;
  for (Eigen::Index k = 0; k < columns; ++k) x -= share_[k] * (dx_.col(k) + df_.col(k));
}

}  // namespace flowslide::fem
