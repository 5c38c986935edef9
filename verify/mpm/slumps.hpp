#pragma once
#include "mpm/kernels/scheme.hpp"
#include "verify/mpm/dry_columns.hpp"

/// Scenes of verify/mpm/columns.cpp: columns against a smooth wall on a base on which nothing
/// slides. docs/theory/verification-mpm.md, section Bars and clay.
namespace flowslide::mpm {

/// The aluminium bars of Bui et al. (2008): 0.2 m long, 0.1 m high, bars of 1 and 1.5 mm.
struct Bars {
  Friction law = Friction::rate;  ///< how 19.8 degrees of their shear box enter
  double rise = 0.28;             ///< of friction in fast flow, and where half of it is reached,
  double inertial = 0.4;          ///< for mu_i: discs, Lagree et al. (2011)
  double cell = 0.0025;           ///< [m]
  double ground = 1e6;            ///< friction coefficient of the base: nothing slides
  Transfer transfer = Transfer::aflip;
};

struct BarDeposit {
  double toe = 0.0;            ///< where the layer is as thin as a bar [m]
  double front = 0.0;          ///< beyond it lies 0.5 % of the mass [m]
  double height = 0.0;         ///< at the wall [m]
  double surface_error = 0.0;  ///< rms distance from the measured surface, over the first height
  double failure_error = 0.0;  ///< rms distance between the failure lines, over the first height
  double energy_error = 0.0;
};

BarDeposit collapse(const Bars& bars);

/// An undrained column, 1 m high, of constant strength: let go slowly: local damping keeps
/// inertia out.
struct Clay {
  double aspect = 1.0;   ///< height over length
  double b = 0.1;        ///< strength over rho g height [-]
  int cells = 20;        ///< in the height
  double damping = 0.7;  ///< local (Cundall)
  Transfer transfer = Transfer::aflip;
};

struct ClayDeposit {
  double foremost = 0.0;  ///< beyond it lies 0.2 % of the mass; over the first length
  double front = 0.0;     ///< 0.5 %
  double height = 0.0;    ///< 0.5 % lies above, over the first height
};

ClayDeposit collapse(const Clay& clay);

/// Whether an undrained vertical cut, 1 m high, of strength B = c / (rho g H) stands: it sags
/// elastically and stops, or it goes on.
bool cut_stands(double b, int cells_in_height);

}  // namespace flowslide::mpm
