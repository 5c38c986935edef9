#include "mpm/run/stiffness.hpp"

#include "core/elementary.hpp"
#include "model/brought_state.hpp"
#include "mpm/walls/height_field.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// G/K at a Poisson's ratio of 0.45: nearly incompressible soil stays so, and F-bar goes on.
constexpr double kShearPerBulk = 3.0 * (1.0 - 2.0 * 0.45) / (2.0 * (1.0 + 0.45));

double poisson_ratio(const Elasticity& e) {
  return (3.0 * e.bulk - 2.0 * e.shear) / (2.0 * (3.0 * e.bulk + e.shear));
}

/// The lowest place that soil can come to [m].
double lowest_ground(const ParticleSet& p, const GroundSettings& ground) {
  double lowest = std::numeric_limits<double>::infinity();
  const int up = p.dim - 1;
  for (const auto& x : p.position) lowest = std::min(lowest, x[up]);
  if (ground.terrain) {
    const TerrainSettings& t = *ground.terrain;
    const mpm::HeightField field =
        mpm::read_height_field(t.file.path, {t.origin, t.heading, t.level});
    for (const double height : field.height)  // a NaN is not below
      if (height - t.level < lowest) lowest = height - t.level;
  } else {
    for (const auto& point : ground.surface) lowest = std::min(lowest, point[1]);
  }
  return lowest;
}

/// Densest and most pressed point of a material at the start.
struct Most {
  double density = 0.0, pressure = 0.0;
};

std::vector<Most> most_of(const ParticleSet& p) {
  std::vector<Most> most(p.materials.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    Most& m = most[static_cast<std::size_t>(p.material[i])];
    const auto& s = p.stress[i];
    m.density = std::max(m.density, p.mass[i] / p.volume[i]);
    m.pressure = std::max(m.pressure, -(s[0] + s[1] + s[2]) / 3.0);
  }
  return most;
}

double parameter(const MaterialSpec& m, const char* name, double otherwise) {
  const auto found = m.parameters.find(name);
  return found == m.parameters.end() ? otherwise : found->second;
}

/// What the shear strength loses in softening at most [Pa].
double strength_lost(const ParticleSet& p, std::size_t material, double pressure) {
  const MaterialSpec& m = p.materials[material];
  const double cohesion = parameter(m, "cohesion", kUnset);
  if (is_set(cohesion)) {
    const double friction = parameter(m, "friction_angle", 0.0);
    const double left = parameter(m, "residual_friction_angle", friction);
    return cohesion * cos(friction) - parameter(m, "residual_cohesion", cohesion) * cos(left) +
           pressure * (sin(friction) - sin(left));
  }
  double lost = 0.0;
  const BroughtState peak(p, "strength"), soft(p, "soft_strength");
  const double usual = parameter(m, "strength", kUnset);
  const double usual_soft = parameter(m, "soft_strength", kUnset);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (static_cast<std::size_t>(p.material[i]) == material) {
      const double loses = peak.at(i, usual) - soft.at(i, usual_soft);
      if (loses > lost) lost = loses;
    }
  return lost;
}

double brittleness_of(double slope, double shear) {
  return slope > 0.0 ? slope / (std::sqrt(3.0) * shear) : 0.0;
}

/// The constants that a law is given, and how to give it others.
struct Constants {
  double *young, *poisson, *bulk;
  explicit Constants(MaterialSpec& m)
      : young(find(m, "youngs_modulus")),
        poisson(find(m, "poisson_ratio")),
        bulk(find(m, "bulk_modulus")) {}
  [[nodiscard]] bool known() const { return bulk || (young && poisson); }
  [[nodiscard]] Elasticity get() const {
    return bulk ? Elasticity{*bulk, 0.0} : Elasticity::from_young(*young, *poisson);
  }
  void set(const Elasticity& e) const {
    if (bulk) {
      *bulk = e.bulk;
      return;
    }
    *young = 9.0 * e.bulk * e.shear / (3.0 * e.bulk + e.shear);
    *poisson = poisson_ratio(e);
  }

 private:
  static double* find(MaterialSpec& m, const char* name) {
    const auto found = m.parameters.find(name);
    return found == m.parameters.end() ? nullptr : &found->second;
  }
};

}  // namespace

double fall_speed(double gravity, double height) { return std::sqrt(2.0 * gravity * height); }

double needed_bulk(const StiffnessBounds& bounds, double density, double pressure, double speed) {
  return std::max(pressure / bounds.volume_change,
                  density * speed * speed / (bounds.mach_number * bounds.mach_number));
}

Elasticity no_stiffer(const Elasticity& given, double bulk, double shear) {
  const double ratio = std::max(given.shear / given.bulk, kShearPerBulk);
  const double enough = std::max(bulk, std::min(shear, given.shear) / ratio);
  if (!(enough < given.bulk)) return given;
  return {enough, std::min(given.shear, enough * ratio)};
}

std::vector<double> softening_slopes(const ParticleSet& particles, const FlowConfig& config,
                                     const std::vector<double>& pressure) {
  const double scale = config.softening.scale(config.cell);
  std::vector<double> slopes;
  for (std::size_t i = 0; i < particles.materials.size(); ++i) {
    const MaterialSpec& m = particles.materials[i];
    const double width = parameter(m, "residual_strain", 0.0) - parameter(m, "peak_strain", 0.0);
    const bool softens = width > 0.0 && pressure[i] > 0.0;
    slopes.push_back(
        softens ? std::max(0.0, strength_lost(particles, i, pressure[i])) * scale / width : 0.0);
  }
  return slopes;
}

