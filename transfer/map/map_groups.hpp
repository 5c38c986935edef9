#pragma once
#include "constitutive/materials.hpp"
#include "model/history_material.hpp"
#include "model/mesh.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/seeding/polygon.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace flowslide {

/// A material of the runout. Families are the entries of MapConfig::materials in their order: a
/// family has one group, or two where part of it has liquefied. Points take stress from elements of
/// their family only.
struct MapGroup {
  MaterialSpec spec;
  AnyMaterial law;
  std::int32_t family = 0;
  bool liquefied = false;
};

struct MapGroups {
  std::vector<MapGroup> groups;      ///< index = ParticleSet::material
  std::vector<std::int32_t> group;   ///< elements; -1: unknown material outside the box
  std::vector<std::int32_t> family;  ///< elements; -1 likewise
  std::vector<double> density;       ///< elements [kg/m3]
};

/// Throws InputError for a name that the section does not have, for an element inside the box whose
/// material becomes none, and for liquefied elements whose material has no law `liquefied`.
MapGroups group_elements(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                         const std::vector<Vec2>& positions, const Box& box,
                         const LiquefactionZone& zone, const MapConfig& config);

}  // namespace flowslide
