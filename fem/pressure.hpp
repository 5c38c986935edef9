#pragma once
#include "fem/factor.hpp"
#include "fem/layout.hpp"

#include <vector>

/// Pore pressure at the nodes: storage n/K_f (lumped), stabilisation alpha on the gradient of its
/// rate, Darcy flow with permeability k/gamma_w. docs/theory/fem.md, "Water"
namespace flowslide::fem {

struct PressureSystem {
  std::vector<std::int32_t> equation;  ///< of each node; number of equations where u is known
  std::int32_t num_equations = 0;
  Gather flow;                                 ///< equations from entries 4 e + i
  std::vector<double> mobility_x, mobility_y;  ///< present k/gamma_w of each element [m3 s/kg]
  std::vector<double> alpha;                   ///< of each element [m2/Pa]
  std::vector<double> storage;                 ///< of each equation [m3/Pa]
  BandFactor factor;
  double factor_dt = kUnset;  ///< step that `factor` belongs to [s]
};

/// Unknowns and storage; mobilities from the materials. `alpha` is left at zero.
PressureSystem make_pressure_system(const Model& model, const Layout& layout);

/// Pore pressures of steady flow with the mobilities of the system [Pa], one per node. Known ones
/// are kept, nodes without an unknown get 0. Throws NumericsError where no boundary sets a level.
std::vector<double> steady_pressure(const Model& model, const Layout& layout,
                                    const PressureSystem& system);

/// S + alpha L.
Eigen::SparseMatrix<double> storage_matrix(const PressureSystem& system, const Layout& layout);

/// Factorises storage + alpha L + dt H for steps of `dt`.
void factorise(PressureSystem& system, const Layout& layout, double dt);

}  // namespace flowslide::fem
