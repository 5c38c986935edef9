#pragma once
#include "model/mpm_history.hpp"
#include "mpm/run/flow_config.hpp"
#include "mpm/solver/simulation.hpp"

/// Between ParticleSet and the solver's arrays.
namespace flowslide::mpm {

/// A simulation at time zero. In three dimensions z is up, the ground's polyline does not vary with
/// y, and grid_origin gives x and z. Throws InputError (unknown law, missing state, points inside
/// the ground) naming material and particle.
template <int Dim = 2>
Simulation<Dim> make_simulation(const ParticleSet& particles, const FlowConfig& config);

/// Fills a frame in the order of the ParticleSet; arrays must have its size.
template <int Dim>
void store_frame(const Simulation<Dim>& s, MpmFrame& frame);

}  // namespace flowslide::mpm
