#include "verify/mpm/extremes.hpp"

#include "core/temporary_folder.hpp"
#include "mpm/run/flow.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/trial.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace flowslide::mpm {
namespace {

/// Numbers that are the same on every machine, which the library's distributions are not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  /// In [low, high).
  double between(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random_() >> 11);
  }
  int below(int count) { return static_cast<int>(between(0.0, count)); }
  bool one_in(int count) { return below(count) == 0; }
  /// As usual two times out of three, else up to ten decades from it on either side.
  double about(double usual) {
    return one_in(3) ? usual * std::pow(10.0, between(-10.0, 10.0)) : usual;
  }

 private:
  std::mt19937_64 random_;
};

MaterialSpec draw_material(Draw& draw) {
  const double young = draw.about(1e6), strength = draw.about(5e3);
  const double nu = draw.one_in(2) ? 0.49 : draw.between(0.0, 0.499999);
  const double angle = draw.between(0.0, 1.0);
  switch (draw.below(7)) {
    case 0:
      return elastic(young, nu);
    case 1:
      return material("neo_hookean", {{"youngs_modulus", young}, {"poisson_ratio", nu}});
    case 2:
      return material("mohr_coulomb", {{"youngs_modulus", young},
                                       {"poisson_ratio", nu},
                                       {"cohesion", strength},
                                       {"friction_angle", angle},
                                       {"residual_cohesion", strength * draw.between(0.0, 1.0)}});
    case 3:
      return material("drucker_prager", {{"youngs_modulus", young},
                                         {"poisson_ratio", nu},
                                         {"cohesion", strength},
                                         {"friction_angle", angle}});
    case 4:
      return material("newtonian_fluid", {{"bulk_modulus", young}, {"viscosity", draw.about(1.0)}});
    case 5:
      return material("mu_i", {{"youngs_modulus", young},
                               {"poisson_ratio", nu},
                               {"mu_static", 0.2},
                               {"mu_limit", 0.4},
                               {"inertial_number", 0.3},
                               {"grain_size", draw.about(1e-3)},
                               {"grain_density", draw.about(2650.0)}});
    default:
      return material("residual_strength", {{"youngs_modulus", young},
                                            {"poisson_ratio", nu},
                                            {"strength", strength},
                                            {"soft_strength", strength * draw.between(0.01, 1.0)},
                                            {"residual_strain", draw.about(0.1)}});
  }
}

ParticleSet draw_soil(Draw& draw, double size) {
  ParticleSet p;
  p.toe = 4.0 * size;
  p.materials = {draw_material(draw), draw_material(draw)};
  p.materials[1].name += "_below";
  fill(p, {0.0, 0.0, 4.0 * size, size}, 0.5 * size, draw.about(2000.0), 1);
  fill(p, {0.0, size, 3.0 * size, 4.0 * size}, 0.5 * size, draw.about(2000.0));
  const double stress = draw.one_in(2) ? 0.0 : draw.about(1e4), speed = draw.about(1.0);
  for (std::size_t q = 0; q < p.size(); ++q) {
    for (int k = 0; k < 3; ++k) p.stress[q][k] = -stress * draw.between(0.0, 1.0);
    if (draw.one_in(4)) p.velocity[q] = {speed * draw.between(-1.0, 1.0), 0.0, 0.0};
  }
  return p;
}

