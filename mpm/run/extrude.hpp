#pragma once
#include "model/particle_set.hpp"

/// A section as a straight valley in three dimensions.
namespace flowslide {

/// Copies every point of a plane-strain set across the width [m], as many times as keeps the
/// points' distance in the section; x stays, y runs across from 0 to `width`, z is up. Masses and
/// volumes are those of the copies; the copies of one point follow each other. Throws InputError.
ParticleSet extrude(const ParticleSet& section, double width);

}  // namespace flowslide
