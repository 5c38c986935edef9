#pragma once
#include "model/mesh.hpp"
#include "model/particle_set.hpp"

namespace flowslide {

/// Acceleration |f_ext - f_int| / m of the first step on a grid with quadratic B-splines, in units
/// of g, over interior nodes: those whose 4 x 4 cells all hold at least `full_cell` of their
/// volume. Gravity is kGravity, down. At rest it is the error of the transfer; in a moving state it
/// holds the true acceleration too.
struct OutOfBalance {
  double rms = 0.0;
  double max = 0.0;
  Vec2 worst{};   ///< node of the maximum [m]
  int nodes = 0;  ///< interior nodes; 0 means nothing was measured
};

/// `origin` is a node of the grid, `cell` its spacing [m]. Plane strain; stress is total. Lattice
/// points fill cells evenly; points placed by elements need a `full_cell` near a half.
OutOfBalance out_of_balance(const ParticleSet& particles, double cell, Vec2 origin,
                            double full_cell = 0.95);

}  // namespace flowslide
