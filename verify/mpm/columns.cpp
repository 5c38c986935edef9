#include "core/elementary.hpp"
#include "model/front.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>
#include <map>

/// Columns that stand against a smooth wall on a rough base and collapse when the other side is let
/// go: the granular one of Bui et al. (2008), and undrained ones whose final reach and whose
/// threshold are known from plasticity.
namespace flowslide::mpm {
namespace {

constexpr double kRough = 1e6;  ///< friction coefficient of a base on which nothing slides

/// Points of a column of length L0 and height H0 in a stress of its weight, sigma_h = k sigma_v.
ParticleSet column(double length, double height, double cell, double density, double k) {
  ParticleSet p;
  fill(p, {0.0, 0.0, length, height}, 0.5 * cell, density);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double vertical = -density * kGravity * (height - p.position[q][1]);
    p.stress[q] = {k * vertical, vertical, k * vertical, 0.0, 0.0, 0.0};
  }
  return p;
}

FlowConfig against_wall(double cell) {
  FlowConfig config = free_space(cell);
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = kRough;
  config.left_roller = 0.0;
  return config;
}

/// Height of the surface near x: that of the highest point within half a cell, plus half its size.
double surface(const Points<2>& p, double x, double cell) {
  double top = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q)
    if (std::abs(p.x[0][q] - x) < 0.5 * cell) top = std::max(top, p.x[1][q] + 0.25 * cell);
  return top;
}

/// Front as the x beyond which `share` of the mass lies, plus half a point.
double front(const Points<2>& p, double cell, double share) {
  std::vector<Place> places;
  for (std::size_t q = 0; q < p.size(); ++q) places.push_back({p.x[0][q], p.mass[q]});
  double at = 0.0;
  places_beyond(places, {&share, 1}, {&at, 1});
  return at + 0.25 * cell;
}

MaterialSpec tresca(double strength, double stiffness_ratio, double nu) {
  return material("residual_strength", {{"youngs_modulus", stiffness_ratio * strength},
                                        {"poisson_ratio", nu},
                                        {"strength", strength},
                                        {"soft_strength", strength},
                                        {"residual_strain", 0.0}});
}

constexpr double kSoil = 2000.0;  ///< density of the undrained columns [kg/m3]

/// L_f / L0 of an undrained column of aspect ratio a = H0/L0 and strength B = c / (rho g H0), let
/// go slowly: local damping keeps inertia out.
double final_length(double aspect, double b, int cells_in_height) {
  const double height = 1.0, length = height / aspect, h = height / cells_in_height;
  ParticleSet p = column(length, height, h, kSoil, 1.0);
  p.materials = {tresca(b * kSoil * kGravity * height, 100.0, 0.45)};
  FlowConfig config = against_wall(h);
  config.damping = 0.7;
  Trial trial(p, config);
  double last = 0.0;
  for (double time = 1.0; time <= 12.0; time += 1.0) {
    trial.run_to(time);
    const double now = front(trial.sim.points, h, 0.002);
    if (now - last < 0.002 * length) break;
    last = now;
  }
  return front(trial.sim.points, h, 0.002) / length;
}

/// Whether an undrained vertical cut of strength B = c / (rho g H) stands: it sags elastically and
/// stops, or it goes on.
bool cut_stands(double b, int cells_in_height) {
  const double height = 1.0, h = height / cells_in_height;
  ParticleSet p = column(2.0 * height, height, h, kSoil, 1.0);
  p.materials = {tresca(b * kSoil * kGravity * height, 1000.0, 0.45)};
  FlowConfig config = against_wall(h);
  config.damping = 0.5;
  Trial trial(p, config);
  const double start = 2.0 * height, enough = 0.05 * height;
  trial.run_to(1.5);
  const double halfway = front(trial.sim.points, h, 0.0) - start;
  if (halfway > enough) return false;
  trial.run_to(3.0);
  const double end = front(trial.sim.points, h, 0.0) - start;
  return end < enough && end - halfway < 0.2 * halfway;
}

/// Where, seen from the front, the layer becomes `thickness` thick: volume in strips over their
/// width, with a straight line between their middles.
double end_of_layer(const Points<2>& p, double density, double thickness) {
  constexpr double width = 0.005;
  std::vector<double> layer(400, 0.0);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const auto strip = static_cast<std::size_t>(std::max(0.0, p.x[0][q]) / width);
    if (strip < layer.size()) layer[strip] += p.mass[q] / (density * width);
  }
  std::size_t last = layer.size() - 2;
  while (last > 0 && layer[last] < thickness) --last;
  const double over = layer[last] - thickness, drop = layer[last] - layer[last + 1];
  return width * (static_cast<double>(last) + 0.5 + (drop > 0.0 ? over / drop : 0.0));
}

