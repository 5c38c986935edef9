#include "mpm/run/flow_config.hpp"

#include "core/conventions.hpp"

namespace flowslide {

namespace {

/// Rows of the time series and stored states that a run may ask for.
constexpr double kMostSamples = 1e6, kMostFrames = 1e5;

}  // namespace

void check(const FlowConfig& c) {
  validate(c.end / c.sample_interval <= kMostSamples,
           "sample_interval = {:g} s asks for {:.2g} rows until {:g} s (at most {:g} are kept) "
           "raise sample_interval or lower end",
           c.sample_interval, c.end / c.sample_interval, c.end, kMostSamples);
  validate(c.end / c.frame_interval <= kMostFrames,
           "frame_interval = {:g} s asks for {:.2g} stored states until {:g} s (at most {:g} are "
           "kept) raise frame_interval or lower end",
           c.frame_interval, c.end / c.frame_interval, c.end, kMostFrames);
  validate(!c.ground.surface.empty(),
           "ground.surface is empty (soil would fall for ever) give at least one point");
  for (std::size_t i = 1; i < c.ground.surface.size(); ++i) {
    validate(
        c.ground.surface[i][0] >= c.ground.surface[i - 1][0],
        "ground.surface: point {} lies left of point {} (x must not decrease) sort the points by x",
        i + 1, i);
  }
  validate(!c.absorbing.left || !c.left_roller,
           "absorbing.left and left_roller are both given (soil ends at one of them) remove one");
  validate(!c.absorbing.right || !c.right_roller,
           "absorbing.right and right_roller are both given (soil ends at one of them) remove one");
  const auto& planes = c.absorbing;
  validate(!planes.left || !planes.right || *planes.left < *planes.right,
           "absorbing.left is not left of absorbing.right (nothing lies between them) swap them");
  for (const auto& point : c.ground.surface)
    validate(!planes.bottom || point[1] <= *planes.bottom - 2.0 * c.cell,
             "ground.surface reaches up to y = {:g} m (it would hold the soil in place of "
             "absorbing.bottom at {:g} m) lower it by two cells or more below the plane",
             point[1], planes.bottom.value_or(kUnset));
  validate(!c.outlet.left || !c.outlet.right || *c.outlet.left < *c.outlet.right,
           "outlet.left is not left of outlet.right (nothing lies between them) swap them");
  validate(!c.outlet.bottom || !c.outlet.top || *c.outlet.bottom < *c.outlet.top,
           "outlet.bottom is not below outlet.top (nothing lies between them) swap them");
  for (std::size_t i = 0; i < c.tractions.size(); ++i)
    validate(c.tractions[i].from != c.tractions[i].to,
             "tractions: stretch {} has no length (it carries nothing) give its two ends", i + 1);
  validate(!c.left_roller || !c.right_roller || *c.left_roller < *c.right_roller,
           "left_roller is not left of right_roller (nothing lies between them) swap them");
  validate(
      !c.sleep || (c.update == mpm::Update::symplectic && c.transfer != mpm::Transfer::fmpm),
      "sleep needs update symplectic and another transfer than fmpm (the others map all points "
      "more than once in a step) change them or leave sleep out");
  validate(c.tractions.empty() || !c.extrude,
           "tractions: act in plane strain (with extrude the run has 3 dimensions) leave one out");
  validate(!c.side_rollers || (*c.side_rollers)[0] < (*c.side_rollers)[1],
           "the first of side_rollers is not below the second (nothing lies between them) swap "
           "them");
}

std::string no_reference_length(const std::string& material, double cell) {
  return fmt::format(
      "softening.reference_length is missing, but '{}' softens (its softening strains hold for "
      "cells of one size, and the runout hangs on it) give the cell for which the strains were "
      "chosen, such as 'softening: {{reference_length: {:g} m}}'; where it was left out, it used "
      "to be 1.25 m",
      material, cell);
}

void Schema<SofteningSettings>::describe(FieldVisitor& v, SofteningSettings& c) {
  v.flag("regularise", c.regularise,
         "scale softening strains by reference_length / cell (crack band); off: results depend on "
         "the cell size");
  v.quantity(
      "reference_length", c.reference_length, Dim::length, {.above = 0.0},
      "cell size at which the softening strains hold as they are given; needed where soil softens");
}

void Schema<RestRule>::describe(FieldVisitor& v, RestRule& c) {
  v.quantity("kinetic_share", c.kinetic_share, Dim::none, {.min = 0.0, .max = 1.0},
             "kinetic energy below this share of its peak");
  v.quantity("runout_change", c.runout_change, Dim::length, {.min = 0.0},
             "front moved less than this within the window");
  v.quantity("window", c.window, Dim::time, {.above = 0.0},
             "length of the window; also the shortest run");
}

void Schema<TerrainSettings>::describe(FieldVisitor& v, TerrainSettings& c) {
  v.file("file", c.file, "ESRI ASCII grid of heights (.asc); level beyond its edges");
  v.tuple("origin", c.origin, Dim::length, "map coordinates of x = y = 0");
  v.quantity("heading", c.heading, Dim::angle, {.min = -2.0 * kPi, .max = 2.0 * kPi},
             "direction of x on the map, counter-clockwise from its first axis (east)");
  v.quantity("level", c.level, Dim::length, {.min = -12e3, .max = 12e3},
             "height on the map that is z = 0");
}

void Schema<GroundSettings>::describe(FieldVisitor& v, GroundSettings& c) {
  static constexpr std::array<FieldVisitor::Column, 2> columns{
      {{"x", Dim::length}, {"y", Dim::length}}};
  v.rows("surface", c.surface, columns,
         "surface from left to right, level beyond its ends; a repeated x is a vertical step");
  v.group("terrain", c.terrain, Schema<TerrainSettings>::doc);
  v.quantity("friction", c.friction, Dim::none, {.min = 0.0}, "Coulomb friction coefficient");
}

void Schema<AbsorbingSettings>::describe(FieldVisitor& v, AbsorbingSettings& c) {
  v.quantity("left", c.left, Dim::length, {}, "x of an upright plane upstream");
  v.quantity("right", c.right, Dim::length, {}, "x of an upright plane downstream");
  v.quantity("bottom", c.bottom, Dim::length, {},
             "height of a level plane below the soil; ground.surface must lie two cells below it");
}

void Schema<ExtrudeSettings>::describe(FieldVisitor& v, ExtrudeSettings& c) {
  static constexpr std::array<std::string_view, 3> sides{"smooth", "rough", "open"};
  v.quantity("width", c.width, Dim::length, {.min = 1e-3, .max = 1e5}, "width of the valley");
  v.choice("sides", c.sides, sides,
           "upright walls on both sides: smooth as in plane strain, or rough with the friction of "
           "the ground; open: none, the terrain holds the soil");
}

void Schema<StiffnessBounds>::describe(FieldVisitor& v, StiffnessBounds& c) {
  v.quantity("volume_change", c.volume_change, Dim::none, {.max = 0.2, .above = 0.0},
             "largest change of volume under the weight of the soil");
  v.quantity("mach_number", c.mach_number, Dim::none, {.max = 1.0, .above = 0.0},
             "largest speed of a free fall from the highest soil to the lowest ground, over that "
             "of sound");
  v.quantity("brittleness", c.brittleness, Dim::none, {.max = 1.0, .above = 0.0},
             "largest fall of shear strength over plastic shear strain, over the shear modulus");
}

/// How stiff the soil is, and what keeps its softening apart from the cells.
static void describe_soil(FieldVisitor& v, FlowConfig& c) {
  static constexpr std::array<std::string_view, 2> kinds{"given", "automatic"};
  v.group("softening", c.softening, Schema<SofteningSettings>::doc);
  v.choice("stiffness", c.stiffness, kinds,
           "elastic constants of the materials: as given, or automatic: no stiffer than "
           "stiffness_bounds need and never stiffer than given, for longer steps; what was chosen "
           "is told");
  v.group("stiffness_bounds", c.stiffness_bounds, Schema<StiffnessBounds>::doc);
}

void Schema<SleepSettings>::describe(FieldVisitor& v, SleepSettings& c) {
  v.quantity("speed", c.speed, Dim::velocity, {.above = 0.0},
             "soil that moves less than speed x after in the time `after` is quiet");
  v.quantity("after", c.after, Dim::time, {.above = 0.0},
             "how long soil is quiet before it sleeps");
}

void Schema<OutletSettings>::describe(FieldVisitor& v, OutletSettings& c) {
  v.quantity("left", c.left, Dim::length, {}, "points with smaller x leave");
  v.quantity("right", c.right, Dim::length, {},
             "points with larger x leave; the runout counts them where they left");
  v.quantity("bottom", c.bottom, Dim::length, {}, "points below this y leave");
  v.quantity("top", c.top, Dim::length, {}, "points above this y leave");
}

void Schema<TractionSettings>::describe(FieldVisitor& v, TractionSettings& c) {
  v.tuple("from", c.from, Dim::length, "one end of the stretch, on the surface at the start");
  v.tuple("to", c.to, Dim::length,
          "the other end; soil lies on the right of the way from the first to the second");
  v.quantity("pressure", c.pressure, Dim::stress, {}, "traction at right angles, into the soil");
  v.quantity("shear", c.shear, Dim::stress, {}, "traction along the way");
  v.quantity("begin", c.begin, Dim::time, {}, "until then there is no traction");
  v.quantity("ramp", c.ramp, Dim::time, {.min = 0.0},
             "time over which it rises to its full amount; 0: at once");
}

/// How points and grid exchange what they carry.
static void describe_scheme(FieldVisitor& v, FlowConfig& c) {
  static constexpr std::array<std::string_view, 5> bases{"linear", "gimp", "quadratic", "cubic",
                                                         "mls"};
  static constexpr std::array<std::string_view, 6> transfers{"apic", "tpic", "aflip",
                                                             "flip", "pic",  "fmpm"};
  static constexpr std::array<std::string_view, 3> updates{"symplectic", "usf", "musl"};
  static constexpr std::array<std::string_view, 2> averages{"auto", "off"};
  v.choice(
      "basis", c.basis, bases,
      "shape functions: quadratic and cubic B-splines, gimp for points of half a cell, mls for "
      "the quadratic one with the gradient of the affine field and a longer step, or linear, "
      "whose step is not safe for lone points");
  v.choice("transfer", c.transfer, transfers,
           "velocity transfer between grid and points: apic and tpic lose sub-grid motion every "
           "step (a viscosity like h^2/dt), aflip at a rate of its own, flip and fmpm by their "
           "share and order, pic at once");
  v.quantity("relaxation", c.relaxation, Dim::time, {.above = 0.0},
             "with transfer aflip: time constant with which points take up the grid's velocity");
  v.quantity("flip_share", c.flip_share, Dim::none, {.min = 0.0, .max = 1.0},
             "with transfer flip: share of its own velocity that a point keeps in a step");
  v.integer("fmpm_order", c.fmpm_order, {.min = 1.0, .max = 4.0},
            "with transfer fmpm: terms of the series of the inverse of the full mass matrix");
  v.choice("update", c.update, updates,
           "when stress is updated: after the momentum balance from the grid's new velocities "
           "(symplectic), before it (usf), or from the points' new velocities mapped to the grid "
           "once more (musl, one sweep more)");
  v.choice("volume_average", c.volume_average, averages,
           "F-bar against volumetric locking: auto averages materials with Poisson's ratio of 0.4 "
           "or more and no friction");
}

void Schema<FlowConfig>::describe(FieldVisitor& v, FlowConfig& c) {
  v.quantity("cell", c.cell, Dim::length, {.above = 0.0}, "size of the square grid cells");
  v.tuple("grid_origin", c.grid_origin, Dim::length, "position of a grid node");
  v.moved("toe",
          "(the runout counts from the downstream end of the soil that counts, which transfer.map "
          "knows; it does not move the flow) remove it; a report that is to count from elsewhere "
          "has 'uses: report.runout, with: {toe: 75 m}'");
  v.quantity("end", c.end, Dim::time, {.above = 0.0},
             "latest end; the run stops earlier when all is at rest");
  v.group("ground", c.ground, Schema<GroundSettings>::doc);
  v.group("absorbing", c.absorbing, Schema<AbsorbingSettings>::doc);
  v.group("outlet", c.outlet, Schema<OutletSettings>::doc);
  v.list("tractions", c.tractions, Schema<TractionSettings>::doc);
  v.quantity("left_roller", c.left_roller, Dim::length, {},
             "x of a vertical frictionless wall upstream");
  v.quantity("right_roller", c.right_roller, Dim::length, {},
             "x of a vertical frictionless wall downstream");
  v.group("extrude", c.extrude, Schema<ExtrudeSettings>::doc);
  describe_soil(v, c);
  describe_scheme(v, c);
  v.quantity("gravity", c.gravity, Dim::acceleration, {.min = 0.0}, "acceleration of gravity");
  v.quantity("courant", c.courant, Dim::none, {.max = 1.0, .above = 0.0},
             "share of the stable time step");
  v.quantity("velocity_limit", c.velocity_limit, Dim::none, {.max = 0.5, .above = 0.0},
             "cells that the fastest point may cross in a step");
  v.quantity("strain_limit", c.strain_limit, Dim::none, {.max = 0.2, .above = 0.0},
             "largest norm of the velocity gradient times the step");
  v.quantity("damping", c.damping, Dim::none, {.min = 0.0, .below = 1.0},
             "local non-viscous damping factor (Cundall)");
  v.group("sleep", c.sleep, Schema<SleepSettings>::doc);
  v.group("rest", c.rest, Schema<RestRule>::doc);
  v.quantity("frame_interval", c.frame_interval, Dim::time, {.above = 0.0},
             "time between stored states");
  v.quantity("frame_travel", c.frame_travel, Dim::length, {.above = 0.0},
             "a state is stored earlier where the fastest point may have come this far since one");
  v.quantity("sample_interval", c.sample_interval, Dim::time, {.above = 0.0},
             "time between rows of the time series");
}

}  // namespace flowslide