FlowConfig draw_config(Draw& draw, double size) {
  FlowConfig c = free_space(draw.about(size));
  c.ground.surface = {{0.0, 0.0}};
  c.ground.friction = draw.about(0.7);
  if (draw.one_in(4)) c.ground.surface = {{0.0, 0.0}, {5.0 * size, -size}, {6.0 * size, -size}};
  c.gravity = draw.about(9.81);
  c.basis = static_cast<BasisKind>(draw.below(4));
  c.transfer = static_cast<Transfer>(draw.below(6));
  c.update = static_cast<Update>(draw.one_in(2) ? draw.below(3) : 0);
  c.relaxation = draw.about(0.3);
  c.flip_share = draw.between(0.0, 1.0);
  c.fmpm_order = 1 + draw.below(4);
  if (draw.one_in(3)) c.volume_average = VolumeAverage::off;
  if (draw.one_in(3)) c.courant = draw.between(0.01, 1.0);
  if (draw.one_in(3)) c.velocity_limit = std::min(0.5, draw.about(0.5));
  if (draw.one_in(3)) c.strain_limit = std::min(0.2, draw.about(0.2));
  if (draw.one_in(4)) c.damping = draw.between(0.0, 0.99);
  if (draw.one_in(3)) c.left_roller = 0.0;
  if (draw.one_in(4)) c.outlet.right = 6.0 * size;
  if (draw.one_in(5)) c.absorbing.right = 4.5 * size;
  if (draw.one_in(5)) c.sleep = SleepSettings{draw.about(0.01), draw.about(0.01)};
  if (draw.one_in(4)) {
    c.extrude = ExtrudeSettings{2.0 * size, static_cast<Sides>(draw.below(3))};
  } else if (draw.one_in(2)) {
    TractionSettings t;
    t.from = {0.0, 4.0 * size};
    t.to = {3.0 * size, 4.0 * size};
    t.pressure = draw.about(1e5);
    t.shear = draw.one_in(2) ? draw.about(1e4) : 0.0;
    c.tractions = {t};
  }
  return c;
}

std::string describe(const ParticleSet& p, const FlowConfig& c, double size) {
  std::string text = fmt::format(
      "size {:.3g}, cell {:.3g}, gravity {:.3g}, basis {}, transfer {}, update {}, dimensions {}, "
      "traction {:.3g}, limits {:.3g} {:.3g} {:.3g}",
      size, c.cell, c.gravity, int(c.basis), int(c.transfer), int(c.update), c.extrude ? 3 : 2,
      c.tractions.empty() ? 0.0 : c.tractions[0].pressure, c.courant, c.velocity_limit,
      c.strain_limit);
  for (const MaterialSpec& m : p.materials) {
    text += "; " + m.law;
    for (const auto& [name, value] : m.parameters) text += fmt::format(" {} {:.3g}", name, value);
  }
  return text;
}

}  // namespace

Extreme run_extreme(std::uint64_t seed) {
  constexpr double kSteps = 200.0;
  Draw draw(seed);
  Extreme r;
  const double size = draw.one_in(4) ? std::pow(10.0, draw.between(-3.0, 4.0)) : 1.0;
  const ParticleSet soil = draw_soil(draw, size);
  FlowConfig config = draw_config(draw, size);
  r.scene = describe(soil, config, size);
  try {
    // Long enough for what goes wrong to go wrong.
    FlowConfig plane = config;
    plane.extrude.reset();
    config.end = kSteps * stable_step(make_simulation<2>(soil, plane));
    config.frame_interval = config.end;
    config.sample_interval = config.end / 10.0;
    const TemporaryFolder folder;
    run_flow(soil, config, {folder / "mpm.h5", folder / "mpm.checkpoint"}, 1, {});
  } catch (const Error& e) {
    r.code = e.exit_code();
    r.message = e.what();
  }
  return r;
}

std::vector<Check> verify_extremes(std::string_view name) {
  constexpr std::uint64_t kRuns = 400;
  CheckList checks(name);
  std::array<double, 5> ended{};
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) ++ended[std::min(run_extreme(seed).code, 4)];
  checks.near("runs_that_end", ended[0] + ended[2] + ended[3], kRuns, 0.0);
  // Controls: the draw is neither tame nor hopeless.
  checks.at_least("finished", ended[0], 0.1 * kRuns);
  checks.at_least("stopped_by_an_error", ended[3], 0.1 * kRuns);
  return checks.take();
}

}  // namespace flowslide::mpm
