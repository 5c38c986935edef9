#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// V13: two elastic discs collide (Sulsky, Chen & Schreyer 1994) and part again.
namespace flowslide::mpm {
namespace {

struct Rebound {
  double momentum;      ///< largest change over mass of a disc x speed
  double energy;        ///< kinetic energy after over before
  double energy_error;  ///< residual of the balance
  double gap;           ///< distance of the centres at the end over that at the start
};

Rebound collide(Transfer transfer) {
  const double h = 0.05, radius = 0.2, density = 1000.0, speed = 0.1;
  ParticleSet p;
  p.materials = {elastic(1000.0, 0.3)};
  for (const double centre : {0.25, 0.75}) {
    const std::size_t first = p.size();
    fill(p, {centre - radius, centre - radius, centre + radius, centre + radius}, 0.5 * h, density,
         0, [&](double x, double y) { return hypot(x - centre, y - centre) < radius; });
    const double v = centre < 0.5 ? speed : -speed;
    for (std::size_t q = first; q < p.size(); ++q) p.velocity[q] = {v, v, 0.0};
  }
  const std::size_t half = p.size() / 2;
  FlowConfig config = free_space(h);
  config.grid_origin = {0.013, 0.007};
  config.transfer = transfer;
  config.flip_share = 1.0;
  Trial trial(p, config);
  const auto distance = [&] {
    double d = 0.0;
    const Points<2>& q = trial.sim.points;
    for (std::size_t i = 0; i < q.size(); ++i)
      d += (static_cast<std::size_t>(q.index[i]) < half ? -1.0 : 1.0) * q.x[0][i] /
           static_cast<double>(half);
    return d;
  };
  const double start = distance();
  const PointSums<2>& before = trial.reference.start;
  Rebound r{};
  while (trial.sim.time < 3.5) {
    trial.step();
    const PointSums<2> now = sum_points(trial.sim);
    for (int d = 0; d < 2; ++d)
      r.momentum = std::max(
          r.momentum, std::abs(now.momentum[d] - before.momentum[d]) / (0.5 * before.mass * speed));
  }
  const PointSums<2> after = sum_points(trial.sim);
  r.energy = (after.kinetic + after.recoverable) / before.kinetic;
  r.energy_error = trial.balances().energy_error;
  r.gap = distance() / start;
  return r;
}

}  // namespace

std::vector<Check> verify_impact(std::string_view name) {
  CheckList checks(name);
  for (const auto& [label, scheme] :
       {std::pair{"apic", Transfer::apic}, std::pair{"flip", Transfer::flip}}) {
    const Rebound r = collide(scheme);
    checks.error(fmt::format("momentum_{}", label), r.momentum, 1e-12);
    checks.error(fmt::format("energy_balance_{}", label), r.energy_error, 0.01);
    checks.at_most(fmt::format("energy_left_{}", label), r.energy, 1.0);
    checks.at_least(fmt::format("parted_{}", label), r.gap, 0.9);
  }
  return checks.take();
}

}  // namespace flowslide::mpm
