#pragma once
#include "mpm/walls/wall_placing.hpp"

/// Wall points of a height field.
namespace flowslide::mpm {

/// Places them on the upright grid lines, and where the ground is steeper than 45 degrees on those
/// lines along x or y that it faces more squarely; and the net of points below the ground.
template <class Basis>
void place_terrain(Placing<3>& place, const HeightField& field, double friction,
                   const Rollers& rollers);

}  // namespace flowslide::mpm
