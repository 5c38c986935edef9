#include "core/check.hpp"
#include "core/conventions.hpp"
#include "fem/build_model.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

/// Numbers of soils and water that cannot be, or are odd.
namespace flowslide {
namespace {

constexpr double kAnything = std::numeric_limits<double>::infinity();

struct Plausible {
  double least, low, high, most;  ///< outside of least and most it cannot be
};

// Grains are 2.0 (coal, fly ash) to 5.2 t/m3 (magnetite), loose dry tailings 0.6 t/m3.
constexpr Plausible kDensity{600.0, 1200.0, 3200.0, 5000.0};
constexpr Plausible kGrains{1500.0, 2300.0, 4700.0, 7500.0};
// From slurry to rock.
constexpr Plausible kStiffness{5e3, 2e5, 5e10, 1e12};
// Of soil, in degrees; radians and degrees are taken for one another.
constexpr Plausible kFriction{0.0, 5.0, 50.0, 90.0};
// Up to that of a weak rock.
constexpr Plausible kCohesion{0.0, 0.0, 5e5, kAnything};
// From clay to open gravel.
constexpr Plausible kPermeability{0.0, 1e-12, 0.1, kAnything};
constexpr Plausible kShearWave{0.0, 150.0, 5000.0, kAnything};
// From weathered rock to basalt.
constexpr Plausible kRockDensity{1000.0, 1600.0, 3300.0, 6000.0};
// Of normally loaded and of overconsolidated soil.
constexpr Plausible kEarthPressure{0.0, 0.25, 0.95, kAnything};
// G = G0 P_atm at 1 atm: 20 to 250 MPa, shear waves of 100 to 370 m/s.
constexpr Plausible kG0{0.0, 150.0, 2500.0, kAnything};
constexpr Plausible kContraction{0.0, 0.01, 20.0, kAnything};
constexpr Plausible kWaterStiffness{1e5, 1e7, 2.6e9, 1e10};
constexpr Plausible kWaterDensity{500.0, 950.0, 1300.0, 2000.0};

void judge(const std::string& what, double value, double scale, std::string_view unit,
           const Plausible& p, const char* hint, Findings& found) {
  const std::string of = unit.empty() ? "" : fmt::format(" {}", unit);
  if (!(value >= p.least && value <= p.most))
    found.errors.push_back(fmt::format("{} is {:.4g}{} (it cannot lie outside {:g} to {:g}{}) {}",
                                       what, value / scale, of, p.least / scale, p.most / scale, of,
                                       hint));
  else if (!(value >= p.low && value <= p.high))
    found.warnings.push_back(fmt::format("{} is {:.4g}{}, outside the usual {:g} to {:g}{}: {}.",
                                         what, value / scale, of, p.low / scale, p.high / scale, of,
                                         hint));
}

constexpr const char* kUnitHint = "check number and unit";

/// What a number that is no density may be one of.
std::string density_hint(double density) {
  const auto fits = [](double x) { return x >= kDensity.low && x <= kDensity.high; };
  if (fits(density * 1e3)) return fmt::format("{:g} t/m3 are {:g} kg/m3", density, density * 1e3);
  if (fits(density * 1e3 / kGravity))
    return fmt::format("a unit weight of {:g} kN/m3 is a density of {:.0f} kg/m3", density,
                       density * 1e3 / kGravity);
  if (fits(density / kGravity))
    return fmt::format("a unit weight of {:g} N/m3 is a density of {:.0f} kg/m3", density,
                       density / kGravity);
  constexpr double kPoundsPerCubicFoot = 16.0185;
  if (fits(density * kPoundsPerCubicFoot))
    return fmt::format("{:g} lb/ft3 are {:.0f} kg/m3", density, density * kPoundsPerCubicFoot);
  return kUnitHint;
}

/// The section must not be pressed flat by its own weight.
void check_stiffness(const std::string& where, double modulus, double density, double height,
                     Findings& found) {
  judge(where + ".youngs_modulus", modulus, 1e6, "MPa", kStiffness, kUnitHint, found);
  const double weight = density * kGravity * height;
  if (modulus >= kStiffness.least && weight > modulus)
    found.errors.push_back(fmt::format(
        "{}.youngs_modulus: {:.4g} kPa is less than the weight of the soil above its base, {:.4g} "
        "kPa over {:.3g} m (it would be pressed flat) check number and unit",
        where, modulus / 1e3, weight / 1e3, height));
  else if (modulus >= kStiffness.least && 5.0 * weight > modulus)
    found.warnings.push_back(
        fmt::format("{}.youngs_modulus: {:.4g} kPa lets the soil settle by {:.0f} % under its own "
                    "weight, {:.4g} "
                    "kPa over {:.3g} m.",
                    where, modulus / 1e3, 100.0 * weight / modulus, weight / 1e3, height));
}

/// Constants of soil that is hardly compressible: steps shorten with the bulk modulus.
void check_incompressible(const std::string& where, double poisson, Findings& found) {
  constexpr double kEnough = 0.495, kMostTimes = 2.0;
  const auto wave2 = [](double nu) { return (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)); };
  const double times = std::sqrt(wave2(poisson) / wave2(kEnough));
  if (poisson > kEnough && times > kMostTimes)
    found.warnings.push_back(fmt::format(
        "{}.poisson_ratio: {:g} takes {:.2g} times as many steps as {:g}, and keeps the volume no "
        "better than a runout can tell.",
        where, poisson, times, kEnough));
}

/// Unset: the law has no such parameter, or it is left out.
double parameter_of(const AnyMaterial& law, const char* name) {
  const LawParameters p = to_parameters(law);
  const auto found = p.parameters.find(name);
  return found == p.parameters.end() ? kUnset : found->second;
}

void check_shear_strength(const std::string& where, double cohesion, double friction_angle,
                          Findings& found) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
  if (is_set(cohesion))
    judge(where + ".cohesion", cohesion, 1e3, "kPa", kCohesion, kUnitHint, found);
  if (friction_angle > 0.0)
    judge(where + ".friction_angle", friction_angle / kRadiansPerDegree, 1.0, "deg", kFriction,
          kUnitHint, found);
}

