#include "transfer/map/map_config.hpp"

#include "constitutive/left_to_points.hpp"

#include <set>
#include <variant>

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

}  // namespace

void Schema<MapMaterial>::describe(FieldVisitor& v, MapMaterial& m) {
  v.moved(
      "tags",
      "(materials go by their names) remove it; 'tailings: {...}' is the material 'tailings' of "
      "the section, and 'of: [clay, silt]' makes one of two");
  v.moved(
      "density",
      "(the shaking brings the densities of its materials) remove it; it is that of fem.run, or "
      "of import.opensees with 'materials: {tailings: {tag: 168, density: 1870 kg/m3}}'");
  v.texts("of", m.of,
          "materials of the section that become this one; left out: that of the same name");
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
  v.moved("box",
          "(its sides have names, as in transfer.zone) write 'box: {left: -340 m, right: 87.5 m, "
          "bottom: -5 m, top: 100 m}', or 'box: \"${stages.zone.with.box}\"'",
          FieldVisitor::Moved::list);
  v.group("box", c.box, "what becomes points, after removal of the base motion");
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
  for (const char* key : {"compat", "sordo2024"})
    v.moved(
        key,
        "(the published script is a stage of its own) write 'uses: transfer.sordo2024' with the "
        "settings of the group sordo2024, cell and grid_origin");
}

std::vector<std::string> sources_of(const std::string& name, const MapMaterial& material) {
  return material.of.empty() ? std::vector{name} : material.of;
}

Box box_of(const SectionBox& box) {
  constexpr double far = 1e300;
  return {box.left.value_or(-far), box.right.value_or(far), box.bottom.value_or(-far),
          box.top.value_or(far)};
}

void check(const MapConfig& c) {
  validate(!c.materials.empty(),
           "map: no materials (elements would have no density and no law). Add materials: {{...}}");
  validate(
      c.seeding == Seeding::lattice || c.points_per_cell <= 4,
      "map: points_per_cell {} with seeding gauss (rules go up to 4 points per direction). Use 4 "
      "or less, or seeding: lattice",
      c.points_per_cell);
  const Box box = box_of(c.box);
  validate(
      box.xmin < box.xmax && box.ymin < box.ymax,
      "map: box from x = {:g} to {:g} m and y = {:g} to {:g} m is empty (left lies below right, "
      "bottom below top)",
      box.xmin, box.xmax, box.ymin, box.ymax);
  std::set<std::string> seen;
  for (const auto& [name, m] : c.materials) {
    for (const std::string& source : sources_of(name, m))
      validate(
          seen.insert(source).second,
          "map: the material '{}' of the section becomes two (an element has one material); the "
          "second is '{}'",
          source, name);
    std::visit(
        [&, &name = name]<class M>(const Material<M>& law) {
          const std::string_view missing = left_to_points<M>(M::initial_state(law.params));
          validate(missing.empty(),
                   "materials.{}.{}: '{}' is missing (points bring it of soil that has liquefied "
                   "only) give it",
                   name, M::name, missing);
        },
        make_material(m.law, name));
    validate(
        !m.liquefied || !(m.liquefied->strength || m.liquefied->soft_strength),
        "map: materials.{}.liquefied gives {} (it would change nothing: every point has the S_r "
        "that the zone found for it, and c_soft = c_soft_ratio S_r) change `strength` of "
        "transfer.zone, or c_soft_ratio",
        name, m.liquefied && m.liquefied->strength ? "strength" : "soft_strength");
    validate(!m.liquefied || c.c_soft_ratio,
             "map: c_soft_ratio is missing (material '{}' may liquefy and softens to c_soft = "
             "c_soft_ratio S_r). Add c_soft_ratio, for example 0.5",
             name);
  }
}

}  // namespace flowslide
