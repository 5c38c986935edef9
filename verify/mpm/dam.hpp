#pragma once
#include "model/particle_set.hpp"
#include "mpm/run/flow_config.hpp"

/// The static dam of workflows/mochikoshi-static.yaml without its foundation, filled with a lattice
/// and with stresses by depth, in plane strain or as a straight valley.
namespace flowslide::mpm {

struct DamScene {
  double cell = 5.0;        ///< [m]; two points per cell and direction
  double upstream = 340.0;  ///< length of the pond before the lower dam [m]
  double width = 0.0;       ///< of the valley between smooth walls [m]; 0: plane strain
  bool walls = true;        ///< false: the soil is free to leave the valley sideways
};

ParticleSet dam_points(const DamScene& scene);
FlowConfig dam_config(const DamScene& scene);

}  // namespace flowslide::mpm
