#include "core/elementary.hpp"
#include "fem/implicit.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>
#include <functional>

/// A slope of loose sand on elastic rock between free fields, shaken until it liquefies and moves:
/// explicit against implicit steps in two dimensions, and what liquefaction costs the latter.
namespace flowslide::fem {
namespace {

// Shortly after the sand has liquefied. While it flows on, a change of 1e-15 in the motion grows to
// some hundredths of the pore pressure within 3 s.
constexpr double kSlopeEnd = 1.0, kSample = 0.02, kThreshold = 0.7, kStiffness = 476.0;

double slope_motion(double t) {
  return 0.4 * std::min(1.0, t) * sin(2.0 * kPi * 1.5 * t);  // up to 0.38 g
}

Solver slope(double G0) {
  SectionMesh mesh = section({.columns = 12, .rows = 4, .width = 24.0, .height = 8.0});
  for (Vec2& x : mesh.mesh.nodes) x[1] *= 1.0 - 0.5 * std::clamp((x[0] - 6.0) / 12.0, 0.0, 1.0);
  FemConfig c = config(sand(0.35, G0), 0.0);
  c.water->table = {{6.0, 8.0}, {18.0, 4.0}};
  c.base = {BaseMotionKind::outcrop, 500.0, 2000.0, true};
  c.sides.kind = SideKind::free_field;
  c.damping.stiffness = 1e-3;
  Solver s = at_rest(mesh, c);
  let_hourglass_yield(s);
  return s;
}

struct SlopeHistory {
  std::vector<double> crest;     ///< against the base, every kSample [m]
  double r_u = 0.0;              ///< mean of the saturated elements, at the end
  double liquefied = kSlopeEnd;  ///< when r_u of an element first passes kThreshold [s]
  double energy_error = 0.0;
  /// Implicit steps and their iterations before and after that, and halved steps in all.
  double steps[2] = {}, iterations[2] = {}, cut = 0.0;
};

/// Excess pore pressure over the vertical effective stress at rest: the mean, and the largest.
std::pair<double, double> r_u(const Solver& s, const State& rest) {
  double mean = 0.0, largest = 0.0, count = 0.0;
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) {
    if (!s.layout.saturated[e] || !(rest.stress[e][1] < -10e3)) continue;
    double excess = 0.0;
    for (const std::int32_t n : s.layout.nodes[e])
      excess += 0.25 * (s.state.pressure[n] - rest.pressure[n]);
    const double r = -excess / rest.stress[e][1];
    mean += r;
    largest = std::max(largest, r);
    count += 1.0;
  }
  return {mean / count, largest};
}

/// `step(s, left)` takes one step and returns its iterations.
SlopeHistory shake_slope(Solver s, const std::function<double(Solver&, double)>& step) {
  const State rest = s.state;
  constexpr std::size_t kCrest = 4 * 13 + 3;  // the surface at x = 6 m
  SlopeHistory h;
  for (int i = 1; i * kSample < kSlopeEnd * (1.0 + 1e-9); ++i) {
    while (i * kSample - s.state.time > 1e-9) {
      const double iterations = step(s, i * kSample - s.state.time);
      const int after = h.liquefied < kSlopeEnd ? 1 : 0;
      h.steps[after] += 1.0;
      h.iterations[after] += iterations;
    }
    const auto [mean, largest] = r_u(s, rest);
    h.r_u = mean;
    if (largest > kThreshold) h.liquefied = std::min(h.liquefied, s.state.time);
    h.crest.push_back(s.state.displacement[s.model.dof[kCrest][0]] -
                      s.state.displacement[s.model.dof[0][0]]);
  }
  h.energy_error = s.state.energy.error();
  return h;
}

SlopeHistory shake_slope_explicitly(double share = 1.0, double G0 = kStiffness) {
  const Solver start = slope(G0);
  const double dt = share * start.dt;
  return shake_slope(start, [&](Solver& s, double left) {
    s.dt = left / std::ceil(left / dt - 1e-9);
    advance(s, {slope_motion(s.state.time), slope_motion(s.state.time + s.dt)});
    return 0.0;
  });
}

SlopeHistory shake_slope_implicitly(const ImplicitSettings& settings) {
  const Solver start = slope(kStiffness);
  ImplicitSteps steps(start, settings);
  ImplicitRecord record;
  SlopeHistory h = shake_slope(start, [&](Solver& s, double left) {
    const std::int64_t before = record.iterations;
    steps.advance(s, record, left, slope_motion);
    return static_cast<double>(record.iterations - before);
  });
  h.cut = static_cast<double>(record.cut);
  return h;
}

/// Root mean square over the largest displacement.
double crest_difference(const SlopeHistory& a, const SlopeHistory& b) {
  double sum = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < b.crest.size(); ++i) {
    sum += pow(a.crest[i] - b.crest[i], 2);
    largest = std::max(largest, std::abs(b.crest[i]));
  }
  return std::sqrt(sum / static_cast<double>(b.crest.size())) / largest;
}

}  // namespace

std::vector<Check> verify_implicit_slope(std::string_view name) {
  CheckList checks(name);
  const SlopeHistory direct = shake_slope_explicitly(), shorter = shake_slope_explicitly(0.25);
  const SlopeHistory implicit = shake_slope_implicitly({.step = 5e-3});
  checks.at_least("r_u", direct.r_u, 0.3);
  checks.at_most("liquefied_at", direct.liquefied, 0.8 * kSlopeEnd, "s");
  // Explicit steps a quarter as long are another answer, and the implicit one is about as far away.
  checks.error("crest", crest_difference(implicit, direct), 0.02);
  checks.error("crest_explicit_quarter", crest_difference(shorter, direct), 0.02);
  checks.near("r_u_implicit", implicit.r_u, direct.r_u, 0.04);
  checks.near("r_u_explicit_quarter", shorter.r_u, direct.r_u, 0.04);
  checks.error("energy_explicit", direct.energy_error, 1e-6);
  checks.error("energy_implicit", implicit.energy_error, 1e-5);
  // what liquefaction costs: iterations of a step before and after, and steps that were halved
  checks.at_most("iterations_before", implicit.iterations[0] / implicit.steps[0], 5.0);
  checks.at_most("iterations_after", implicit.iterations[1] / implicit.steps[1], 20.0);
  checks.at_most("cut", implicit.cut, 10.0);
  // control: sand a fifth softer
  checks.at_least("control",
                  crest_difference(implicit, shake_slope_explicitly(1.0, 0.8 * kStiffness)), 0.04);
  return checks.take();
}

}  // namespace flowslide::fem
