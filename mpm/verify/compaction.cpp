#include "mpm/verify/list.hpp"
#include "mpm/verify/trial.hpp"

#include <algorithm>

/// V1: a column of `kHeight` under its own weight. In one dimension the vertical stress follows
/// from equilibrium alone: -rho_0 g (l_0 - Y), Y the initial height.
namespace flowslide::mpm {
namespace {

constexpr double kHeight = 50.0, kDensity = 80.0, kYoung = 1e6;
constexpr double kDamping = 7.0;  ///< critical for the slowest mode [1/s]

enum class Foot { ground, mirror };

/// Error of the vertical stress, in the mean over the initial volume, over rho_0 g l_0. Gravity
/// grows over three seconds and damping in proportion to the mass brings the column to rest. With
/// Foot::mirror the column stands on its own mirror image under gravity towards y = 0, which tells
/// the error of the ground from that of the interior.
double compaction_error(int cells, Foot foot) {
  const double h = kHeight / cells;
  ParticleSet p;
  p.materials = {elastic(kYoung, 0.0)};
  fill(p, {0.0, foot == Foot::ground ? 0.0 : -kHeight, h, kHeight}, 0.5 * h, kDensity);
  FlowConfig config = free_space(h);
  if (foot == Foot::ground) config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = 0.0;
  config.left_roller = 0.0;
  config.right_roller = h;
  Trial trial(p, config);
  Points<2>& q = trial.sim.points;
  while (trial.sim.time < 15.0) {
    const double g = kGravity * std::min(1.0, trial.sim.time / 3.0);
    trial.accelerate([&](std::size_t i) { return std::array{0.0, q.x[1][i] > 0.0 ? -g : g}; });
    trial.step();
    trial.damp(kDamping);
  }
  double sum = 0.0, volume = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto start = static_cast<std::size_t>(q.index[i]);
    const double exact = -kDensity * kGravity * (kHeight - std::abs(p.position[start][1]));
    sum += std::abs(q.sigma[1][i] - exact) * p.volume[start];
    volume += p.volume[start];
  }
  return sum / volume / (kDensity * kGravity * kHeight);
}

double tolerance(int cells) { return 1e-3 * (40.0 / cells) * (40.0 / cells); }

}  // namespace

std::vector<Check> verify_compaction(std::string_view name) {
  CheckList checks(name);
  std::vector<double> size, error;
  for (const int cells : {10, 20, 40, 80}) {
    size.push_back(kHeight / cells);
    error.push_back(compaction_error(cells, Foot::ground));
    checks.error(fmt::format("error_{}_cells", cells), error.back(), tolerance(cells));
  }
  checks.at_least("order", fitted_order(size, error), 1.9);
  return checks.take();
}

std::vector<Check> verify_mirror(std::string_view name) {
  CheckList checks(name);
  for (const int cells : {10, 20, 40})
    checks.error(fmt::format("error_{}_cells", cells), compaction_error(cells, Foot::mirror),
                 tolerance(cells));
  return checks.take();
}

}  // namespace flowslide::mpm
