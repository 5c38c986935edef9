#pragma once
#include "core/check.hpp"
#include "mpm/kernels/scheme.hpp"

/// Scenes of verify/mpm/dry_columns.cpp.
namespace flowslide::mpm {

enum class Shape { plane, channel, round };

/// How the angle of friction measured on a slope or in a shear box, tan(phi) = shear over normal
/// stress on the plane that slips, enters the law. docs/theory/mohr-coulomb.md, section 4
enum class Friction {
  rate,              ///< mu_i at rest: mu_s = tan(phi), with the rise of Jop et al. (2006)
  coulomb_plane,     ///< mohr_coulomb with the angle asin(tan(phi))
  coulomb_principal  ///< mohr_coulomb with phi itself
};

/// A column that leans on a smooth wall at x = 0 (or stands round on its axis), on rough ground.
struct DryColumn {
  Shape shape = Shape::plane;
  Friction law = Friction::rate;
  double aspect = 1.0;           ///< height over length or radius
  double length = 0.1;           ///< [m]
  double width = 0.0;            ///< of the channel [m]
  double friction = 0.0;         ///< tan of the angle measured [-]
  double ground = kUnset;        ///< friction of the ground; unset: that of the grains [-]
  double wall_friction = 0.0;    ///< of the channel's sides [-]
  double grain = 0.0;            ///< [m]
  double rise = 0.26;            ///< of friction in fast flow, and where half of it is reached, for
  double inertial = 0.279;       ///< mu_i: glass beads, Jop et al. (2006)
  double lode_dependence = 1.0;  ///< for mu_i
  double poisson_ratio = 0.3;
  Transfer transfer = Transfer::aflip;
  BasisKind basis = BasisKind::quadratic;
};

/// Sand of 1 mm at 30 degrees, 0.1 m long.
DryColumn sand(double aspect);
/// Angle at which a slide of the beads of Lajeunesse et al. (2005) stops [deg].
inline constexpr double kBeadsStop = 22.0;
/// These beads in their channel of 45 mm, with the angle at which a slide starts.
DryColumn beads(double aspect);

/// Kinetic energy, of the largest, at which a collapse is at rest: what still moves is the heap's
/// inside, its front and edge have stood since 4e-3 to four digits. Those that are not by then are
/// measured after 12.5 sqrt(height / g) all the same.
inline constexpr double kQuiet = 1e-3;

/// What is left when all is at rest, lengths over the first length.
struct Deposit {
  double front = 0.0;   ///< beyond it lies 0.5 % of the mass; past the first length
  double edge = 0.0;    ///< where it is as thin as a grain; past the first length
  double height = 0.0;  ///< at the wall or axis
  double motion = 0.0;  ///< kinetic energy that is left, of the largest: at rest below kQuiet
};

/// @param cells in the height or the length, whichever is less
Deposit collapse(const DryColumn& column, int cells);

}  // namespace flowslide::mpm
