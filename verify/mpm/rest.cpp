#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>

/// V15: a column in hydrostatic equilibrium stays at rest over 1e5 steps, with its points and the
/// ground on the lines of the grid or anywhere between them.
namespace flowslide::mpm {
namespace {

constexpr double kLayerHeight = 5.0, kLayerDensity = 1800.0, kLayerCell = 0.5;

struct Motion {
  double fastest;     ///< largest speed ever [m/s]
  double at_end;      ///< the same at the end [m/s]
  double mean_error;  ///< of the mean stress over rho g H at the end, mean over the points
};

Motion stand(double offset, int steps) {
  ParticleSet p;
  p.materials = {elastic(20e6, 0.49)};
  fill(p, {0.0, 0.0, 2.0, kLayerHeight}, 0.5 * kLayerCell, kLayerDensity);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double s = -kLayerDensity * kGravity * (kLayerHeight - p.position[q][1]);
    p.stress[q] = {s, s, s, 0.0, 0.0, 0.0};
  }
  FlowConfig config = free_space(kLayerCell);
  config.grid_origin = {0.0, offset * kLayerCell};
  config.gravity = kGravity;
  config.ground.surface = {{0.0, 0.0}};
  config.left_roller = 0.0;
  config.right_roller = 2.0;
  Trial trial(p, config);
  Motion m{};
  for (int i = 0; i < steps; ++i) {
    trial.step();
    m.at_end = std::sqrt(trial.sim.last.max_speed2);
    m.fastest = std::max(m.fastest, m.at_end);
  }
  const Points<2>& q = trial.sim.points;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double mean = (q.sigma[0][i] + q.sigma[1][i] + q.sigma[2][i]) / 3.0;
    const double exact = p.stress[static_cast<std::size_t>(q.index[i])][0];
    m.mean_error += std::abs(mean - exact) / (kLayerDensity * kGravity * kLayerHeight) /
                    static_cast<double>(q.size());
  }
  return m;
}

}  // namespace

std::vector<Check> verify_rest(std::string_view name) {
  CheckList checks(name);
  const double limit = 1e-3 * std::sqrt(kGravity * kLayerHeight);
  for (const auto& [label, offset] : {std::pair{"aligned", 0.0}, std::pair{"offset", 0.3}}) {
    const Motion m = stand(offset, 100000);
    checks.error(fmt::format("fastest_{}", label), m.fastest, limit, "m/s");
    checks.error(fmt::format("at_end_{}", label), m.at_end, limit, "m/s");
    checks.error(fmt::format("stress_{}", label), m.mean_error, 0.01);
  }
  return checks.take();
}

}  // namespace flowslide::mpm
