#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// V2: a bar held at x = 0 swings in its first mode, v = v0 sin(beta x) cos(w t).
namespace flowslide::mpm {
namespace {

constexpr double kBarLength = 25.0, kYoung = 100.0, kBarDensity = 1.0, kAmplitude = 0.1;
constexpr int kPeriods = 10;

struct Swing {
  double period_error;  ///< relative
  double energy_ratio;  ///< energy after ten periods over that at the start
};

Swing swing(int cells, Transfer transfer, int order = 2) {
  const double h = kBarLength / cells, beta = kPi / (2.0 * kBarLength);
  const double period = 4.0 * kBarLength * std::sqrt(kBarDensity / kYoung);
  ParticleSet p;
  p.materials = {elastic(kYoung, 0.0)};
  fill(p, {0.0, 0.0, kBarLength, 2.0 * h}, 0.5 * h, kBarDensity);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.velocity[q][0] = kAmplitude * sin(beta * p.position[q][0]);
  FlowConfig config = free_space(h);
  config.left_roller = 0.0;
  config.transfer = transfer;
  config.flip_share = 1.0;
  config.fmpm_order = order;
  Trial trial(p, config);
  const PointSums<2> start = sum_points(trial.sim);
  const int crossings = 2 * kPeriods;
  int seen = 0;
  double before = start.momentum[0], first = 0.0, last = 0.0;
  while (seen <= crossings) {
    trial.step();
    const double now = sum_points(trial.sim).momentum[0];
    if ((before > 0.0) != (now > 0.0)) {
      last = trial.sim.time - trial.sim.dt * now / (now - before);
      if (seen++ == 0) first = last;
    }
    before = now;
  }
  const PointSums<2> end = sum_points(trial.sim);
  return {(last - first) / (kPeriods * period) - 1.0,
          (end.kinetic + end.recoverable) / (start.kinetic + start.recoverable)};
}

}  // namespace

std::vector<Check> verify_bar(std::string_view name) {
  CheckList checks(name);
  for (const int cells : {25, 50, 100}) {
    for (const auto& [label, transfer] :
         {std::pair{"apic", Transfer::apic}, std::pair{"fmpm2", Transfer::fmpm}}) {
      const Swing s = swing(cells, transfer);
      checks.error(fmt::format("period_error_{}_{}_cells", label, cells), s.period_error, 1e-3);
      // Amplitude, so half of the energy's decay.
      checks.error(fmt::format("decay_per_period_{}_{}_cells", label, cells),
                   1.0 - pow(s.energy_ratio, 0.5 / kPeriods), 0.01);
    }
    checks.near(fmt::format("energy_flip_{}_cells", cells),
                swing(cells, Transfer::flip).energy_ratio, 1.0, 0.01);
  }
  // Beside a wall a series that minds it only in its sum gains energy from three terms on.
  for (const int order : {3, 4}) {
    const Swing s = swing(25, Transfer::fmpm, order);
    checks.error(fmt::format("period_error_fmpm{}_25_cells", order), s.period_error, 1e-3);
    checks.near(fmt::format("energy_fmpm{}_25_cells", order), s.energy_ratio, 1.0, 0.01);
  }
  const double tpic = swing(50, Transfer::tpic).energy_ratio;
  checks.error("decay_per_period_tpic", 1.0 - pow(tpic, 0.5 / kPeriods), 0.01);
  return checks.take();
}

}  // namespace flowslide::mpm
