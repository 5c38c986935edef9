#pragma once
#include "config/schema.hpp"
#include "constitutive/materials.hpp"
#include "model/mesh.hpp"
#include "transfer/audit/audit_limits.hpp"
#include "transfer/seeding/polygon.hpp"
#include "transfer/zone/section_box.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Settings of the transfer from finite elements to material points. docs/theory/transfer.md
namespace flowslide {

enum class Seeding { lattice, gauss };
enum class MappedStress { total, effective };
enum class FrictionStress { effective, total };
enum class StrengthPerPoint { interpolated, element };
enum class InitialStrain { plastic, total, zero };
enum class BaseReference { bottom_left, mean };

/// A material of the finite-element model and what becomes of it.
struct MapMaterial {
  std::vector<std::string> of;  ///< materials of the section; empty: that of the same name
  MaterialSettings law;         ///< of soil that has not liquefied
  std::optional<ResidualStrength::Params> liquefied;  ///< S_r and c_soft come with each point
  bool counts_for_runout = true;
};

struct MapConfig {
  double cell = kUnset;                 ///< cell of the MPM grid [m]
  std::array<double, 2> grid_origin{};  ///< a node of the MPM grid [m]
  int points_per_cell = 2;              ///< per direction
  Seeding seeding = Seeding::lattice;
  double sliver_fraction = 0.01;
  double mls_radius = 1.9;
  MappedStress mapped_stress = MappedStress::total;
  SectionBox box;  ///< of what becomes points
  bool remove_base_motion = true;
  BaseReference base = BaseReference::bottom_left;
  FrictionStress friction_acts_on = FrictionStress::effective;
  LiquefiedReturn liquefied_return = LiquefiedReturn::vertical_stress;
  StrengthPerPoint strength = StrengthPerPoint::interpolated;
  std::optional<double> c_soft_ratio;  ///< c_soft / S_r [-]
  InitialStrain initial_strain = InitialStrain::plastic;
  std::map<std::string, MapMaterial> materials;
  AuditLimits audit;
};

/// The materials of the section that become the one of that name.
std::vector<std::string> sources_of(const std::string& name, const MapMaterial& material);

/// The box with its open sides far away.
Box box_of(const SectionBox& box);

/// Relations that ranges cannot express: no source twice, one law per material, box in order,
/// c_soft given where soil may liquefy. Throws InputError.
void check(const MapConfig& config);

template <>
struct Schema<MapMaterial> {
  static constexpr std::string_view doc =
      "A material of the finite-element model and its law in the runout.";
  static void describe(FieldVisitor& v, MapMaterial& m);
};

template <>
struct Schema<MapConfig> {
  static constexpr std::string_view doc =
      "From the finite-element state at the moment of transfer to material points.";
  static void describe(FieldVisitor& v, MapConfig& c);
};

}  // namespace flowslide
