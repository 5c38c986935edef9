#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "mpm/run/load.hpp"
#include "mpm/solver/balance.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <cmath>

/// V8 in three dimensions: the block of V8 on a plane given as a height field, which rises in any
/// direction of the map.
namespace flowslide::mpm {
namespace {

constexpr double kSlabLength = 5.0, kWidth = 2.0, kSlabHeight = 1.0, kSlabDensity = 2000.0,
                 kSlabCell = 0.25;
constexpr double kSlabEnd = 1.0;

using Axes = std::array<std::array<double, 3>, 3>;  ///< up the slope, across it, normal to it

Axes axes(double angle, double direction) {
  const double c = cos(angle), s = sin(angle);
  const double x = cos(direction), y = sin(direction);
  return {{{c * x, c * y, s}, {-y, x, 0.0}, {-s * x, -s * y, c}}};
}

ParticleSet block(const Axes& axis, double normal_gravity) {
  ParticleSet p;
  p.dim = 3;
  p.materials = {elastic(200e6, 0.2)};
  const double d = 0.5 * kSlabCell;
  const auto along = static_cast<int>(kSlabLength / d), across = static_cast<int>(kWidth / d);
  const auto up = static_cast<int>(kSlabHeight / d);
  resize(p, std::size_t(along) * across * up);
  for (int k = 0, q = 0; k < up; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < along; ++i, ++q) {
        const std::array<double, 3> at{(i + 0.5) * d, (j + 0.5) * d, (k + 0.5) * d};
        const double stress = -kSlabDensity * normal_gravity * (kSlabHeight - at[2]);
        const std::array<double, 3>& n = axis[2];
        p.position[q] = {};
        for (int e = 0; e < 3; ++e)
          for (int a = 0; a < 3; ++a) p.position[q][e] += at[a] * axis[a][e];
        p.stress[q] = {stress * n[0] * n[0], stress * n[1] * n[1], stress * n[2] * n[2],
                       stress * n[0] * n[1], stress * n[1] * n[2], stress * n[2] * n[0]};
        p.volume[q] = d * d * d;
        p.mass[q] = kSlabDensity * p.volume[q];
        p.material[q] = 0;
        p.id[q] = q + 1;
      }
    }
  }
  return p;
}

HeightField plane(const Axes& axis) {
  HeightField f;
  f.spacing = 0.8;
  f.columns = f.rows = 51;
  f.corner = {-20.0, -20.0};
  for (int j = 0; j < f.rows; ++j)
    for (int i = 0; i < f.columns; ++i)
      f.height.push_back(-((f.corner[0] + i * f.spacing) * axis[2][0] +
                           (f.corner[1] + j * f.spacing) * axis[2][1]) /
                         axis[2][2]);
  return f;
}

/// Way of the centre of mass after kSlabEnd, down the slope, across it and away from it [m].
std::array<double, 3> slide_slab(double angle, double direction, double friction) {
  const Axes axis = axes(angle, direction);
  FlowConfig config = free_space(kSlabCell);
  config.gravity = kGravity;
  Simulation<3> s = make_simulation<3>(block(axis, kGravity * cos(angle)), config);
  s.ground.friction = friction;
  s.ground.field = plane(axis);
  StepScratch<3> scratch(1);
  prepare(s, scratch, true);
  const auto centre = [&](int a) {
    double sum = 0.0;
    for (std::size_t q = 0; q < s.points.size(); ++q)
      for (int d = 0; d < 3; ++d) sum += s.points.x[d][q] * axis[a][d];
    return sum / double(s.points.size());
  };
  std::array<double, 3> way{centre(0), centre(1), centre(2)};
  while (s.time < kSlabEnd) advance(s, scratch);
  const double to_end = pow(kSlabEnd / s.time, 2);
  for (int a = 0; a < 3; ++a) way[a] = centre(a) - way[a];
  return {-way[0] * to_end, way[1] * to_end, way[2]};
}

}  // namespace

std::vector<Check> verify_terrain(std::string_view name) {
  CheckList checks(name);
  struct Case {
    int degrees, direction;
    double friction;
  };
  for (const Case& c : {Case{30, 0, 0.3}, Case{30, 30, 0.3}, Case{30, 225, 0.3}, Case{55, 20, 0.3},
                        Case{30, 30, 0.0}}) {
    const double angle = c.degrees * kPi / 180.0;
    const double exact =
        0.5 * kGravity * (sin(angle) - c.friction * cos(angle)) * kSlabEnd * kSlabEnd;
    const auto [down, across, away] = slide_slab(angle, c.direction * kPi / 180.0, c.friction);
    const std::string label =
        fmt::format("{}_deg_towards_{}_mu_{}", c.degrees, c.direction, c.friction);
    checks.near("slide_" + label, down, exact, 0.005 * exact, "m");
    checks.error("across_" + label, across, 0.005 * exact, "m");
    checks.error("gap_" + label, away, 0.05 * kSlabCell, "m");
  }
  const double stick = slide_slab(kPi / 6.0, kPi / 6.0, 0.7)[0];
  checks.error("stick_30_deg_towards_30", stick, 0.01, "m");
  return checks.take();
}

}  // namespace flowslide::mpm
