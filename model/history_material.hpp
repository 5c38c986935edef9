#pragma once
#include "core/check.hpp"
#include "model/mesh.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// A soil of a section by the name that every stage knows it by, and what later stages need of it.
struct HistoryMaterial {
  std::string name;
  std::int32_t tag = 0;      ///< as in QuadMesh::element_material
  double density = kUnset;   ///< before deformation, of grains and water together [kg/m3]
  double porosity = kUnset;  ///< [-]; unset where the source did not tell
  std::string law = {};      ///< of the shaking; empty where the source did not tell
};

/// Every tag of the mesh has one material, and every name one tag; densities are positive. Throws
/// InputError naming element, tag or material.
void check(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials);

/// The material of that name. Throws InputError with the names that there are; `setting` says who
/// asks. A tag in place of a name, as older versions took it, is answered with the name.
const HistoryMaterial& find_material(const std::vector<HistoryMaterial>& materials,
                                     std::string_view name, std::string_view setting);

/// Density of every element [kg/m3], by its tag. Throws InputError for a tag without a material.
std::vector<double> element_densities(const QuadMesh& mesh,
                                      const std::vector<HistoryMaterial>& materials);

}  // namespace flowslide
