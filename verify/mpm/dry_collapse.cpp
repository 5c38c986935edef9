#include "core/elementary.hpp"
#include "model/front.hpp"
#include "verify/mpm/dry_columns.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flowslide::mpm {
namespace {

constexpr double kSandDensity = 1600.0, kGrains = 2500.0;  ///< of the bulk and of grains [kg/m3]
/// Young's modulus over the vertical stress at the foot: a quarter or ten times as much moves the
/// front by 3 %.
constexpr double kStiffness = 127.0;
constexpr double kLongestCollapse = 12.5, kLook = 0.3;  ///< [sqrt(height / g)]

MaterialSpec grains(const DryColumn& c, double height) {
  std::map<std::string, double> v{{"youngs_modulus", kStiffness * kSandDensity * kGravity * height},
                                  {"poisson_ratio", c.poisson_ratio}};
  if (c.law == Friction::rate) {
    v.merge(std::map<std::string, double>{{"mu_static", c.friction},
                                          {"mu_limit", c.friction + c.rise},
                                          {"inertial_number", c.inertial},
                                          {"grain_size", c.grain},
                                          {"lode_dependence", c.lode_dependence},
                                          {"grain_density", kGrains}});
    return material("mu_i", v);
  }
  const double plane = asin(c.friction), principal = atan2(c.friction, 1.0);
  v.merge(std::map<std::string, double>{
      {"cohesion", 0.0}, {"friction_angle", c.law == Friction::coulomb_plane ? plane : principal}});
  return material("mohr_coulomb", v);
}

template <int Dim>
ParticleSet lattice(const DryColumn& c, double height, double spacing) {
  ParticleSet p;
  p.dim = Dim;
  const auto count = [&](double side) { return static_cast<int>(std::lround(side / spacing)); };
  const double across = c.shape == Shape::round ? c.length : c.width;
  const int rows = Dim == 2 ? 1 : count(across);
  const double k0 = c.poisson_ratio / (1.0 - c.poisson_ratio);
  for (int k = 0; k < count(height); ++k) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < count(c.length); ++i) {
        const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing, z = (k + 0.5) * spacing;
        if (c.shape == Shape::round && x * x + y * y > c.length * c.length) continue;
        const std::size_t q = p.size();
        const double vertical = -kSandDensity * kGravity * (height - z), side = k0 * vertical;
        resize(p, q + 1);
        if constexpr (Dim == 2) {
          p.position[q] = {x, z, 0.0};
          p.stress[q] = {side, vertical, side, 0.0, 0.0, 0.0};
        } else {
          p.position[q] = {x, y, z};
          p.stress[q] = {side, side, vertical, 0.0, 0.0, 0.0};
        }
        p.volume[q] = pow(spacing, Dim);
        p.mass[q] = kSandDensity * p.volume[q];
        p.material[q] = 0;
        p.id[q] = static_cast<std::int64_t>(q) + 1;
      }
    }
  }
  return p;
}

template <int Dim>
double kinetic(const Points<Dim>& p) {
  double sum = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q)
    for (int d = 0; d < Dim; ++d) sum += p.mass[q] * p.v[d][q] * p.v[d][q];
  return sum;
}

/// Where a deposit that thins evenly is as thick as a grain, below which there is none. Of a wedge
/// the mass beyond x goes with (tip - x)^2, so a quarter of it lies in half the distance: that
/// gives the tip, and the mass the slope. docs/theory/verification-mpm.md, Dry columns
double edge(std::vector<Place>& places, const DryColumn& c) {
  constexpr std::array<double, 2> kShares{0.005, 0.02};
  std::array<double, 2> at{};
  places_beyond(places, kShares, at);
  double mass = 0.0;
  for (const Place& p : places) mass += p.mass;
  const double tip = 2.0 * at[0] - at[1], distance = tip - at[0];
  const double breadth = c.shape == Shape::round     ? 0.5 * kPi * tip  // a quarter of the circle
                         : c.shape == Shape::channel ? c.width
                                                     : 1.0;
  const double slope = 2.0 * kShares[0] * mass / (kSandDensity * breadth * distance * distance);
  return tip - c.grain / slope;
}

template <int Dim>
Deposit measure(const Points<Dim>& p, const DryColumn& c, double cell) {
  std::vector<Place> places;
  double top = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double at = c.shape == Shape::round
                          ? std::sqrt(p.x[0][q] * p.x[0][q] + p.x[1][q] * p.x[1][q])
                          : p.x[0][q];
    places.push_back({at, p.mass[q]});
    if (at < cell) top = std::max(top, p.x[Dim - 1][q] + 0.25 * cell);
  }
  return {fronts(places).q995 / c.length - 1.0, edge(places, c) / c.length - 1.0, top / c.length};
}

template <int Dim>
Deposit run(DryColumn c, int cells) {
  const double height = c.aspect * c.length, cell = std::min(height, c.length) / cells;
  if (c.shape == Shape::channel) c.width = 0.5 * cell * std::round(c.width / (0.5 * cell));
  ParticleSet p = lattice<Dim>(c, height, 0.5 * cell);
  p.materials = {grains(c, height)};
  FlowConfig config = free_space(cell);
  config.transfer = c.transfer;
  config.basis = c.basis;
  if (c.basis == BasisKind::mls) {  // as the workflows have it
    config.courant = 0.98;
    config.strain_limit = 0.1;
  }
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = is_set(c.ground) ? c.ground : c.friction;
  config.left_roller = 0.0;
  if (c.shape == Shape::channel) config.side_rollers = {{0.0, c.width}};
  if (c.shape == Shape::round) config.side_rollers = {{0.0, 50.0 * c.length}};
  Simulation<Dim> s = make_simulation<Dim>(p, config);
  if (c.shape == Shape::channel) s.rollers.side_friction = c.wall_friction;
  StepScratch<Dim> scratch(1);
  prepare(s, scratch, true);
  const double unit = std::sqrt(height / kGravity);
  double peak = 0.0, now = 0.0;
  for (double t = kLook; t <= kLongestCollapse; t += kLook) {
    while (s.time < t * unit) advance(s, scratch);
    now = kinetic(s.points);
    peak = std::max(peak, now);
    if (now < kQuiet * peak) break;
  }
  Deposit deposit = measure(s.points, c, cell);
  deposit.motion = now / peak;
  return deposit;
}

}  // namespace

DryColumn sand(double aspect) {
  return {.aspect = aspect, .friction = tan(30.0 * kPi / 180.0), .grain = 1e-3};
}

DryColumn beads(double aspect) {
  return {.shape = Shape::channel,
          .aspect = aspect,
          .width = 0.045,
          .friction = tan(27.4 * kPi / 180.0),
          .wall_friction = tan(24.8 * kPi / 180.0),
          .grain = 1.15e-3,
          .basis = BasisKind::mls};
}

Deposit collapse(const DryColumn& column, int cells) {
  return column.shape == Shape::plane ? run<2>(column, cells) : run<3>(column, cells);
}

}  // namespace flowslide::mpm
