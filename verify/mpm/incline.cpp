#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// V8: a block on a frictional incline of 30 degrees slides g (sin a - mu cos a) t^2 / 2, or sticks
/// if mu > tan a; the same with the incline at any angle to the grid.
namespace flowslide::mpm {
namespace {

constexpr double kSlope = kPi / 6.0, kBlockLength = 5.0, kBlockHeight = 1.0, kBlockDensity = 2000.0,
                 kBlockCell = 0.25;
constexpr double kSlideEnd = 1.0;

struct BlockSlide {
  double along, normal;  ///< displacement of the centre of mass after kSlideEnd [m]
};

/// The answer is that of a rigid block. An elastic one rubs less until a shear wave has told its
/// mass of the ground: it gains about mu g cos(a) t_s / 2, t_s = H / c_s.
/// `turn` is the angle of the ground to the grid [rad]; the ground falls to the right.
BlockSlide slide_block(double turn, double mu) {
  const std::array<double, 2> along{cos(turn), -sin(turn)};
  const std::array<double, 2> normal{sin(turn), cos(turn)};
  ParticleSet p;
  p.materials = {elastic(200e6, 0.2)};
  fill(p, {-0.5 * kBlockLength, 0.0, 0.5 * kBlockLength, kBlockHeight}, 0.5 * kBlockCell,
       kBlockDensity);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double s = p.position[q][0], n = p.position[q][1];
    p.position[q] = {s * along[0] + n * normal[0], s * along[1] + n * normal[1], 0.0};
    const double stress = -kBlockDensity * kGravity * cos(kSlope) * (kBlockHeight - n);
    p.stress[q] = {stress * normal[0] * normal[0],
                   stress * normal[1] * normal[1],
                   0.0,
                   stress * normal[0] * normal[1],
                   0.0,
                   0.0};
  }
  FlowConfig config = free_space(kBlockCell);
  const double reach = 20.0;
  config.ground.surface = {{-reach, reach * tan(turn)}, {reach, -reach * tan(turn)}};
  config.ground.friction = mu;
  Trial trial(p, config);
  for (int d = 0; d < 2; ++d)
    trial.sim.gravity[d] = kGravity * (sin(kSlope) * along[d] - cos(kSlope) * normal[d]);
  const auto centre = [&] {
    std::array<double, 2> sum{};
    const Points<2>& q = trial.sim.points;
    for (std::size_t i = 0; i < q.size(); ++i)
      for (int d = 0; d < 2; ++d) sum[d] += q.mass[i] * q.x[d][i] / trial.reference.start.mass;
    return sum;
  };
  const auto start = centre();
  trial.run_to(kSlideEnd);
  const auto end = centre();
  const double dx = end[0] - start[0], dy = end[1] - start[1];
  // The last step went a little beyond kSlideEnd: back along the parabola.
  const double to_end = pow(kSlideEnd / trial.sim.time, 2);
  return {(dx * along[0] + dy * along[1]) * to_end, dx * normal[0] + dy * normal[1]};
}

}  // namespace

std::vector<Check> verify_incline(std::string_view name) {
  CheckList checks(name);
  const double mu = 0.3;
  const double exact = 0.5 * kGravity * (sin(kSlope) - mu * cos(kSlope)) * kSlideEnd * kSlideEnd;
  for (const int degrees : {0, 15, 30, 45}) {
    const double turn = degrees * kPi / 180.0;
    const BlockSlide sliding = slide_block(turn, mu);
    checks.near(fmt::format("slide_{}_deg", degrees), sliding.along, exact, 0.005 * exact, "m");
    checks.error(fmt::format("gap_{}_deg", degrees), sliding.normal, 0.05 * kBlockCell, "m");
    checks.error(fmt::format("stick_{}_deg", degrees), slide_block(turn, 0.7).along, 0.005 * exact,
                 "m");
  }
  return checks.take();
}

}  // namespace flowslide::mpm
