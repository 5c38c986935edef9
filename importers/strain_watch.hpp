#pragma once
#include "model/history.hpp"

#include <array>
#include <string>
#include <vector>

namespace flowslide {

/// Holds recorded strains against those of the displacements, for an exchange of columns, tensor
/// shear strain in place of engineering, another sign or unit.
///
/// Products of what has been recorded since the first state, strains r with gradients g of the
/// displacement at the centres of the elements, are summed; every guess about r is a combination
/// d = c.g, and its error |r - f d|^2 follows from the sums.
class StrainWatch {
 public:
  explicit StrainWatch(const QuadMesh& mesh);
  void look_at(const FemFrame& frame);
  /// Empty where they agree, or nothing has been strained.
  [[nodiscard]] std::string warning() const;

 private:
  using Gradient = std::array<double, 4>;  ///< u_x,x u_x,y u_y,x u_y,y

  [[nodiscard]] double product(std::size_t recorded, const Gradient& combination) const;
  [[nodiscard]] double square(const Gradient& combination) const;
  [[nodiscard]] double correlation(std::size_t recorded, const Gradient& combination) const;
  [[nodiscard]] std::string describe_columns() const;
  [[nodiscard]] bool turned() const;

  const QuadMesh& mesh_;
  std::vector<std::array<Vec2, 4>> slopes_;  ///< of the shape functions at the centres [1/m]
  std::vector<Vec2> first_displacement_;
  std::vector<StrainIncrement<2>> first_strain_;
  std::size_t num_states_ = 0;
  std::array<double, 3> rr_{};  ///< r.r of xx, yy, xy
  std::array<std::array<double, 4>, 3> rg_{};
  std::array<std::array<double, 4>, 4> gg_{};
};

}  // namespace flowslide
