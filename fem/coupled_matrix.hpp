#pragma once
#include "fem/solver.hpp"

#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>

namespace flowslide::fem {

/// Derivative of the residuals of an implicit step, motion and water together, with the present
/// elastic moduli:
///
///     [ M/dt + theta (C + beta K) + theta^2 dt K   -theta Q            ]
///     [ -theta Q^T                                 -(W/dt + theta H)   ]
///
/// W = S + alpha L. The second row has its sign turned, which makes the matrix symmetric and
/// quasi-definite: L D L^T exists in any order of the unknowns (Vanderbei 1995). The order and the
/// pattern of the factor are found once. docs/theory/fem.md, "Implicit steps"
class CoupledMatrix {
 public:
  explicit CoupledMatrix(const Solver& s);
  /// Velocities that are not prescribed, then pressures.
  [[nodiscard]] std::int32_t size() const { return motions_ + pressures_; }
  [[nodiscard]] std::int32_t motions() const { return motions_; }
  /// Unknown of the solver -> row; -1 where the velocity is known.
  [[nodiscard]] const std::vector<std::int32_t>& row_of() const { return row_; }
  /// S + alpha L of the pressures.
  [[nodiscard]] const Eigen::SparseMatrix<double>& storage() const { return storage_; }
  /// Throws NumericsError if the matrix is singular.
  void factorise(const Solver& s, double dt, double theta);
  /// Change of velocities [m/s] and pressures [Pa] that takes away the residuals, those of the
  /// pressures with their own sign. Does not allocate.
  void solve(const Eigen::VectorXd& residual, Eigen::VectorXd& change);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  void add_elements(const Solver& s, double dt, double theta);
  std::int32_t motions_ = 0, pressures_ = 0;
  std::vector<std::int32_t> row_;
  Sparse storage_, matrix_;  ///< lower half of the matrix
  /// Place of each of the 12 x 12 entries of an element in the values of the matrix; -1: none.
  std::vector<std::int32_t> place_;
  std::unique_ptr<Eigen::SimplicialLDLT<Sparse, Eigen::Lower>> factor_;
  Eigen::VectorXd inverse_diagonal_;  ///< of the factor
  Eigen::VectorXd signed_, ordered_;  ///< buffers of solve()
};

}  // namespace flowslide::fem
