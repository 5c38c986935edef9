#pragma once
#include "model/history_material.hpp"

#include <set>

#include <fmt/format.h>

namespace flowslide::test {

/// A material "soil N" of one density [kg/m3] for every tag N of a mesh.
inline std::vector<HistoryMaterial> materials_of(const QuadMesh& mesh, double density = 2000.0) {
  std::vector<HistoryMaterial> materials;
  for (const std::int32_t tag :
       std::set<std::int32_t>(mesh.element_material.begin(), mesh.element_material.end()))
    materials.push_back({fmt::format("soil {}", tag), tag, density});
  return materials;
}

}  // namespace flowslide::test
