#pragma once
#include "fem/solver.hpp"

namespace flowslide::fem {

/// Squares of angular frequencies that bound the step [1/s2].
struct Frequencies {
  double soil = 0.0;   ///< of the present elastic skeleton with its hourglass stiffness
  double water = 0.0;  ///< that undrained pore pressure adds
};

/// The largest eigenvalue of a matrix whose eigenvalues are real and not negative. Newton's method
/// on the characteristic polynomial falls monotonically from the trace, by a third of the way where
/// all roots coincide, and stops when its way is a millionth: the result errs to the safe side
/// only, by 2e-6 at triple roots.
double largest_eigenvalue(const Eigen::Matrix3d& matrix);

/// Bound of the skeleton by its elements: the largest frequency of the mesh is not above the
/// largest of a single free element (Irons).
double soil_frequency(const Solver& s);

/// Bounds the stiffness damping of each element by a share of what is critical for its own fastest
/// motion, with the elastic constants of the moment: beta = 2 D / w. docs/theory/fem.md, "Damping"
void limit_stiffness_damping(Solver& s, double largest_ratio);

/// Largest eigenvalue of M^-1 Q (S + alpha L)^-1 Q^T by power iteration, 5 % added. Uses the
/// scratch of the solver; not during a step.
double water_frequency(Solver& s);

/// Largest stable step of central differences with lagged stiffness damping:
/// (soil + water) dt^2/4 + beta soil dt/2 = 1.
double stable_step(const Frequencies& f, double beta);

/// The smallest of these over the elements, each with its own frequency and damping: elements that
/// pass it one by one pass it together, since stiffness, damping and mass are sums over elements.
double stable_step(const Solver& s, double water);

}  // namespace flowslide::fem
