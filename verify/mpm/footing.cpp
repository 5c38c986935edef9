#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// Strip load on weightless soil: the pressure under which it sinks without end is N_c c, 2 + pi
/// for phi = 0 (Prandtl 1920). The load hangs on the top row of points, so that its amount is
/// exact.
namespace flowslide::mpm {
namespace {

constexpr double kHalfWidth = 1.0, kCohesion = 10e3, kClayDensity = 2000.0;
constexpr double kWide = 4.0, kDeep = 2.0;
constexpr double kDamping = 10.0;  ///< in proportion to the mass [1/s]

struct Discretisation {
  double cell;  ///< [m]
  BasisKind basis = BasisKind::quadratic;
  VolumeAverage average = VolumeAverage::automatic;
};

struct Row {
  double level, velocity;  ///< [m], [m/s]
};

struct Footing {
  double spacing;
  std::vector<bool> loaded;  ///< by index
  double pressure = 0.0;     ///< [Pa]
  Trial trial;               ///< made by start(), which also fills the members above

  Footing(const MaterialSpec& soil, const Discretisation& d) : trial(start(soil, d)) {}

  void step() {
    Points<2>& q = trial.sim.points;
    trial.accelerate([&](std::size_t i) {
      const bool here = loaded[static_cast<std::size_t>(q.index[i])];
      return std::array{0.0, here ? -pressure * spacing / q.mass[i] : 0.0};
    });
    trial.step();
    trial.damp(kDamping);
  }
  /// Means over the loaded points.
  [[nodiscard]] Row row() const {
    Row r{};
    double count = 0.0;
    const Points<2>& q = trial.sim.points;
    for (std::size_t i = 0; i < q.size(); ++i) {
      if (!loaded[static_cast<std::size_t>(q.index[i])]) continue;
      r.level += q.x[1][i];
      r.velocity += q.v[1][i];
      count += 1.0;
    }
    return {r.level / count, r.velocity / count};
  }

 private:
  Trial start(const MaterialSpec& soil, const Discretisation& d) {
    spacing = 0.5 * d.cell;
    ParticleSet p;
    p.materials = {soil};
    fill(p, {0.0, 0.0, kWide, kDeep}, spacing, kClayDensity);
    loaded.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      loaded[i] = p.position[i][1] > kDeep - spacing && p.position[i][0] < kHalfWidth;
    FlowConfig config = free_space(d.cell);
    config.ground.surface = {{0.0, 0.0}};
    config.ground.friction = 1e6;
    config.left_roller = 0.0;
    config.right_roller = kWide;
    config.basis = d.basis;
    config.volume_average = d.average;
    return {p, config};
  }
};

/// Mean pressure over c, at settlements growing with a constant speed and then with twice as much;
/// extrapolated to no speed, which takes out inertia and the viscosity of the velocity transfer.
double bearing_capacity(const MaterialSpec& soil, const Discretisation& d, double expected,
                        double speed, double settlement) {
  Footing footing(soil, d);
  const double start = footing.row().level;
  const auto pressure_at = [&](double target, double from, double to) {
    double sum = 0.0, count = 0.0;
    for (double sunk = 0.0; sunk < to;) {
      footing.step();
      const Row row = footing.row();
      sunk = start - row.level;
      const double gain = std::min(3.0, expected * (target + row.velocity) / speed);
      footing.pressure += footing.trial.sim.dt * gain * kCohesion;
      if (sunk < from) continue;
      sum += footing.pressure;
      count += 1.0;
    }
    return sum / count / kCohesion;
  };
  const double slow = pressure_at(speed, 0.9 * settlement, settlement);
  const double fast = pressure_at(2.0 * speed, 1.2 * settlement, 1.3 * settlement);
  return 2.0 * slow - fast;
}

MaterialSpec clay(double nu) {
  return material("residual_strength", {{"youngs_modulus", 3000.0 * kCohesion},
                                        {"poisson_ratio", nu},
                                        {"strength", kCohesion},
                                        {"soft_strength", kCohesion},
                                        {"residual_strain", 0.0},
                                        {"tension_cutoff", 100.0 * kCohesion}});
}

MaterialSpec frictional(double degrees) {
  const double phi = degrees * kPi / 180.0;
  return material("mohr_coulomb", {{"youngs_modulus", 3000.0 * kCohesion},
                                   {"poisson_ratio", 0.3},
                                   {"cohesion", kCohesion},
                                   {"friction_angle", phi},
                                   {"dilation_angle", phi}});
}

}  // namespace

std::vector<Check> verify_prandtl(std::string_view name) {
  CheckList checks(name);
  const double nc = 2.0 + kPi, speed = 1e-3, settlement = 8e-3;
  const auto capacity = [&](const Discretisation& d) {
    return bearing_capacity(clay(0.49), d, nc, speed, settlement);
  };
  checks.near("cell_b_8", capacity({0.25}), nc, 0.03 * nc);
  checks.near("cell_b_12", capacity({1.0 / 6.0}), nc, 0.03 * nc);
  // Control: without the average over spans the same soil locks.
  checks.at_least("control_linear_locks", capacity({0.25, BasisKind::linear, VolumeAverage::off}),
                  1.2 * nc);
  return checks.take();
}

std::vector<Check> verify_prandtl_mc(std::string_view name) {
  CheckList checks(name);
  const double nc = 14.83;
  checks.near("phi20_cell_b_8", bearing_capacity(frictional(20.0), {0.25}, nc, 2e-3, 0.02), nc,
              0.05 * nc);
  return checks.take();
}

}  // namespace flowslide::mpm
