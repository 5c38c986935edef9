#pragma once
#include "fem/solver.hpp"

#include <Eigen/Core>

/// The equations of a small section of PM4Sand in full matrices, assembled apart from the solver.
namespace flowslide::fem {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// M dv/dt + F(stress) - Q p + (c + beta K) v = w and S dp/dt + H p + Q^T v + g = 0, `S` with the
/// stabilisation; pressures of all nodes.
struct Operators {
  Matrix K, Q, S, H;
  Vector gravity_flow;
};

Operators assemble(const Solver& s);

struct Trial {
  std::vector<Stress<2>> stress;
  std::vector<PM4Sand::State> sand;
  Vector force;  ///< of effective stress; hourglass motion is elastic, K without the strain part
};

/// Stress after displacements `du` and its nodal forces.
Trial deform(const Solver& s, const Vector& du);

}  // namespace flowslide::fem
