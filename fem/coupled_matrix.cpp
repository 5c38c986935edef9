#include "fem/coupled_matrix.hpp"

#include "fem/stiffness.hpp"

#include <algorithm>
#include <array>

namespace flowslide::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Rows of the twelve unknowns of an element: its eight motions, then its four pressures.
std::array<std::int32_t, 12> rows(const Solver& s, const std::vector<std::int32_t>& row,
                                  std::int32_t motions, std::size_t e) {
  std::array<std::int32_t, 12> r;
  for (int i = 0; i < 8; ++i) r[i] = row[s.layout.dofs[e][i]];
  for (int i = 0; i < 4; ++i) {
    const std::int32_t q = s.water.equation[s.layout.nodes[e][i]];
    const bool unknown = s.layout.saturated[e] && q < s.water.num_equations;
    r[8 + i] = unknown ? motions + q : -1;
  }
  return r;
}

/// Position of an entry in the values of a compressed matrix that has it.
std::int32_t place_of(const Sparse& m, std::int32_t row, std::int32_t column) {
  const auto* begin = m.innerIndexPtr() + m.outerIndexPtr()[column];
  const auto* end = m.innerIndexPtr() + m.outerIndexPtr()[column + 1];
  return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - m.innerIndexPtr());
}

}  // namespace

CoupledMatrix::CoupledMatrix(const Solver& s) : pressures_(s.water.num_equations) {
  row_.assign(s.model.num_dofs + 1, -1);
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (!s.prescribed[u]) row_[u] = motions_++;
  storage_ = storage_matrix(s.water, s.layout);

  std::vector<Eigen::Triplet<double>> terms;
  for (std::int32_t i = 0; i < size(); ++i) terms.emplace_back(i, i, 0.0);
  const std::size_t n = s.layout.elements.size();
  for (std::size_t e = 0; e < n; ++e) {
    const auto r = rows(s, row_, motions_, e);
    for (const std::int32_t i : r)
      for (const std::int32_t j : r)
        if (j >= 0 && i > j) terms.emplace_back(i, j, 0.0);
  }
  signed_.resize(size());
  ordered_.resize(size());
  matrix_.resize(size(), size());
  matrix_.setFromTriplets(terms.begin(), terms.end());
  matrix_.makeCompressed();
  place_.assign(144 * n, -1);
  for (std::size_t e = 0; e < n; ++e) {
    const auto r = rows(s, row_, motions_, e);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        if (r[j] >= 0 && r[i] >= r[j]) place_[144 * e + 12 * i + j] = place_of(matrix_, r[i], r[j]);
  }
  factor_ = std::make_unique<Eigen::SimplicialLDLT<Sparse, Eigen::Lower>>();
  factor_->analyzePattern(matrix_);
}

void CoupledMatrix::add_elements(const Solver& s, double dt, double theta) {
  const Elements& g = s.layout.elements;
  double* values = matrix_.valuePtr();
  for (std::size_t e = 0; e < g.size(); ++e) {
    Eigen::Matrix<double, 12, 12> J = Eigen::Matrix<double, 12, 12>::Zero();
    const Elasticity c{.bulk = s.lambda[e] + 2.0 / 3.0 * s.shear[e], .shear = s.shear[e]};
    J.topLeftCorner<8, 8>() =
        (theta * s.stiffness_damping[e] + theta * theta * dt) * stiffness(s, e, c);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        J(8 + i, 2 * j) = -theta * 0.25 * g.volume[e] * g.bx[j][e];
        J(8 + i, 2 * j + 1) = -theta * 0.25 * g.volume[e] * g.by[j][e];
        J(8 + i, 8 + j) =
            -g.volume[e] *
            ((s.water.alpha[e] / dt + theta * s.water.mobility_x[e]) * g.bx[i][e] * g.bx[j][e] +
             (s.water.alpha[e] / dt + theta * s.water.mobility_y[e]) * g.by[i][e] * g.by[j][e]);
      }
    }
    J.topRightCorner<8, 4>() = J.bottomLeftCorner<4, 8>().transpose();
    const std::int32_t* place = &place_[144 * e];
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        if (place[12 * i + j] >= 0) values[place[12 * i + j]] += J(i, j);
  }
}

void CoupledMatrix::factorise(const Solver& s, double dt, double theta) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  add_elements(s, dt, theta);
  // the diagonal comes first in each column of a lower half
  const auto diagonal = [&](std::int32_t i) -> double& {
    return matrix_.valuePtr()[matrix_.outerIndexPtr()[i]];
  };
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (row_[u] >= 0) diagonal(row_[u]) += s.layout.mass[u] / dt + theta * s.dashpot[u];
  for (std::int32_t q = 0; q < pressures_; ++q) diagonal(motions_ + q) -= s.water.storage[q] / dt;
  factor_->factorize(matrix_);
  if (factor_->info() != Eigen::Success)
    throw NumericsError(fmt::format(
        "the matrix of the implicit step at {:.4f} s is singular (stiffness or storage has become "
        "zero or is not a number) look at the states before",
        s.state.time));
  inverse_diagonal_ = factor_->vectorD().cwiseInverse();
}

void CoupledMatrix::solve(const Eigen::VectorXd& residual, Eigen::VectorXd& change) {
  signed_ = residual;
  signed_.tail(pressures_) *= -1.0;
  // Step by step, because factor_->solve() allocates.
  ordered_.noalias() = factor_->permutationP() * signed_;
  factor_->matrixL().solveInPlace(ordered_);
  ordered_.array() *= inverse_diagonal_.array();
  factor_->matrixU().solveInPlace(ordered_);
  change.noalias() = factor_->permutationPinv() * ordered_;
}

}  // namespace flowslide::fem
