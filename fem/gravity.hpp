#pragma once
#include "fem/solver.hpp"

namespace flowslide::fem {

struct GravitySettings {
  /// Permeability of every material while water settles [m/s]; unset: the materials' own.
  double permeability = kUnset;
  /// Lower the void ratio by the volume change of the elastic stage, as OpenSees does. Off: the
  /// void ratio of the materials is that of the ground as it lies.
  bool compacts = false;
};

/// The state at rest: steady pore pressure, then linear elastic soil under its own weight with the
/// base held, K_0 following from the materials' gravity_poisson where the ground is level; then the
/// laws take over at this stress. Fills stress, pore pressure, states and hourglass displacements;
/// displacements stay zero. Throws NumericsError where the section is not held.
void solve_gravity(Solver& s, const GravitySettings& settings);

/// Softening over `length` [m], for laws that can: docs/theory/pm4sand.md, "A length for
/// softening". After solve_gravity.
void spread_softening(Solver& s, double length);

/// Largest out-of-balance force over the weight of the heaviest unknown [-].
double out_of_balance(Solver& s);

}  // namespace flowslide::fem
