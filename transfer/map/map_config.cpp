#include "transfer/map/map_config.hpp"

#include <set>

namespace flowslide {
namespace {

constexpr std::array<std::string_view, 2> kSeedingNames{"lattice", "gauss"};
constexpr std::array<std::string_view, 2> kMappedStressNames{"total", "effective"};
constexpr std::array<std::string_view, 2> kFrictionStressNames{"effective", "total"};
constexpr std::array<std::string_view, 3> kLiquefiedReturnNames{"vertical_stress", "mean_stress",
                                                                "none"};
constexpr std::array<std::string_view, 2> kStrengthNames{"interpolated", "element"};
constexpr std::array<std::string_view, 3> kInitialStrainNames{"plastic", "total", "zero"};
constexpr std::array<std::string_view, 2> kBaseNames{"bottom_left", "mean"};
constexpr std::array<std::string_view, 2> kCompatNames{"none", "sordo2024"};

}  // namespace

void Schema<MapMaterial>::describe(FieldVisitor& v, MapMaterial& m) {
  v.integers("tags", m.tags, "element material tags of the finite-element model");
  v.quantity("density", m.density, Dim::density, {.above = 0.0}, "density before deformation");
  describe_laws(v, m.law);
  v.group("liquefied", m.liquefied,
          "law of the part that liquefies; strength and soft_strength come with each point");
  v.flag("counts_for_runout", m.counts_for_runout, "false for soil that is no part of the slide");
}

void Schema<MapConfig>::describe(FieldVisitor& v, MapConfig& c) {
  v.quantity("cell", c.cell, Dim::length, {.above = 0.0}, "cell of the MPM grid");
  v.tuple("grid_origin", c.grid_origin, Dim::length, "a node of the MPM grid");
  v.integer(
      "points_per_cell", c.points_per_cell, {.min = 1, .max = 8},
      "points per cell and direction; with seeding: gauss, per element and direction, at most 4");
  v.choice("seeding", c.seeding, kSeedingNames,
           "lattice: aligned with the MPM grid and clipped at material boundaries; gauss: at the "
           "Gauss points of the elements");
  v.quantity("sliver_fraction", c.sliver_fraction, Dim::none, {.min = 0.0, .max = 0.25},
             "clipped pieces below this share of a lattice cell join a neighbour");
  v.quantity("mls_radius", c.mls_radius, Dim::none, {.min = 1.2, .max = 6.0},
             "radius of the stress interpolation in element sizes");
  v.choice("mapped_stress", c.mapped_stress, kMappedStressNames,
           "which stress is interpolated; the other follows with the pore pressure of the point");
  v.numbers("box", c.box, Dim::length,
            "[xmin, xmax, ymin, ymax] of what becomes points, after removal of the base motion; "
            "empty: the whole mesh");
  v.flag("remove_base_motion", c.remove_base_motion,
         "positions, displacements and velocities relative to the base of the model");
  v.choice(
      "base", c.base, kBaseNames,
      "whose motion is the base motion: the bottom left node inside the box, or the mean of the "
      "lowest nodes");
  v.choice("friction_acts_on", c.friction_acts_on, kFrictionStressNames,
           "stress that Mohr-Coulomb soil feels: effective keeps the pore pressure of each point, "
           "total hands over none");
  v.choice("return", c.liquefied_return, kLiquefiedReturnNames,
           "what liquefied soil keeps when its stress is brought back to its residual strength");
  v.choice("strength", c.strength, kStrengthNames,
           "S_r of a point: interpolated between elements, or that of its element, which keeps "
           "binned layers apart");
  v.quantity(
      "c_soft_ratio", c.c_soft_ratio, Dim::none, {.max = 1.0, .above = 0.0},
      "c_soft / S_r, strength of liquefied soil after large strain; needed where soil liquefies");
  v.choice(
      "initial_strain", c.initial_strain, kInitialStrainNames,
      "plastic strain that points start with: deviatoric strain since the state at rest less its "
      "elastic part, all of it, or none");
  v.table("materials", c.materials, "materials of the finite-element model by name");
  v.group("audit", c.audit, Schema<AuditLimits>::doc);
  v.choice("compat", c.compat, kCompatNames,
           "sordo2024: repeat the published script, defects included");
  v.group("sordo2024", c.sordo2024, "settings of compat: sordo2024");
}

void check(const MapConfig& c) {
  if (c.compat == Compat::sordo2024) {
    validate(
        c.sordo2024.has_value(),
        "map: compat is sordo2024 but the group sordo2024 is missing (the script's constants are "
        "unknown). Add sordo2024: {{...}}");
    check(*c.sordo2024);
    return;
  }
  validate(
      !c.sordo2024.has_value(),
      "map: the group sordo2024 is given but compat is none (it would have no effect). Remove it "
      "or write compat: sordo2024");
  validate(!c.materials.empty(),
           "map: no materials (elements would have no density and no law). Add materials: {{...}}");
  validate(
      c.seeding == Seeding::lattice || c.points_per_cell <= 4,
      "map: points_per_cell {} with seeding gauss (rules go up to 4 points per direction). Use 4 "
      "or less, or seeding: lattice",
      c.points_per_cell);
  validate(c.box.empty() || c.box.size() == 4,
           "map: box has {} numbers (four are needed). Write [xmin, xmax, ymin, ymax]",
           c.box.size());
  if (c.box.size() == 4) {
    validate(c.box[0] < c.box[1] && c.box[2] < c.box[3],
             "map: box [{}, {}, {}, {}] is empty (order is xmin, xmax, ymin, ymax)", c.box[0],
             c.box[1], c.box[2], c.box[3]);
  }
  std::set<int> seen;
  for (const auto& [name, m] : c.materials) {
    validate(!m.tags.empty(), "map: material '{}' has no tags (no element would be of it)", name);
    for (const int tag : m.tags)
      validate(
          seen.insert(tag).second,
          "map: element material tag {} is listed twice (an element has one material); the second "
          "is in '{}'",
          tag, name);
    make_material(m.law, name);
    validate(!m.liquefied || c.c_soft_ratio,
             "map: c_soft_ratio is missing (material '{}' may liquefy and softens to c_soft = "
             "c_soft_ratio S_r). Add c_soft_ratio, for example 0.5",
             name);
  }
}

}  // namespace flowslide
