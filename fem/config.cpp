#include "fem/config.hpp"

namespace flowslide {

void check(const FemConfig& c) {
  validate(!c.materials.empty(), "materials is empty (every element needs one)");
  for (const auto& [name, m] : c.materials) (void)make_material(m.laws, name);
  validate(c.base.shear_wave_velocity.has_value() == c.base.density.has_value(),
           "base has one of shear_wave_velocity and density (a compliant base needs both) give "
           "both, or neither for a rigid base");
  validate(
      c.base.shear_wave_velocity.has_value() || c.base.motion == BaseMotionKind::within,
      "base.motion is outcrop, but the base is rigid (an outcrop motion needs the stiffness of "
      "the rock) give shear_wave_velocity and density, or take motion: within");
  validate(
      !c.base.shear_wave_velocity || c.base.motion == BaseMotionKind::outcrop,
      "base.motion is within, but the base is compliant (a motion measured at the base already "
      "holds the reflected waves) leave out shear_wave_velocity and density");
  validate(c.damping.mass.has_value() == c.damping.stiffness.has_value(),
           "damping has one of mass and stiffness give both, or ratio and frequencies");
  validate(c.damping.frequencies[0] > 0.0 && c.damping.frequencies[1] > c.damping.frequencies[0],
           "damping.frequencies must be positive and increase");
  validate(c.integration.smallest_step <= c.integration.step,
           "integration.smallest_step exceeds integration.step (no step is left) exchange them?");
  if (!c.water) return;
  validate(!c.water->table.empty(),
           "water.table is empty (it says where water stands) give at "
           "least one point, or leave out water");
  for (std::size_t i = 1; i < c.water->table.size(); ++i)
    validate(c.water->table[i][0] >= c.water->table[i - 1][0],
             "water.table: point {} lies left of point {} (x must not decrease) sort the points by "
             "x",
             i + 1, i);
}

void Schema<PermeabilityRiseConfig>::describe(FieldVisitor& v, PermeabilityRiseConfig& c) {
  v.quantity("factor", c.factor, Dim::none, {.min = 1.0, .max = 100.0},
             "permeability of liquefied soil over that at rest; 3 to 7 in back-analyses");
  v.quantity("exponent", c.exponent, Dim::none, {.max = 20.0, .above = 0.0},
             "1: in proportion to r_u; larger: near liquefaction only");
}

void Schema<FemMaterialConfig>::describe(FieldVisitor& v, FemMaterialConfig& c) {
  v.quantity("density", c.density, Dim::density, {.above = 0.0},
             "mass of grains and water in a volume");
  v.quantity("void_ratio", c.void_ratio, Dim::none, {.above = 0.0}, "void ratio e");
  v.tuple("permeability", c.permeability, Dim::velocity,
          "hydraulic conductivity, horizontal and vertical");
  v.group("permeability_rise", c.permeability_rise, Schema<PermeabilityRiseConfig>::doc);
  v.quantity("k0", c.k0, Dim::none, {.min = 0.0, .below = 1.0},
             "horizontal over vertical effective stress of level ground");
  v.flag("drained", c.drained, "no pore pressure in this soil at any time");
  describe_laws(v, c.laws);
}

void Schema<WaterConfig>::describe(FieldVisitor& v, WaterConfig& c) {
  static constexpr std::array<FieldVisitor::Column, 2> columns{
      {{"x", Dim::length}, {"y", Dim::length}}};
  v.rows("table", c.table, columns,
         "water table from left to right, level beyond its ends; soil above it is dry, a surface "
         "below it is under a pond; the pore pressure is zero at the first nodes at or above it");
  v.quantity("bulk_modulus", c.bulk_modulus, Dim::stress, {.above = 0.0},
             "bulk modulus of the water; lower for air in it");
  v.quantity("density", c.density, Dim::density, {.above = 0.0}, "density of the water");
  v.texts("drains", c.drains, "edge sets of the mesh along which the pore pressure is zero");
}

void Schema<FemGravityConfig>::describe(FieldVisitor& v, FemGravityConfig& c) {
  v.quantity("acceleration", c.acceleration, Dim::acceleration, {.above = 0.0},
             "acceleration of gravity");
  v.quantity("permeability", c.permeability, Dim::velocity, {.above = 0.0},
             "one permeability of all soil for the steady pore pressure before shaking; left out: "
             "the materials' own");
  v.flag("compacts", c.compacts,
         "the volume change under gravity lowers the void ratio of pm4sand, as in OpenSees; off: "
         "the relative density is that of the ground as it lies");
}

void Schema<FemBaseConfig>::describe(FieldVisitor& v, FemBaseConfig& c) {
  v.choice("motion", c.motion, kBaseMotionKinds,
           "where the motion was recorded: at an outcrop of the rock, or within, at the base");
  v.quantity("shear_wave_velocity", c.shear_wave_velocity, Dim::velocity, {.above = 0.0},
             "of the rock below the base");
  v.quantity("density", c.density, Dim::density, {.above = 0.0}, "of the rock below the base");
  v.flag("rigid_plane", c.rigid_plane, "the base moves as one; off: each node for itself");
}

void Schema<FemSideConfig>::describe(FieldVisitor& v, FemSideConfig& c) {
  v.choice("kind", c.kind, kSideKinds,
           "free_field: columns of soil that shake as level ground would; tied: both ends move "
           "alike (they must have nodes at the same heights); fixed: no horizontal motion");
  v.quantity("width", c.width, Dim::length, {.above = 0.0}, "width of a free-field column");
  v.quantity("thickness", c.thickness, Dim::length, {.min = 1.0},
             "thickness of a free-field column; large enough that the section does not move it");
}

void Schema<FemDampingConfig>::describe(FieldVisitor& v, FemDampingConfig& c) {
  v.quantity("ratio", c.ratio, Dim::none, {.min = 0.0, .max = 0.5},
             "damping ratio at both frequencies");
  v.tuple("frequencies", c.frequencies, Dim::frequency, "where the ratio holds");
  v.quantity("mass", c.mass, Dim::none, {.min = 0.0}, "factor of the mass, in 1/s");
  v.quantity("stiffness", c.stiffness, Dim::time, {.min = 0.0},
             "factor of the present elastic stiffness of the soil");
  v.group("like_newmark", c.like_newmark, Schema<LikeNewmarkConfig>::doc);
  v.quantity("largest_ratio", c.largest_ratio, Dim::none, {.max = 100.0, .above = 0.0},
             "most that stiffness damping may be of critical in the fastest motion of an element "
             "by itself; thin stiff elements get a smaller factor of stiffness, and longer steps. "
             "Left out: no bound");
}

void Schema<LikeNewmarkConfig>::describe(FieldVisitor& v, LikeNewmarkConfig& c) {
  v.quantity("gamma", c.gamma, Dim::none, {.min = 0.5, .max = 1.5}, "gamma of that program");
  v.quantity("step", c.step, Dim::time, {.max = 0.1, .above = 0.0}, "time step of that program");
}

void Schema<StabilisationConfig>::describe(FieldVisitor& v, StabilisationConfig& c) {
  v.quantity("pressure", c.pressure, Dim::none, {.min = 0.0, .max = 10.0},
             "alpha over element area and modulus: keeps undrained pore pressure smooth");
  v.quantity("modulus", c.modulus, Dim::stress, {.above = 0.0},
             "modulus in alpha; left out: K + 4/3 G of each element before shaking");
  v.quantity(
      "hourglass", c.hourglass, Dim::none, {.min = 0.0, .max = 10.0},
      "factor on the stiffness against hourglass motion; it has the shear modulus of gravity");
  v.flag(
      "hourglass_yields", c.hourglass_yields,
      "bound hourglass stress by the strength of the soil; false: elastic for ever, as SSPquadUP");
}

void Schema<IntegrationConfig>::describe(FieldVisitor& v, IntegrationConfig& c) {
  v.choice("scheme", c.scheme, kIntegrationSchemes,
           "explicit: central differences, the water implicit; implicit: both together, with "
           "iterations");
  v.quantity("step", c.step, Dim::time, {.above = 0.0}, "largest implicit step");
  v.quantity("smallest_step", c.smallest_step, Dim::time, {.above = 0.0},
             "a step that does not converge is halved down to this, then the run ends");
  v.quantity("tolerance", c.tolerance, Dim::none, {.above = 0.0},
             "largest force out of balance at a node, of its weight");
  v.integer("max_iterations", c.max_iterations, {.min = 2, .max = 1000},
            "of a step before it is halved");
  v.quantity("theta", c.theta, Dim::none, {.min = 0.5, .max = 1.0},
             "weight of the end of the step: 0.5 the trapezoidal rule, 1 Euler's, which damps");
}

void Schema<FemConfig>::describe(FieldVisitor& v, FemConfig& c) {
  v.table("materials", c.materials, "soils by the names of the mesh");
  v.group("water", c.water, Schema<WaterConfig>::doc);
  v.group("gravity", c.gravity, Schema<FemGravityConfig>::doc);
  v.group("base", c.base, Schema<FemBaseConfig>::doc);
  v.group("sides", c.sides, Schema<FemSideConfig>::doc);
  v.group("damping", c.damping, Schema<FemDampingConfig>::doc);
  v.group("stabilisation", c.stabilisation, Schema<StabilisationConfig>::doc);
  v.group("integration", c.integration, Schema<IntegrationConfig>::doc);
  v.quantity("softening_length", c.softening_length, Dim::length, {.above = 0.0},
             "size of elements for which the softening of pm4sand holds as given; in others the "
             "same slip across a row of elements takes the same strength. Left out: the same "
             "strain, whatever the size");
  v.quantity("end", c.end, Dim::time, {.above = 0.0}, "end of the run; left out: of the motion");
  v.quantity("stop_displacement", c.stop_displacement, Dim::length, {.above = 0.0},
             "the run ends early, at the first recorded state in which a node has moved this far "
             "against the base: the section flows, and small displacements are assumed here");
  v.quantity("output_interval", c.output_interval, Dim::time, {.above = 0.0},
             "time between recorded states");
  v.quantity("courant", c.courant, Dim::none, {.max = 1.0, .above = 0.0},
             "share of the largest stable step");
}

}  // namespace flowslide
