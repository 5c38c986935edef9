#include "verify/mpm/list.hpp"
#include "verify/mpm/periodic.hpp"

#include <algorithm>
#include <cmath>

/// V1: a column of `kColumnHeight` under its own weight. In one dimension the vertical stress
/// follows from equilibrium alone: -rho_0 g (l_0 - Y), Y the initial height.
namespace flowslide::mpm {
namespace {

constexpr double kColumnHeight = 50.0, kColumnDensity = 80.0;
constexpr double kSoft = 1e6, kStiff = 1e7;  ///< compressed by 4 and 0.4 per cent at the foot [Pa]

enum class Foot { ground, mirror };

/// Error of the vertical stress, in the mean over the initial volume, over rho_0 g l_0, with
/// `points` per cell and direction. Gravity grows over several periods and damping in proportion to
/// the mass, critical for the slowest mode, brings the column to rest. With Foot::mirror the column
/// stands on its own mirror image under gravity towards y = 0, which tells the error of the ground
/// from that of the interior.
double compaction_error(int cells, int points, double young, Foot foot) {
  const double h = kColumnHeight / cells, time = 15.0 * std::sqrt(kSoft / young);
  ParticleSet p;
  p.materials = {elastic(young, 0.0)};
  fill(p, {0.0, foot == Foot::ground ? 0.0 : -kColumnHeight, 3.0 * h, kColumnHeight}, h / points,
       kColumnDensity);
  FlowConfig config = free_space(h);
  if (foot == Foot::ground) config.ground.surface = {{0.0, 0.0}};
  config.ground.friction = 0.0;
  PeriodicStrip strip(p, 3.0 * h, config);
  Trial& trial = strip.trial;
  const Points<2>& q = trial.sim.points;
  while (trial.sim.time < time) {
    const double g = kGravity * std::min(1.0, 5.0 * trial.sim.time / time);
    trial.accelerate([&](std::size_t i) { return std::array{0.0, q.x[1][i] > 0.0 ? -g : g}; });
    strip.step();
    trial.damp(105.0 / time);
  }
  double sum = 0.0, volume = 0.0;
  strip.for_each([&](std::size_t i) {
    const std::size_t start = static_cast<std::size_t>(q.index[i]) % p.size();
    const double exact =
        -kColumnDensity * kGravity * (kColumnHeight - std::abs(p.position[start][1]));
    sum += std::abs(q.sigma[1][i] - exact) * p.volume[start];
    volume += p.volume[start];
  });
  return sum / volume / (kColumnDensity * kGravity * kColumnHeight);
}

double tolerance(int cells) { return 1e-3 * (40.0 / cells) * (40.0 / cells); }

}  // namespace

std::vector<Check> verify_compaction(std::string_view name) {
  CheckList checks(name);
  std::vector<double> size, error;
  for (const int cells : {10, 20, 40})
    checks.error(fmt::format("error_{}_cells", cells),
                 compaction_error(cells, 2, kSoft, Foot::ground), tolerance(cells));
  // Ten times as stiff: the floor of the quadrature, the square of the strain, is out of sight.
  for (const int cells : {10, 20, 40}) {
    size.push_back(kColumnHeight / cells);
    error.push_back(compaction_error(cells, 4, kStiff, Foot::ground));
    checks.error(fmt::format("stiff_4_points_{}_cells", cells), error.back(), tolerance(cells));
  }
  checks.at_least("stiff_order", fitted_order(size, error), 1.9);
  return checks.take();
}

std::vector<Check> verify_mirror(std::string_view name) {
  CheckList checks(name);
  for (const int cells : {10, 20, 40})
    checks.error(fmt::format("error_{}_cells", cells),
                 compaction_error(cells, 2, kSoft, Foot::mirror), tolerance(cells));
  return checks.take();
}

}  // namespace flowslide::mpm
