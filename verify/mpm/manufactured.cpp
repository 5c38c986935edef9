#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/periodic.hpp"

#include <algorithm>
#include <cmath>

/// Manufactured solutions: motions that are chosen, with the body force that makes them exact for
/// the neo-Hookean law. V3 in one dimension, between walls (Wallstedt & Guilkey 2008) and periodic;
/// V5 a ring that is sheared by rotation and returns (Kamojjala & Brannon 2015).
namespace flowslide::mpm {
namespace {

MaterialSpec neo_hookean(double youngs_modulus, double poisson_ratio) {
  return material("neo_hookean",
                  {{"youngs_modulus", youngs_modulus}, {"poisson_ratio", poisson_ratio}});
}

/// u = A sin(k X) sin(c k t), P = mu (F - 1/F), nu = 0.
struct Wave {
  static constexpr double young = 1e7, density = 1000.0, amplitude = 1e-3;
  double k;
  double speed = std::sqrt(young / density);
  [[nodiscard]] double u(double x, double t) const {
    return amplitude * sin(k * x) * sin(speed * k * t);
  }
  [[nodiscard]] double start_velocity(double x) const { return amplitude * speed * k * sin(k * x); }
  [[nodiscard]] double body(double x, double t) const {
    const double f = 1.0 + amplitude * k * cos(k * x) * sin(speed * k * t);
    return k * k * u(x, t) * (0.5 * young / density * (1.0 + 1.0 / (f * f)) - speed * speed);
  }
};

/// Root-mean-square error of u over A, largest between half and one and a half periods.
template <class Scene, class ForEach>
double wave_error(Scene& scene, Trial& trial, const ParticleSet& p, const Wave& wave,
                  ForEach&& for_each) {
  const double period = 2.0 * kPi / (wave.speed * wave.k);
  const Points<2>& q = trial.sim.points;
  const std::size_t n = p.size();
  double worst = 0.0;
  while (trial.sim.time < 1.5 * period) {
    const double now = trial.sim.time;
    trial.accelerate([&](std::size_t i) {
      const double x = p.position[static_cast<std::size_t>(q.index[i]) % n][0];
      return std::array{wave.body(x, now), 0.0};
    });
    scene.step();
    if (trial.sim.time < 0.5 * period) continue;
    double sum = 0.0;
    for_each([&](std::size_t i) {
      const double x = p.position[static_cast<std::size_t>(q.index[i]) % n][0];
      const double error = q.x[0][i] - x - wave.u(x, trial.sim.time);
      sum += pow(error - std::round(error), 2);  // the strip's length is 1
    });
    worst = std::max(worst, std::sqrt(sum / static_cast<double>(n)) / Wave::amplitude);
  }
  return worst;
}

ParticleSet wave_points(double h, const Wave& wave) {
  ParticleSet p;
  p.materials = {neo_hookean(Wave::young, 0.0)};
  fill(p, {0.0, 0.0, 1.0, 2.0 * h}, 0.5 * h, Wave::density);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i][0] = wave.start_velocity(p.position[i][0]);
  return p;
}

FlowConfig wave_config(double h, Transfer transfer) {
  FlowConfig config = free_space(h);
  config.transfer = transfer;
  config.flip_share = 1.0;
  config.courant = 0.5;
  return config;
}

double walled_error(int cells, Transfer transfer) {
  const Wave wave{kPi};
  const ParticleSet p = wave_points(1.0 / cells, wave);
  FlowConfig config = wave_config(1.0 / cells, transfer);
  config.left_roller = 0.0;
  config.right_roller = 1.0;
  Trial trial(p, config);
  return wave_error(trial, trial, p, wave, [&](auto&& f) {
    for (std::size_t i = 0; i < p.size(); ++i) f(i);
  });
}

double periodic_error(int cells, Transfer transfer) {
  const Wave wave{2.0 * kPi};
  const ParticleSet p = wave_points(1.0 / cells, wave);
  PeriodicStrip strip(p, 1.0, wave_config(1.0 / cells, transfer));
  return wave_error(strip, strip.trial, p, wave, [&](auto&& f) { strip.for_each(f); });
}

/// The ring: rotation by alpha = g(t) h(R), g = sin(pi t), pure shear gamma = R alpha' at constant
/// volume; in the neo-Hookean law s_rt = mu gamma, s_tt = mu gamma^2.
struct Ring {
  static constexpr double inner = 0.75, outer = 1.25, density = 1000.0, young = 1e6, nu = 0.3;
  static constexpr double mu = young / (2.0 * (1.0 + nu));
  double r, angle, h, h1, h2;  ///< radius, start angle, profile and its derivatives