struct Slump {
  double toe;            ///< where the layer is as thin as a bar [m]
  double surface_error;  ///< rms distance from the measured surface, over the height
  double energy_error;
};

/// The column of Bui et al., with Coulomb's friction or with that of mu(I) for glass beads (Jop,
/// Forterre & Pouliquen 2006), which adds 0.26 for fast flow. Bars of 1 and 1.5 mm.
Slump aluminium_bars(bool rate, double h) {
  constexpr double length = 0.2, height = 0.1, density = 2650.0, bar = 0.0015;
  constexpr double nu = 0.3, bulk = 0.7e6, phi = 19.8 * kPi / 180.0;
  ParticleSet p = column(length, height, h, density, nu / (1.0 - nu));
  std::map<std::string, double> values{{"youngs_modulus", 3.0 * bulk * (1.0 - 2.0 * nu)},
                                       {"poisson_ratio", nu}};
  if (rate)
    values.merge(std::map<std::string, double>{{"mu_static", sin(phi)},
                                               {"mu_limit", sin(phi) + 0.26},
                                               {"inertial_number", 0.279},
                                               {"grain_size", 0.00125},
                                               {"grain_density", density}});
  else
    values.merge(std::map<std::string, double>{{"cohesion", 0.0}, {"friction_angle", phi}});
  p.materials = {material(rate ? "mu_i" : "mohr_coulomb", values)};
  Trial trial(p, against_wall(h));
  trial.run_to(0.8);
  // Free surface of the experiment, digitised.
  constexpr std::array<std::array<double, 2>, 11> profile{{{0.0, 0.0992},
                                                           {0.06, 0.0890},
                                                           {0.10, 0.0776},
                                                           {0.14, 0.0665},
                                                           {0.18, 0.0539},
                                                           {0.22, 0.0425},
                                                           {0.26, 0.0307},
                                                           {0.30, 0.0215},
                                                           {0.34, 0.0136},
                                                           {0.38, 0.0079},
                                                           {0.42, 0.0022}}};
  double sum = 0.0;
  for (const auto& [x, y] : profile)
    sum += pow(surface(trial.sim.points, std::max(x, 0.5 * h), h) - y, 2);
  return {end_of_layer(trial.sim.points, density, bar), std::sqrt(sum / profile.size()) / height,
          trial.balances().energy_error};
}

}  // namespace

std::vector<Check> verify_bui(std::string_view name) {
  CheckList checks(name);
  for (const bool rate : {false, true}) {
    const Slump slump = aluminium_bars(rate, 0.0025);
    const char* law = rate ? "mu_i" : "coulomb";
    // The last point of the measured surface, as high as a bar.
    checks.near(fmt::format("{}_toe", law), slump.toe, 0.442, 0.05 * 0.442, "m");
    checks.error(fmt::format("{}_surface_rms", law), slump.surface_error, 0.03);
    checks.error(fmt::format("{}_energy_balance", law), slump.energy_error, 0.01);
  }
  return checks.take();
}

std::vector<Check> verify_undrained(std::string_view name) {
  // Lubrication theory and its slip-line correction bound the reach: docs/theory.
  struct Row {
    double aspect, b, corrected, lubrication;
  };
  CheckList checks(name);
  for (const Row& row :
       {Row{1.0, 0.05, 2.40, 2.82}, Row{1.0, 0.10, 1.72, 2.24}, Row{1.0, 0.15, 1.37, 1.96},
        Row{2.0, 0.10, 2.00, 2.82}, Row{2.0, 0.15, 1.56, 2.47}, Row{4.0, 0.15, 1.73, 3.11}}) {
    const double low = 0.95 * row.corrected, high = 1.05 * row.lubrication;
    checks.near(fmt::format("length_a{:g}_b{:.2f}", row.aspect, row.b),
                final_length(row.aspect, row.b, 20), 0.5 * (low + high), 0.5 * (high - low));
  }
  return checks.take();
}

std::vector<Check> verify_cut(std::string_view name) {
  CheckList checks(name);
  double fell = 0.0, stood = 1.0;
  for (const double b : {0.235, 0.245, 0.255, 0.265, 0.275, 0.285, 0.295}) {
    if (cut_stands(b, 16)) {
      stood = b;
      break;
    }
    fell = b;
  }
  checks.near("threshold", 0.5 * (fell + stood), 0.265, 0.01);
  return checks.take();
}

}  // namespace flowslide::mpm