/// Residual strengths that no strain reaches.
void check_softening_strains(const std::string& where, double peak, double residual,
                             Findings& found) {
  constexpr double kMostPeak = 1.0, kMostResidual = 10.0;
  if (!(residual > peak))
    found.warnings.push_back(fmt::format(
        "{}.residual_strain: {:g} is not above peak_strain, {:g}: the soil keeps its peak strength "
        "for ever, and the residual one is not used.",
        where, residual, peak));
  else if (peak > kMostPeak || residual > kMostResidual)
    found.warnings.push_back(fmt::format(
        "{}: softening from a strain of {:g} to {:g} comes after any slide has stopped. Strains are "
        "numbers, not per cent.",
        where, peak, residual));
}

void check_law(const std::string& where, const FemMaterialConfig& m, Findings& found) {
  ShakingLaws::each([&]<class M>() {
    const auto& law = m.laws.of<M>();
    if (!law) return;
    if constexpr (requires { law->G0; }) {
      judge(where + ".pm4sand.G0", law->G0, 1.0, "", kG0,
            "it is a number, the shear modulus at 1 atm over that pressure", found);
      judge(where + ".pm4sand.hpo", law->hpo, 1.0, "", kContraction,
            "it is calibrated to cyclic strength, the larger the stronger (flowslide point)",
            found);
    }
    if constexpr (requires { law->youngs_modulus; })
      judge(where + ".youngs_modulus", law->youngs_modulus, 1e6, "MPa", kStiffness, kUnitHint,
            found);
    if constexpr (requires { law->friction_angle; })
      check_shear_strength(where, law->cohesion, law->friction_angle, found);
    if constexpr (requires { law->residual_cohesion; })
      if (law->residual_cohesion || law->residual_friction_angle)
        check_softening_strains(where, law->peak_strain, law->residual_strain, found);
  });
}