  Ring(double x, double y) : r(hypot(x, y)), angle(atan2(y, x)) {
    const double s = (r - 1.0) / (outer - inner), slope = 1.0 / (outer - inner);
    h = 1.0 - 8.0 * s * s + 16.0 * s * s * s * s;
    h1 = slope * (-16.0 * s + 64.0 * s * s * s);
    h2 = slope * slope * (-16.0 + 192.0 * s * s);
  }
  /// Largest shear of all times.
  [[nodiscard]] double largest_shear() const { return r * std::abs(h1); }
  [[nodiscard]] std::array<double, 2> position(double g) const {
    const double at = angle + h * g;
    return {r * cos(at), r * sin(at)};
  }
  /// With g(t) and its rate.
  [[nodiscard]] std::array<double, 2> body(double g, double g1) const {
    const double rate = g1 * h;
    const double gamma = r * g * h1, slope = g * (h1 + r * h2);
    const double radial = -rate * rate * r + mu * gamma * gamma / (density * r);
    const double turning = -kPi * kPi * g * h * r - mu / density * (slope + 2.0 * gamma / r);
    const double at = angle + h * g, c = cos(at), s = sin(at);
    return {radial * c - turning * s, radial * s + turning * c};
  }
};

struct RingErrors {
  double middle, end;  ///< root-mean-square distance from the exact place at t = 1/2 and 1 [m]
};

/// Points on a square lattice, so many per cell and direction.
ParticleSet lattice_points(double h, int per_direction) {
  ParticleSet p;
  p.materials = {neo_hookean(Ring::young, Ring::nu)};
  fill(p, {-1.28, -1.28, 1.28, 1.28}, h / per_direction, Ring::density, 0, [](double x, double y) {
    const double r = hypot(x, y);
    return r > Ring::inner && r < Ring::outer;
  });
  return p;
}

/// Points on concentric rings, which slide over one another, so that no gap opens between them as
/// it does in a lattice. Four in a cell; across the rings `most` where the shear is largest, which
/// the error asks for.
ParticleSet ring_points(double h, int most) {
  constexpr int along = 4;
  constexpr double largest = 7.05;  // of the shear
  ParticleSet p;
  p.materials = {neo_hookean(Ring::young, Ring::nu)};
  for (double r = Ring::inner; r < Ring::outer - 1e-9;) {
    const double guess = h / along;
    const double shear = Ring(r + 0.5 * guess, 0.0).largest_shear();
    const double wanted = h / std::max<double>(along, most * shear / largest);
    const double left = Ring::outer - r, width = left < 1.5 * wanted ? left : wanted;
    const double middle = r + 0.5 * width;
    const auto count = static_cast<int>(std::ceil(2.0 * kPi * middle * along / h));
    const std::size_t first = p.size();
    resize(p, first + static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const std::size_t q = first + static_cast<std::size_t>(i);
      const double at = 2.0 * kPi * (i + 0.5) / count;
      p.position[q] = {middle * cos(at), middle * sin(at), 0.0};
      p.volume[q] = 2.0 * kPi * middle * width / count;
      p.mass[q] = Ring::density * p.volume[q];
      p.material[q] = 0;
      p.id[q] = static_cast<std::int64_t>(q) + 1;
    }
    r += width;
  }
  return p;
}

RingErrors turn_ring(double h, ParticleSet p, Transfer transfer) {
  std::vector<Ring> exact;
  for (std::size_t i = 0; i < p.size(); ++i) {
    exact.emplace_back(p.position[i][0], p.position[i][1]);
    const double rate = kPi * exact.back().h;
    p.velocity[i] = {-rate * p.position[i][1], rate * p.position[i][0], 0.0};
  }
  FlowConfig config = free_space(h);
  config.transfer = transfer;
  config.flip_share = 1.0;
  Trial trial(p, config);
  const Points<2>& q = trial.sim.points;
  const auto distance = [&] {
    double sum = 0.0;
    const double g = sin(kPi * trial.sim.time);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const auto at = exact[static_cast<std::size_t>(q.index[i])].position(g);
      sum += pow(q.x[0][i] - at[0], 2) + pow(q.x[1][i] - at[1], 2);
    }
    return std::sqrt(sum / static_cast<double>(q.size()));
  };
  // A ring that has torn never comes back, and its debris would set ever smaller steps.
  const auto torn = [&] {
    return trial.sim.step % 100 == 0 && !(distance() < Ring::outer - Ring::inner);
  };
  const auto run_to = [&](double time) {
    while (trial.sim.time < time && !torn()) {
      const double g = sin(kPi * trial.sim.time), g1 = kPi * cos(kPi * trial.sim.time);
      trial.accelerate(
          [&](std::size_t i) { return exact[static_cast<std::size_t>(q.index[i])].body(g, g1); });
      trial.step();
    }
    return distance();
  };
  const double middle = run_to(0.5);
  return {middle, run_to(1.0)};
}

}  // namespace

std::vector<Check> verify_wave(std::string_view name) {
  CheckList checks(name);
  const std::vector<int> cells{16, 32, 64};
  const auto study = [&](const char* label, auto&& error_of) {
    std::vector<double> size, error;
    for (const int n : cells) {
      size.push_back(1.0 / n);
      error.push_back(error_of(n));
    }
    // 64 cells a wave, of which one and a half go by: two per cent of the amplitude.
    checks.error(fmt::format("{}_64_cells", label), error.back(), 0.02);
    checks.at_least(fmt::format("{}_order", label), fitted_order(size, error), 1.9);
  };
  study("periodic", [](int n) { return periodic_error(n, Transfer::flip); });
  study("walls", [](int n) { return walled_error(n, Transfer::flip); });
  return checks.take();
}

std::vector<Check> verify_vortex(std::string_view name) {
  CheckList checks(name);
  std::vector<double> size, error;
  constexpr int points = 10;
  for (const double h : {0.08, 0.04, 0.02}) {
    const RingErrors e = turn_ring(h, ring_points(h, points), Transfer::apic);
    size.push_back(h);
    error.push_back(e.end);
    if (h > 0.02) continue;
    checks.error("middle_h0.02", e.middle, 0.01, "m");
    checks.error("return_h0.02", e.end, 0.01, "m");
  }
  checks.at_least("order", fitted_order(size, error), 1.0);
  checks.at_least("control_torn_with_4_points",
                  turn_ring(0.04, lattice_points(0.04, 4), Transfer::apic).end, 0.25, "m");
  return checks.take();
}

}  // namespace flowslide::mpm
