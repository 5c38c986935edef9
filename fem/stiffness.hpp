#pragma once
#include "fem/solver.hpp"

#include <Eigen/Core>

namespace flowslide::fem {

/// B of element e: strains xx, yy, xy from the eight nodal displacements.
Eigen::Matrix<double, 3, 8> strain_matrix(const Elements& g, std::size_t e);

/// Stress xx, yy, xy from strain in plane strain [Pa].
Eigen::Matrix3d plane_strain(const Elasticity& c);

/// Of the skeleton with the hourglass stiffness of the solver [N/m].
Eigen::Matrix<double, 8, 8> stiffness(const Solver& s, std::size_t e, const Elasticity& c);

}  // namespace flowslide::fem