void expect_reference_length(const ParticleSet& particles, const FlowConfig& config) {
  if (!config.softening.regularise || config.softening.reference_length) return;
  constexpr double kAny = 1e3;  // under which friction that is lost is strength lost [Pa]
  const std::vector<double> pressure(particles.materials.size(), kAny);
  const std::vector<double> slopes = softening_slopes(particles, config, pressure);
  for (std::size_t i = 0; i < slopes.size(); ++i)
    if (slopes[i] > 0.0)
      throw InputError(no_reference_length(particles.materials[i].name, config.cell));
}

std::vector<std::string> snapping_soils(const ParticleSet& particles, const FlowConfig& config) {
  std::vector<double> pressure;
  for (const Most& m : most_of(particles)) pressure.push_back(m.pressure);
  const std::vector<double> slopes = softening_slopes(particles, config, pressure);
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    MaterialSpec material = particles.materials[i];
    const Constants constants(material);
    if (!constants.known() || constants.bulk) continue;
    const double brittleness = brittleness_of(slopes[i], constants.get().shear);
    if (brittleness < 1.0) continue;
    sentences.push_back(fmt::format(
        "'{}' loses its shear strength {:.2g} times as fast as it unloads, at the {:.3g} kPa that "
        "it begins with: its softening runs on without deformation, and the runout hangs on its "
        "elastic constants. Take smaller cells, a larger residual_strain, or stiffer soil.",
        material.name, brittleness, 1e-3 * pressure[i]));
  }
  return sentences;
}

StiffnessChoice soften(ParticleSet& particles, const FlowConfig& config) {
  StiffnessChoice choice;
  const int up = particles.dim - 1;
  double top = -std::numeric_limits<double>::infinity();
  for (const auto& x : particles.position) top = std::max(top, x[up]);
  choice.fall = std::max(0.0, top - lowest_ground(particles, config.ground));
  choice.speed = fall_speed(config.gravity, choice.fall);
  const std::vector<Most> most = most_of(particles);
  std::vector<double> pressure;
  for (const Most& m : most)
    pressure.push_back(std::max(m.pressure, m.density * config.gravity * choice.fall));
  const std::vector<double> slopes = softening_slopes(particles, config, pressure);
  for (std::size_t i = 0; i < particles.materials.size(); ++i) {
    if (!(most[i].density > 0.0)) continue;  // no points
    MaterialSpec& material = particles.materials[i];
    const Constants constants(material);
    if (!constants.known()) {
      choice.left.push_back(material.name);
      continue;
    }
    const double density = most[i].density;
    StiffnessOfMaterial m{.material = material.name, .given = constants.get()};
    m.needed = needed_bulk(config.stiffness_bounds, density, pressure[i], choice.speed);
    m.used = no_stiffer(m.given, m.needed,
                        slopes[i] / (std::sqrt(3.0) * config.stiffness_bounds.brittleness));
    m.volume_change = pressure[i] / m.used.bulk;
    m.brittleness = brittleness_of(slopes[i], m.used.shear);
    m.mach_number = choice.speed * std::sqrt(density / m.used.bulk);
    if (m.used.bulk < m.given.bulk) constants.set(m.used);
    choice.materials.push_back(std::move(m));
  }
  return choice;
}

std::vector<std::string> told(const StiffnessChoice& choice) {
  std::vector<std::string> sentences;
  const auto expected = [&](const StiffnessOfMaterial& m) {
    return fmt::format(
        "its volume changes by at most {:.2g} % and its Mach number is at most {:.2g}{}, for a "
        "fall of {:.3g} m",
        100.0 * m.volume_change, m.mach_number,
        m.brittleness > 0.0 ? fmt::format(", its brittleness {:.2g}", m.brittleness) : "",
        choice.fall);
  };
  for (const StiffnessOfMaterial& m : choice.materials) {
    if (m.used.bulk < m.given.bulk) {
      const std::string ratio = m.given.shear > 0.0
                                    ? fmt::format(", Poisson's ratio {:.3g} instead of {:.3g}",
                                                  poisson_ratio(m.used), poisson_ratio(m.given))
                                    : "";
      sentences.push_back(fmt::format(
          "stiffness automatic: '{}' runs with a bulk modulus of {:.3g} MPa instead of {:.3g} "
          "MPa{}; {}.",
          m.material, m.used.bulk * 1e-6, m.given.bulk * 1e-6, ratio, expected(m)));
    } else {
      sentences.push_back(fmt::format(
          "stiffness automatic: '{}' stays as given, which is no stiffer than the bounds ask for "
          "(bulk modulus {:.3g} MPa); {}.",
          m.material, m.given.bulk * 1e-6, expected(m)));
    }
  }
  for (const std::string& name : choice.left)
    sentences.push_back(fmt::format(
        "stiffness automatic: '{}' stays as given, since its law takes its stiffness from the "
        "stress.",
        name));
  return sentences;
}

}  // namespace flowslide
