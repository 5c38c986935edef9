#pragma once
#include <vector>

#include <Eigen/QR>

namespace flowslide::fem {

/// Acceleration of a fixed-point iteration x <- x + f(x) by the differences of its last few steps
/// (Anderson 1965, as in Walker & Ni 2011): the combination of them is taken whose f is smallest.
class Anderson {
 public:
  /// @param weights of the unknowns in the norm of f
  Anderson(Eigen::VectorXd weights, int depth);
  /// Forgets all steps.
  void restart() { used_ = 0; }
  /// Replaces x by the next one. Does not allocate once it has seen as many x as it keeps.
  void advance(Eigen::VectorXd& x, const Eigen::VectorXd& f);

 private:
  /// Shares of the last differences of which f is the sum, by least squares; false where there are
  /// none.
  [[nodiscard]] bool find_shares(Eigen::Index columns, const Eigen::VectorXd& f);

  Eigen::VectorXd weights_, last_x_, last_f_;
  Eigen::MatrixXd dx_, df_;  ///< differences of successive x and f, a ring of columns
  int used_ = 0;             ///< number of x seen since the restart
  // Buffers: Eigen's own solve() allocates.
  std::vector<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> qr_;  ///< by number of columns
  Eigen::VectorXd target_, share_;
};

}  // namespace flowslide::fem
