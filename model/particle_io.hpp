#pragma once
#include "model/field_store.hpp"
#include "model/particle_set.hpp"

/// Particles as a part of a larger file. Private to this module.
namespace flowslide {

void write_particles(FieldWriter& out, const ParticleSet& p);
ParticleSet read_particles(const FieldReader& in);

}  // namespace flowslide