/// What damps the shaking, or leaves it to noise.
void check_fem_scheme(const FemConfig& fem, Findings& found) {
  constexpr double kMostDamping = 0.1, kUsual = 1.0;  // [-], at [Hz]
  const fem::Damping d = fem::rayleigh(fem.damping);
  const double ratio =
      d.mass / (4.0 * std::numbers::pi * kUsual) + std::numbers::pi * kUsual * d.stiffness;
  if (std::max(ratio, fem.damping.mass ? 0.0 : fem.damping.ratio) > kMostDamping)
    found.warnings.push_back(fmt::format(
        "damping: {:.2g} of critical at 1 Hz, beside what the soil's law has of its own; soil has "
        "0.005 to 0.05 at small strain. So much takes the shaking away that liquefies the soil.",
        ratio));
  constexpr double kLeastRatio = 0.5;
  if (fem.damping.largest_ratio.value_or(1.0) < kLeastRatio)
    found.warnings.push_back(fmt::format(
        "damping.largest_ratio: {:g} of critical in its fastest motion takes stiffness damping "
        "from most elements, not from thin ones alone. Take 1.",
        *fem.damping.largest_ratio));
  constexpr double kLoose = 0.01;
  if (fem.integration.scheme == IntegrationScheme::implicit && fem.integration.tolerance > kLoose)
    found.warnings.push_back(fmt::format(
        "integration.tolerance: forces out of balance of {:g} times a node's weight pass for "
        "equilibrium.",
        fem.integration.tolerance));
  if (!(fem.stabilisation.hourglass > 0.0))
    found.warnings.push_back(
        "stabilisation.hourglass: 0 lets elements move in a pattern that has no strain and meets "
        "no resistance.");
  if (!(fem.stabilisation.pressure > 0.0))
    found.warnings.push_back(
        "stabilisation.pressure: 0 lets pore pressures of undrained soil alternate from node to "
        "node.");
}

/// Weight, water and stress of a soil that is shaken.
void check_soil(const std::string& where, const FemMaterialConfig& m, const FemConfig& fem,
                Findings& found) {
  const double water = fem.water ? fem.water->density : 1000.0;
  const std::size_t before = found.errors.size();
  judge(where + ".density", m.density, 1.0, "kg/m3", kDensity, density_hint(m.density).c_str(),
        found);
  const double n = m.void_ratio / (1.0 + m.void_ratio);
  // Saturated, as the program takes it; soil that is drained or has no water may be dry.
  double grains = (m.density - n * water) / (1.0 - n);
  if (m.drained || !fem.water) grains = std::clamp(2650.0, grains, m.density / (1.0 - n));
  if (found.errors.size() == before)
    judge(fmt::format("{}: density of the grains that density {:g} kg/m3 and void_ratio {:g} imply",
                      where, m.density, m.void_ratio),
          grains, 1.0, "kg/m3", kGrains,
          m.void_ratio > 5.0 ? "a void ratio is no percentage: 40 % of pores are 0.67"
                             : "density is that of grains and water together; check both",
          found);
  for (const double k : m.permeability)
    if (is_set(k)) judge(where + ".permeability", k, 1.0, "m/s", kPermeability, kUnitHint, found);
  if (m.permeability[1] > m.permeability[0] * (1.0 + 1e-9))
    found.warnings.push_back(fmt::format(
        "{}.permeability: {:g} m/s vertically is more than {:g} m/s horizontally, but soil is "
        "laid down in layers, which water passes less easily. The first is the horizontal one.",
        where, m.permeability[1], m.permeability[0]));
  judge(where + ".k0", m.k0, 1.0, "", kEarthPressure,
        "horizontal over vertical effective stress at rest is about 1 - sin(phi)", found);
}

