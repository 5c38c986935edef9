#pragma once
#include "fem/solver.hpp"

/// Permeability that follows the excess pore pressure. docs/theory/fem.md, "Permeability of
/// liquefied sand"
namespace flowslide::fem {

/// Permeability over that at rest, at an excess pore-pressure ratio `r_u`: 1 at 0 or less, `factor`
/// at 1 or more.
double permeability_factor(const PermeabilityRise& rise, double r_u);

/// From here on the permeability of materials that have a rise follows their pore pressure, whose
/// excess counts from the present one. After solve_gravity.
void let_permeability_rise(Solver& s);

/// Share by which a permeability may be off before it is taken anew.
inline constexpr double kPermeabilityChange = 0.05;

/// Permeabilities at the present pore pressure, all anew where one has changed by more than
/// kPermeabilityChange; the next step then factorises the matrix of the water, which allocates.
/// Without let_permeability_rise nothing changes. Before each step.
void refresh_permeability(Solver& s);

}  // namespace flowslide::fem
