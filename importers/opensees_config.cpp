#include "core/check.hpp"
#include "importers/opensees.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

void check_components(const std::vector<std::string>& names, std::string_view setting,
                      const std::set<std::string>& needed, const std::set<std::string>& optional) {
  for (const std::string& name : names) {
    std::set<std::string> known = needed;
    known.insert(optional.begin(), optional.end());
    known.insert("skip");
    validate(known.count(name) > 0, "`columns.{}`: unknown component '{}' (known: {})", setting,
             name, fmt::join(known, ", "));
  }
  for (const std::string& name : needed)
    validate(std::find(names.begin(), names.end(), name) != names.end(),
             "`columns.{}` lacks '{}' (it is needed)", setting, name);
}

void check_sigma_zz(const OpenSeesConfig& c) {
  const SigmaZz& zz = c.sigma_zz;
  validate(zz.nu.has_value() == (zz.rule == SigmaZzRule::elastic),
           "`sigma_zz.nu` belongs to `rule: elastic`, and only to it");
  validate(zz.k0.has_value() == (zz.rule == SigmaZzRule::k0),
           "`sigma_zz.k0` belongs to `rule: k0`, and only to it");
  const auto& names = c.columns.stress;
  validate(
      zz.rule != SigmaZzRule::recorded ||
          std::find(names.begin(), names.end(), "zz") != names.end(),
      "`sigma_zz.rule: recorded`, but `columns.stress` has no 'zz' (PM4Sand records xx, yy, xy) "
      "choose mean, elastic or k0");
}

}  // namespace

void Schema<OpenSeesUnits>::describe(FieldVisitor& v, OpenSeesUnits& c) {
  v.text("length", c.length, "unit of coordinates and displacements, e.g. m");
  v.text("time", c.time, "unit of time, e.g. s; velocity is length/time");
  v.text("stress", c.stress, "unit of stress and pore pressure, e.g. kPa");
}

void Schema<OpenSeesColumns>::describe(FieldVisitor& v, OpenSeesColumns& c) {
  v.flag("time", c.time, "the first column is time (-time)");
  v.texts("displacement", c.displacement, "per node: x, y, skip");
  v.texts("velocity", c.velocity, "per node: x, y, skip");
  v.texts("pore_pressure", c.pore_pressure, "per node: p, skip (`-dof 3 vel` records [p])");
  v.texts("stress", c.stress,
          "per element: xx, yy, zz, xy, ratio, skip (PM4Sand [xx, yy, xy], "
          "PDMY [xx, yy, zz, xy, ratio]); repeated names are averaged");
  v.texts("strain", c.strain, "per element: xx, yy, zz, xy (engineering), skip; zz is not used");
}

void Schema<OpenSeesGravity>::describe(FieldVisitor& v, OpenSeesGravity& c) {
  v.file("stress", c.stress, "effective stress at the element centres");
  v.file("strain", c.strain, "strain at the element centres; zero if left out");
  v.file("pore_pressure", c.pore_pressure, "pore pressure of the nodes");
  v.text("row", c.row, "row of all gravity files: last, first, or a number from 1");
}

void Schema<OpenSeesShaking>::describe(FieldVisitor& v, OpenSeesShaking& c) {
  v.file("displacement", c.displacement, "displacement of the nodes");
  v.file("velocity", c.velocity, "velocity of the nodes");
  v.file("pore_pressure", c.pore_pressure, "pore pressure of the nodes");
  v.file("stress", c.stress, "effective stress at the element centres");
  v.file("strain", c.strain, "strain at the element centres");
  v.choice("stage", c.stage, kStageChoices,
           "which part to take where time goes back; only: that is an error");
  v.quantity("interval", c.interval, Dim::time, {.above = 0.0},
             "time between rows, for files without a time column");
}

void Schema<SigmaZz>::describe(FieldVisitor& v, SigmaZz& c) {
  v.choice("rule", c.rule, kSigmaZzRules,
           "mean: (xx + yy)/2, elastic: nu (xx + yy), k0: K0 yy, recorded: column zz");
  v.quantity("nu", c.nu, Dim::none, {.min = 0.0, .below = 0.5}, "Poisson's ratio of rule elastic");
  v.quantity("k0", c.k0, Dim::none, {.above = 0.0}, "earth pressure coefficient of rule k0");
}

void Schema<OpenSeesMaterial>::describe(FieldVisitor& v, OpenSeesMaterial& c) {
  v.integer("tag", c.tag, {.min = 0}, "its tag in the table of elements");
  v.quantity("density", c.density, Dim::density, {.above = 0.0},
             "density before deformation, of grains and water together");
  v.quantity("porosity", c.porosity, Dim::none, {.above = 0.0, .below = 1.0}, "porosity n");
}

void Schema<OpenSeesConfig>::describe(FieldVisitor& v, OpenSeesConfig& c) {
  v.group("mesh", c.mesh, "nodes and elements");
  v.flag(
      "mirror", c.mirror,
      "for a model with its toe on the left: x, horizontal motion and shear change their sign, and "
      "later stages see the section from its other side");
  v.table("materials", c.materials, "materials of the model by the names of later stages");
  v.group("units", c.units, "units of the files");
  v.group("columns", c.columns, "columns of the recorders");
  v.group("gravity", c.gravity, "state at rest");
  v.group("shaking", c.shaking, "the motion; left out: the history holds the gravity state only");
  v.group("sigma_zz", c.sigma_zz, "out-of-plane stress");
  v.choice("bad_rows", c.bad_rows, kBadRows,
           "malformed rows and values that are not finite: refuse, or stop at the row before");
}

void check(const OpenSeesConfig& c) {
  validate(!c.materials.empty(),
           "`materials` is empty (later stages know soils by name, and their mass from here) write "
           "e.g. materials: {{tailings: {{tag: 168, density: 1870 kg/m3}}}}");
  const std::set<std::string> none;
  check_components(c.columns.displacement, "displacement", {"x", "y"}, none);
  check_components(c.columns.velocity, "velocity", {"x", "y"}, none);
  check_components(c.columns.pore_pressure, "pore_pressure", {"p"}, none);
  check_components(c.columns.stress, "stress", {"xx", "yy", "xy"}, {"zz", "ratio"});
  check_components(c.columns.strain, "strain", {"xx", "yy", "xy"}, {"zz", "ratio"});
  check_sigma_zz(c);
  if (!c.shaking) return;
  validate(c.columns.time || c.shaking->interval.has_value(),
           "`columns.time: false` needs `shaking.interval`, the time between rows");
  validate(!c.columns.time || !c.shaking->interval.has_value(),
           "`shaking.interval` belongs to files without a time column (`columns.time: false`)");
}

}  // namespace flowslide
