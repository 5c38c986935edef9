#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

namespace flowslide::fem {

/// Cholesky factor L L^T of a symmetric positive definite matrix, kept as a band: the meshes of
/// sections are long and flat, so that the band is as sparse as any factor, and its loops are
/// contiguous. Eight rows are solved at a time, by the inverse of their block on the diagonal: row
/// by row each would wait for the one before.
class BandFactor {
 public:
  BandFactor() = default;
  /// Numbers the unknowns to a small band width (reverse Cuthill-McKee) from the pattern.
  explicit BandFactor(const Eigen::SparseMatrix<double>& pattern);
  /// Throws NumericsError if the matrix is not positive definite. Its pattern may be smaller than
  /// that of the constructor.
  void factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Replaces b by the solution. Does not allocate.
  void solve(double* b);
  [[nodiscard]] std::int32_t size() const { return n_; }
  [[nodiscard]] std::int32_t bandwidth() const { return width_; }

 private:
  void set_block(std::int32_t i);

  std::int32_t n_ = 0, width_ = 0;
  std::vector<std::int32_t> position_;  ///< unknown -> row
  std::vector<double> rows_;            ///< L[i][i - width_ .. i], row after row
  std::vector<double> inverse_;         ///< 1/L[i][i]
  // For solving, in blocks of rows; beyond the last row those of a unit matrix.
  std::int32_t reach_ = 0;          ///< columns left of a block, a multiple of its size
  std::vector<double> left_;        ///< L left of each block, row after row
  std::vector<std::int32_t> skip_;  ///< places of `left_` that hold zeros in all rows of a block
  std::vector<double> blocks_;  ///< inverses of the blocks on the diagonal, and their transposes
  std::vector<double> work_;    ///< as many zeros as a block reaches, and the unknowns
};

}  // namespace flowslide::fem
