#include "verify/mpm/dam.hpp"

#include "core/elementary.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

namespace flowslide::mpm {
namespace {

using Polygon = std::vector<std::array<double, 2>>;
const Polygon kLowerDam{{0.0, 0.0}, {75.0, 0.0}, {35.42, 12.5}, {20.0, 12.5}};
const Polygon kUpperDam{{17.42, 12.5}, {20.0, 12.5}, {35.42, 12.5}, {-20.0, 30.0}, {-38.0, 30.0}};
constexpr double kPond = 30.0, kGravity = 9.81, kWater = 1000.0;

bool contains(const Polygon& polygon, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto& a = polygon[i];
    const auto& b = polygon[j];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) in = !in;
  }
  return in;
}

/// Height of the section's surface.
double pond_or_slope(double x) {
  if (x < -20.0) return kPond;
  if (x < 35.42) return kPond - (x + 20.0) / 55.42 * 17.5;
  return std::max(0.0, (75.0 - x) / 39.58 * 12.5);
}

/// Residual strength over initial effective stress: a line through the workflow's table.
double residual_strength(double depth, double density) {
  const double effective = (density - kWater) * kGravity * depth;
  return 2.6e3 + 0.036 * effective;
}

}  // namespace

ParticleSet dam_points(const DamScene& scene) {
  enum { embankment, tailings };
  const std::array<double, 2> density{1690.0, 1870.0};
  ParticleSet p;
  p.toe = 75.0;
  p.dim = scene.width > 0.0 ? 3 : 2;
  p.materials = {
      material("mohr_coulomb", {{"youngs_modulus", 20e6},
                                {"poisson_ratio", 0.3},
                                {"cohesion", 25e3},
                                {"friction_angle", 35.0 * M_PI / 180.0},
                                {"residual_cohesion", 1e3},
                                {"residual_friction_angle", 20.0 * M_PI / 180.0},
                                {"peak_strain", 0.01},
                                {"residual_strain", 0.05}}),
      material("residual_strength",
               {{"youngs_modulus", 20e6}, {"poisson_ratio", 0.45}, {"residual_strain", 1.0}})};
  const double d = 0.5 * scene.cell;
  const auto nx = static_cast<int>((scene.upstream + 75.0) / d);
  const auto nz = static_cast<int>(kPond / d);
  const int ny = p.dim == 3 ? static_cast<int>(std::lround(scene.width / d)) : 1;
  std::vector<double>&strength = p.history["strength"], &soft = p.history["soft_strength"];
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const double x = -scene.upstream + (i + 0.5) * d, z = (k + 0.5) * d;
        const double depth = pond_or_slope(x) - z;
        if (depth <= 0.0) continue;
        const int kind =
            contains(kLowerDam, x, z) || contains(kUpperDam, x, z) ? embankment : tailings;
        const double vertical = -density[kind] * kGravity * depth;
        const double lateral = kind == tailings ? vertical : 0.5 * vertical;
        const std::size_t q = p.size();
        resize(p, q + 1);
        if (p.dim == 2) {
          p.position[q] = {x, z, 0.0};
          p.stress[q] = {lateral, vertical, lateral, 0.0, 0.0, 0.0};
        } else {
          p.position[q] = {x, (j + 0.5) * d, z};
          p.stress[q] = {lateral, lateral, vertical, 0.0, 0.0, 0.0};
        }
        p.volume[q] = pow(d, p.dim);
        p.mass[q] = density[kind] * p.volume[q];
        p.material[q] = kind;
        p.id[q] = static_cast<std::int64_t>(q) + 1;
        strength.resize(q + 1);
        soft.resize(q + 1);
        strength[q] = residual_strength(depth, density[tailings]);
        soft[q] = 0.5 * strength[q];
      }
    }
  }
  p.pore_pressure.assign(p.size(), 0.0);
  return p;
}

FlowConfig dam_config(const DamScene& scene) {
  FlowConfig c;
  c.cell = scene.cell;
  c.end = 300.0;
  c.transfer = Transfer::aflip;
  c.left_roller = -scene.upstream;
  c.ground.friction = 0.7;
  c.softening.reference_length = 1.25;
  if (scene.width > 0.0 && scene.walls) c.side_rollers = {0.0, scene.width};
  return c;
}

}  // namespace flowslide::mpm
