#pragma once
#include "model/mesh.hpp"

#include <vector>

#include <Eigen/Core>

/// Interpolation of scattered values by one global multiquadric per field.
///
///     f(x) = sum_j w_j phi(|x - c_j|),   phi(r) = sqrt((r / epsilon)^2 + 1),   f(c_i) = f_i
///
/// Hardy (1971), doi:10.1029/JB076i008p01905. No polynomial is added and nothing is smoothed: a
/// constant field is reproduced at the centres only. The dense matrix and its factors take 16 n^2
/// bytes, the work is 2/3 n^3 operations, so n is limited to 20000 centres.
namespace flowslide {

/// Mean spacing used for epsilon: (product of the bounding-box edges / number of centres)^(1/d),
/// d the number of edges that are not zero [m]. Throws InputError if all centres coincide.
double multiquadric_epsilon(const std::vector<Vec2>& centres);

/// Values at the targets, one row per target and one column per field. `values` has one row per
/// centre. The matrix is factorised once for all fields, on one thread, so that the result has the
/// same bits whatever the number of threads. Throws InputError for values that are not finite,
/// NumericsError if two centres coincide or the system cannot be solved to 1e-6 of the values.
Eigen::MatrixXd interpolate_multiquadric(const std::vector<Vec2>& centres,
                                         const Eigen::MatrixXd& values,
                                         const std::vector<Vec2>& targets);

}  // namespace flowslide