/// The pore pressure is zero at the first nodes at or above the table, so that it stands at them.
void check_table_rows(const FemConfig& fem, const QuadMesh& mesh, Findings& found) {
  double most = 0.0;
  Vec2 where{};
  for (const auto& element : mesh.elements) {
    const auto above = [&](std::int32_t n) {
      const Vec2& p = mesh.nodes[static_cast<std::size_t>(n)];
      return p[1] - fem::water_level(*fem.water, p[0]);
    };
    if (std::none_of(element.begin(), element.end(), [&](auto n) { return above(n) < 0.0; }))
      continue;
    for (const std::int32_t n : element)
      if (above(n) > most) {
        most = above(n);
        where = mesh.nodes[static_cast<std::size_t>(n)];
      }
  }
  constexpr double kMuch = 0.1;  // of the height of the section
  if (most > kMuch * extent_of(mesh).height())
    found.warnings.push_back(fmt::format(
        "water.table: the first node above it at ({:.4g}, {:.4g}) m stands {:.2g} m higher. The pore "
        "pressure is zero there and not at the table, so the soil below is wetter than given, by up "
        "to {:.2g} kPa. Let edges of blocks follow the table, or take smaller elements there.",
        where[0], where[1], most, 1e-3 * most * fem.water->density * fem.gravity.acceleration));
}

/// Water on the side to which the flow goes.
void check_water_downstream(const FemConfig& fem, const QuadMesh& mesh, Findings& found) {
  const Extent e = extent_of(mesh);
  double ground = e.bottom;
  for (const Vec2& p : mesh.nodes)
    if (p[0] >= e.right - 1e-6 * (e.right - e.left)) ground = std::max(ground, p[1]);
  const double left = fem::water_level(*fem.water, e.left);
  const double right = fem::water_level(*fem.water, e.right);
  constexpr double kPond = 0.05, kDeep = 0.2;  // of the height of the section
  if (right > left + kPond * e.height())
    found.warnings.push_back(fmt::format(
        "water.table: stands at y = {:.4g} m on the right and at {:.4g} m on the left: water would "
        "flow upstream, as flows go to the right. Is the table mirrored, or the section?",
        right, left));
  if (right > ground + kDeep * e.height())
    found.warnings.push_back(
        fmt::format("water.table: stands {:.3g} m above the ground at the downstream end: the toe "
                    "is under water. The runout is computed in air: that water holds nothing back "
                    "any more, and what it pressed on slides as if it had been let out at once.",
                    right - ground));
}

}  // namespace

void check_densities(const std::vector<HistoryMaterial>& materials, Findings& found) {
  constexpr double kWater = 1000.0;  // [kg/m3]
  for (const HistoryMaterial& m : materials) {
    const std::string where = "materials." + m.name;
    const std::size_t before = found.errors.size();
    judge(where + ".density", m.density, 1.0, "kg/m3", kDensity, density_hint(m.density).c_str(),
          found);
    if (!is_set(m.porosity) || found.errors.size() > before) continue;
    // Between full of water and dry.
    const double full = (m.density - m.porosity * kWater) / (1.0 - m.porosity);
    const double grains = std::clamp(2650.0, full, m.density / (1.0 - m.porosity));
    judge(fmt::format("{}: density of the grains that density {:g} kg/m3 and porosity {:g} imply",
                      where, m.density, m.porosity),
          grains, 1.0, "kg/m3", kGrains,
          "density is that of grains and water together, and porosity is no void ratio", found);
  }
}

void check_k0(double k0, Findings& found) {
  constexpr double kLow = 0.2, kHigh = 3.0;  // loose sand has 0.4 to 0.5, clay that bore ice 3
  if (!(k0 >= kLow && k0 <= kHigh))
    warn(found,
         "sigma_zz.k0: {:g} lies outside {:g} to {:g}, where that of soil lies. It is the ratio of "
         "two stresses.",
         k0, kLow, kHigh);
}

