#pragma once

/// What a run can choose about its discretisation. docs/theory/mpm.md
namespace flowslide::mpm {

/// Shape functions; mpm/basis.hpp.
enum class BasisKind { linear, gimp, quadratic, cubic };

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

}  // namespace flowslide::mpm
