#pragma once
#include "model/history.hpp"

#include <string>
#include <vector>

namespace flowslide {

/// Total vertical stress of a state at rest against the weight of the soil above, density times
/// thickness. Empty where they agree in the median of the deeper elements; else by how much they
/// differ and what would fit: the unit of stress, its sign, the order of its columns, the sign of
/// the pore pressure, or other densities. `unit` is that of the stress [Pa].
std::string weight_warning(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                           const FemFrame& gravity, double unit);

}  // namespace flowslide
