#include "core/elementary.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>

/// The slope of f9_slope in the tailings of the Mochikoshi dam, which soften: shaken weakly for
/// 2.5 s it goes on by itself. How far it has come after 4 s hangs on the size of the elements,
/// unless the softening has a length. docs/theory/pm4sand.md
namespace flowslide::fem {
namespace {

constexpr double kShakingEnd = 4.0, kLength = 2.0;

double shaking(double t) {
  const double fade = std::clamp((2.5 - t) / 0.5, 0.0, 1.0);
  return 0.1 * std::min(1.0, t) * fade * sin(2.0 * kPi * 1.5 * t);  // up to 0.1 g
}

/// Crest against the base after kShakingEnd [m]; elements of `size` [m] before the slope.
double crest(double size, std::optional<double> length) {
  const Rectangle shape{.columns = static_cast<int>(std::lround(24.0 / size)),
                        .rows = static_cast<int>(std::lround(8.0 / size)),
                        .width = 24.0,
                        .height = 8.0};
  SectionMesh mesh = section(shape);
  for (Vec2& x : mesh.mesh.nodes) x[1] *= 1.0 - 0.5 * std::clamp((x[0] - 6.0) / 12.0, 0.0, 1.0);
  FemMaterialConfig tailings = sand(0.35, 476.0, 2.7);
  PM4Sand::Params& p = *tailings.laws.of<PM4Sand>();
  p.Q = 11.998;
  p.R = 3.75;
  p.tolerance = p.max_strain_increment = 1e-4;
  FemConfig c = config(tailings, 0.0);
  c.water->table = {{6.0, 8.0}, {18.0, 4.0}};
  c.base = {BaseMotionKind::outcrop, 500.0, 2000.0, true};
  c.sides.kind = SideKind::free_field;
  c.damping.mass = 0.13;
  c.damping.stiffness = 1.1e-3;
  Solver s = at_rest(mesh, c);
  if (length) spread_softening(s, *length);
  let_hourglass_yield(s);
  const double dt = s.dt;
  while (kShakingEnd - s.state.time > 1e-9) {
    const double left = kShakingEnd - s.state.time;
    s.dt = left / std::ceil(left / dt - 1e-9);
    advance(s, {shaking(s.state.time), shaking(s.state.time + s.dt)});
  }
  const auto node = shape.rows * (shape.columns + 1) + std::lround(6.0 / size);
  return s.state.displacement[s.model.dof[node][0]] - s.state.displacement[s.model.dof[0][0]];
}

}  // namespace

std::vector<Check> verify_softening_length(std::string_view name) {
  CheckList checks(name);
  const double coarse = crest(2.0, kLength);
  checks.at_least("crest", coarse, 0.1, "m");
  checks.error("elements_of_1_m", std::abs(crest(1.0, kLength) / coarse - 1.0), 0.15);
  checks.error("elements_of_0.67_m", std::abs(crest(2.0 / 3.0, kLength) / coarse - 1.0), 0.15);
  // control: without a length half the elements move more than half as far again
  checks.at_least("control", crest(1.0, {}) / crest(2.0, {}) - 1.0, 0.5);
  return checks.take();
}

}  // namespace flowslide::fem
