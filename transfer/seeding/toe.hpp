#pragma once
#include "model/mesh.hpp"
#include "transfer/seeding/polygon.hpp"

#include <cstdint>
#include <vector>

namespace flowslide {

/// Datum of the runout: x of the downstream end, before deformation, of the elements that count and
/// whose centre lies inside the box [m]; unset if none does. `counts` per element.
double toe_of(const QuadMesh& mesh, const std::vector<std::uint8_t>& counts, const Box& box);

}  // namespace flowslide