void check_map_materials(const MapConfig& map, const std::vector<HistoryMaterial>& materials,
                         const Soil& soil, Findings& found) {
  const double height = soil.all.empty() ? 0.0 : soil.all.height();
  for (const auto& [name, m] : map.materials) {
    const std::string where = "materials." + name;
    double density = 0.0;
    for (const std::string& source : sources_of(name, m))
      density = std::max(density, find_material(materials, source, where).density);
    const AnyMaterial law = make_material(m.law, name);
    const double modulus = parameter_of(law, "youngs_modulus");
    if (is_set(modulus)) check_stiffness(where, modulus, density, height, found);
    check_incompressible(where, parameter_of(law, "poisson_ratio"), found);
    check_shear_strength(where, parameter_of(law, "cohesion"), parameter_of(law, "friction_angle"),
                         found);
    if (is_set(parameter_of(law, "residual_cohesion")) ||
        is_set(parameter_of(law, "residual_friction_angle")))
      check_softening_strains(where, parameter_of(law, "peak_strain"),
                              parameter_of(law, "residual_strain"), found);
    if (!m.liquefied) continue;
    check_stiffness(where + ".liquefied", m.liquefied->youngs_modulus, density, height, found);
    check_incompressible(where + ".liquefied", m.liquefied->poisson_ratio, found);
    constexpr double kUndrained = 0.4;
    if (m.liquefied->poisson_ratio < kUndrained)
      found.warnings.push_back(fmt::format(
          "{}.liquefied.poisson_ratio: {:g} lets soil full of water change its volume as if it "
          "were drained. Take 0.45 to 0.495.",
          where, m.liquefied->poisson_ratio));
    if (map.c_soft_ratio < 1.0 && m.liquefied->residual_strain > 0.0)
      check_softening_strains(where + ".liquefied", 0.0, m.liquefied->residual_strain, found);
  }
}

void check_fem_soils(const FemConfig& fem, Findings& found) {
  check_fem_scheme(fem, found);
  for (const auto& [name, m] : fem.materials) {
    check_soil("materials." + name, m, fem, found);
    check_law("materials." + name, m, found);
  }
  if (fem.base.shear_wave_velocity)
    judge("base.shear_wave_velocity", *fem.base.shear_wave_velocity, 1.0, "m/s", kShearWave,
          "it is that of the rock below the base", found);
  if (fem.base.density)
    judge("base.density", *fem.base.density, 1.0, "kg/m3", kRockDensity,
          "it is that of the rock below the base, and decides how much of a wave leaves", found);
  if (fem.water) {
    judge("water.bulk_modulus", fem.water->bulk_modulus, 1e6, "MPa", kWaterStiffness,
          "pure water has 2200 MPa, with air in it less", found);
    judge("water.density", fem.water->density, 1.0, "kg/m3", kWaterDensity, kUnitHint, found);
  }
  if (!(fem.gravity.acceleration > 9.7 && fem.gravity.acceleration < 9.9))
    found.warnings.push_back(fmt::format(
        "gravity.acceleration: {:g} m/s2 is not that of the earth.", fem.gravity.acceleration));
}

void check_water(const FemConfig& fem, const QuadMesh& mesh, Findings& found) {
  if (!fem.water || fem.water->table.empty()) return;
  const Extent e = extent_of(mesh);
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : mesh.nodes) highest = std::max(highest, fem::water_level(*fem.water, p[0]));
  const double height = e.top - e.bottom;
  if (highest > e.top + height)
    found.errors.push_back(fmt::format(
        "water.table: stands at y = {:.4g} m, {:.4g} m above the top of the section at {:.4g} m, "
        "more than the section is high (the water alone would crush it) check number and unit",
        highest, highest - e.top, e.top));
  else if (highest > e.top * (1.0 + 1e-9) + 1e-6 * height)
    found.warnings.push_back(fmt::format(
        "water.table: stands at y = {:.4g} m, {:.3g} m above the highest point of the section: all "
        "of it is under water.",
        highest, highest - e.top));
  check_water_downstream(fem, mesh, found);
  check_table_rows(fem, mesh, found);
  if (!(highest > e.bottom))
    found.warnings.push_back(fmt::format(
        "water.table: stands below the section (at most at y = {:.4g} m, the section begins at "
        "{:.4g} m): the soil is dry and cannot liquefy.",
        highest, e.bottom));
}

}  // namespace flowslide
