#pragma once
#include "model/particle_set.hpp"

namespace flowslide {

inline ParticleSet two_particles() {
  ParticleSet p;
  p.history["r_u"] = {};
  resize(p, 2);
  p.materials = {{"dam", "mohr_coulomb", {}, true}, {"tailings \xc3\xa4", "tresca", {}, true}};
  p.position = {{1.0 / 3.0, 2.0, 0.0}, {1e5 + 1e-9, 0.0, 0.0}};
  p.displacement = {{0.5, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  p.stress[1] = {1, 2, 3, 4, 5, 6};
  p.mass = {1.0, 2.0};
  p.volume = {1.0, 2.0};
  p.material = {1, 0};
  p.id = {5, 10000000000};
  p.history["r_u"] = {0.25, 0.75};
  return p;
}

}  // namespace flowslide
