#pragma once

/// What a run can choose about its discretisation. docs/theory/mpm.md
namespace flowslide::mpm {

/// Shape functions; mpm/kernels/basis.hpp.
enum class BasisKind { linear, gimp, quadratic, cubic, mls };

/// How points get their velocity from the grid.
/// apic, tpic: the grid's velocity, beside an affine field from its moments or its gradient.
/// aflip: with the affine field of apic, the point's own velocity plus the grid's change, relaxed
/// towards the grid's velocity with a time constant.
/// flip: own velocity plus the grid's change, blended with the grid's velocity by a fixed share.
/// pic: the grid's velocity alone.
/// fmpm: the grid's velocity after k terms of the series of the inverse of the full mass matrix.
enum class Transfer { apic, tpic, aflip, flip, pic, fmpm };

/// When the stress is updated in a step.
/// symplectic (also USL): after the momentum balance, from the grid's new velocity.
/// usf: before the forces are summed, from the velocity that the points bring.
/// musl: after the momentum balance, from the points' new velocities mapped to the grid again.
enum class Update { symplectic, usf, musl };

/// Whose changes of volume are averaged over cells (F-bar): those of the materials that would lock,
/// or of none.
enum class VolumeAverage { automatic, off };

/// What a user can set about the steps.
struct StepSettings {
  BasisKind basis = BasisKind::quadratic;
  Transfer transfer = Transfer::apic;
  Update update = Update::symplectic;
  double relaxation = 0.3;   ///< of aflip: time constant [s]
  double flip_share = 0.99;  ///< of flip; 0 is pic
  int fmpm_order = 2;        ///< of fmpm: terms of its series; 1 is pic
  VolumeAverage volume_average = VolumeAverage::automatic;
  double courant = 0.9;         ///< share of the stable step of docs/theory/time-step.md
  double velocity_limit = 0.2;  ///< cells the fastest point may cross in a step
  double strain_limit = 0.05;   ///< largest |L| dt aimed at
  double damping = 0.0;         ///< local, non-viscous (Cundall) [-]
};

}  // namespace flowslide::mpm
