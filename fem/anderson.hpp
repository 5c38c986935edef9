#pragma once
#include <Eigen/Core>

namespace flowslide::fem {

/// Acceleration of a fixed-point iteration x <- x + f(x) by the differences of its last few steps
/// (Anderson 1965, as in Walker & Ni 2011): the combination of them is taken whose f is smallest.
class Anderson {
 public:
  /// @param weights of the unknowns in the norm of f
  Anderson(Eigen::VectorXd weights, int depth);
  /// Forgets all steps.
  void restart() { used_ = 0; }
  /// The next x.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& f);

 private:
  Eigen::VectorXd weights_, last_x_, last_f_;
  Eigen::MatrixXd dx_, df_;  ///< differences of successive x and f, a ring of columns
  int used_ = 0;             ///< number of x seen since the restart
};

}  // namespace flowslide::fem
