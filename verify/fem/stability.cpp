#include "core/elementary.hpp"
#include "core/temporary_folder.hpp"
#include "model/history.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>
#include <random>

/// F7, F9 and the table of failure modes: smooth undrained pressure, bending, rest, steps, and
/// inputs that nobody would choose.
namespace flowslide::fem {
namespace {

/// A strip load on the left third of undrained soil, brought on slowly.
struct Footing {
  double settlement;
  double roughness;  ///< pressure against the mean of its four neighbours, inside, over its mean
};

Footing undrained_footing(int cells, double stabilisation) {
  FemConfig c = config(elastic_soil(10e6, 0.25), 10.0);
  c.materials["soil"].permeability = {1e-14, 1e-14};
  c.sides.kind = SideKind::fixed;
  c.stabilisation.pressure = stabilisation;
  c.damping.stiffness = 2e-4;
  c.damping.mass = 5.0;
  Solver s = at_rest(section({.columns = cells, .rows = cells, .width = 10.0, .height = 10.0}), c);
  const std::vector<double> still = s.state.pressure;
  const int row = cells + 1;
  while (s.state.time < 3.0) {
    for (int i = 0; i <= cells / 3; ++i) {
      const double share = i == 0 || i == cells / 3 ? 0.5 : 1.0;
      s.model.load[s.model.dof[cells * row + i][1]] =
          -50e3 * share * 10.0 / cells * std::min(1.0, s.state.time / 1.0);
    }
    advance(s, {});
  }
  double rough = 0.0, size = 0.0;
  const auto excess = [&](int i, int j) {
    return s.state.pressure[j * row + i] - still[j * row + i];
  };
  for (int j = 1; j < cells - 1; ++j)
    for (int i = 1; i < cells; ++i) {
      const double mean =
          0.25 * (excess(i - 1, j) + excess(i + 1, j) + excess(i, j - 1) + excess(i, j + 1));
      rough += std::abs(excess(i, j) - mean);
      size += std::abs(excess(i, j));
    }
  return {-s.state.displacement[s.model.dof[cells * row][1]], rough / size};
}

}  // namespace

std::vector<Check> verify_undrained(std::string_view name) {
  CheckList checks(name);
  const Footing usual = undrained_footing(12, 0.25);
  checks.at_most("roughness", usual.roughness, 0.1);
  checks.at_least("roughness_control", undrained_footing(12, 0.0).roughness, 0.2);
  // what the stabilisation lets through vanishes with the size of elements
  const double coarse = undrained_footing(12, 0.025).settlement / usual.settlement;
  const double fine =
      undrained_footing(24, 0.025).settlement / undrained_footing(24, 0.25).settlement;
  checks.near("settlement_of_a_tenth_12_cells", coarse, 1.0, 0.1);
  checks.near("settlement_of_a_tenth_24_cells", fine, 1.0, 0.05);
  checks.at_least("gain_by_halving", (1.0 - coarse) / (1.0 - fine), 1.7);
  return checks.take();
}

namespace {

struct Cantilever {
  int rows = 4;
  double poisson = 0.3, hourglass = 1.0;
  std::optional<double> cohesion =
      std::nullopt;        ///< of soil without friction [Pa]; elastic if left out
  bool yields = true;      ///< hourglass motion, too
  double duration = 10.0;  ///< over the inverse of the first circular frequency
};

constexpr double kBeamLength = 10.0, kBeamDepth = 1.0, kBeamDensity = 100.0;
constexpr double kBeamMoment = 0.5 * kBeamDensity * 9.81 * kBeamDepth * kBeamLength * kBeamLength;

/// Tip of a cantilever under its weight over that of Timoshenko's beam in plane strain.
double tip_ratio(const Cantilever& beam) {
  constexpr double kYoung = 10e6;
  FemMaterialConfig m = elastic_soil(kYoung, beam.poisson);
  if (beam.cohesion) {
    m.laws.of<LinearElastic>().reset();
    m.laws.of<MohrCoulomb>().emplace();
    m.laws.of<MohrCoulomb>()->youngs_modulus = kYoung;
    m.laws.of<MohrCoulomb>()->poisson_ratio = beam.poisson;
    m.laws.of<MohrCoulomb>()->cohesion = *beam.cohesion;
    m.laws.of<MohrCoulomb>()->friction_angle = 0.0;
    m.laws.of<MohrCoulomb>()->tension_cutoff = 100.0 * *beam.cohesion;
  }
  m.density = kBeamDensity;
  FemConfig c = config(m, 0.0);
  c.water.reset();
  c.sides.kind = SideKind::fixed;
  const int columns = 20 * (1 + beam.rows / 4);
  const SectionMesh mesh =
      section({.columns = columns, .rows = beam.rows, .width = kBeamLength, .height = kBeamDepth});
  Model model = build_model(mesh, c);
  model.num_dofs = 0;
  const auto held = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < mesh.mesh.num_nodes(); ++i)
    for (int d = 0; d < 2; ++d)
      model.dof[i][d] = mesh.mesh.nodes[i][0] == 0.0 ? held : model.num_dofs++;
  for (auto& dof : model.dof)
    for (std::int32_t& u : dof) u = std::min(u, model.num_dofs);
  model.base_dofs.clear();
  model.load.assign(model.num_dofs + 1, 0.0);
  // critical for the first mode: w = 3.52 sqrt(E I/(m L^4))
  const double plane = kYoung / (1.0 - beam.poisson * beam.poisson);
  const double omega =
      3.52 * std::sqrt(plane * kBeamDepth * kBeamDepth / 12.0 / kBeamDensity) / 100.0;
  Solver s = make_solver(model, {2.0 * omega, 0.0});
  for (double& g : s.hourglass_shear) g *= beam.hourglass;
  refresh_moduli(s);
  if (beam.yields) let_hourglass_yield(s);
  start_motion(s);
  s.dt = 0.9 * stable_step({soil_frequency(s), 0.0}, 0.0);
  while (s.state.time < beam.duration / omega) advance(s, {});
  const double weight = kBeamDensity * 9.81 * kBeamDepth;
  const double bending = weight * pow(kBeamLength, 4) / (8.0 * plane * kBeamDepth / 12.0);
  const double shear =
      weight * kBeamLength * kBeamLength / (2.0 * 5.0 / 6.0 * s.shear[0] * kBeamDepth);
  return -s.state.displacement[model.dof[columns][1]] / (bending + shear);
}

}  // namespace

std::vector<Check> verify_hinge(std::string_view name) {
  CheckList checks(name);
  // c under which the moment of the weight is `share` of the plastic one, c depth^2/2
  const auto cohesion = [](double share) {
    return kBeamMoment / (0.5 * share * kBeamDepth * kBeamDepth);
  };
  const auto ratio = [&](int rows, double share, bool yields) {
    const Cantilever elastic{.rows = rows, .yields = false, .duration = 30};
    Cantilever beam = elastic;
    beam.cohesion = cohesion(share);
    beam.yields = yields;
    return tip_ratio(beam) / tip_ratio(elastic);
  };
  // One row carries 1/sqrt(3) of the plastic moment, four rows nearly all of it. Mass damping of
  // the first mode lets an excess of half the moment fall no faster than this.
  checks.near("one_row_stands_at_half", ratio(1, 0.5, true), 1.0, 0.02);
  checks.at_least("one_row_falls_at_1.5", ratio(1, 1.5, true), 2.5);
  // the corners of the held end yield early
  checks.near("four_rows_stand_at_half", ratio(4, 0.5, true), 1.0, 0.05);
  checks.at_least("four_rows_fall_at_1.5", ratio(4, 1.5, true), 2.5);
  // control: with elastic hourglass motion one row carries any moment
  checks.near("control_one_row_elastic", ratio(1, 1.5, false), 1.0, 0.02);
  return checks.take();
}

std::vector<Check> verify_bending(std::string_view name) {
  CheckList checks(name);
  checks.near("tip_4_rows", tip_ratio({}), 1.0, 0.05);
  checks.near("tip_4_rows_nearly_incompressible", tip_ratio({.poisson = 0.49}), 1.0, 0.05);
  // one row bends by its hourglass stiffness alone, which is 2/(1 - nu) times too small
  checks.near("tip_1_row_with_factor", tip_ratio({.rows = 1, .hourglass = 2.0 / 0.7}), 1.0, 0.05);
  checks.at_least("tip_1_row_control", tip_ratio({.rows = 1}), 2.0);
  return checks.take();
}

std::vector<Check> verify_rest(std::string_view name) {
  CheckList checks(name);
  SectionMesh slope = section({.columns = 16, .rows = 6, .width = 32.0, .height = 8.0});
  for (Vec2& x : slope.mesh.nodes) x[1] *= 1.0 - 0.5 * std::clamp((x[0] - 8.0) / 16.0, 0.0, 1.0);
  FemConfig c = config(sand(0.55, 677.0, 0.4), 0.0);
  c.water->table = {{8.0, 7.5}, {24.0, 4.0}};
  c.sides.kind = SideKind::fixed;
  c.damping.stiffness = 1e-3;
  Solver s = at_rest(slope, c);
  checks.error("out_of_balance", out_of_balance(s), 1e-10);
  const std::vector<double> before = s.state.pressure;
  while (s.state.time < 10.0) advance(s, {});
  double drift = 0.0, r_u = 0.0;
  for (const double u : s.state.displacement) drift = std::max(drift, std::abs(u));
  for (std::size_t i = 0; i < before.size(); ++i)
    r_u = std::max(r_u, std::abs(s.state.pressure[i] - before[i]) / (900.0 * 9.81));
  checks.at_most("drift_over_height", drift / 8.0, 1e-4);
  checks.at_most("r_u_at_one_metre", r_u, 0.01);
  // control: with stresses that do not carry its weight the slope moves
  for (Stress<2>& stress : s.state.stress)
    for (double& x : stress.v) x *= 0.8;
  while (s.state.time < 12.0) advance(s, {});
  double moved = 0.0;
  for (const double u : s.state.displacement) moved = std::max(moved, std::abs(u));
  checks.at_least("control", moved / 8.0, 1e-4);
  return checks.take();
}

namespace {

struct Shaken {
  double surface = 0.0, r_u = 0.0;
};

/// A column of loose sand, before it liquefies.
Shaken shaken_column(double courant, double increment) {
  FemMaterialConfig m = sand();
  m.laws.of<PM4Sand>()->max_strain_increment = increment;
  if (increment < 1e-5) m.laws.of<PM4Sand>()->tolerance = 1e-6;
  FemConfig c = config(m, 10.0);
  c.damping.stiffness = 1e-3;
  Solver s = at_rest(section({.columns = 1, .rows = 10, .width = 2.0, .height = 10.0}), c, courant);
  const auto ground = [](double t) { return 0.08 * sin(2.0 * kPi * 1.5 * t); };
  const std::int32_t top = s.model.dof.back()[0];
  Shaken r;
  while (s.state.time < 2.0) {
    advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
    r.surface = std::max(r.surface, std::abs(s.state.displacement[top]));
  }
  r.r_u = (s.state.pressure[10] - 9810.0 * 5.0) / (900.0 * 9.81 * 5.0);
  return r;
}

}  // namespace

std::vector<Check> verify_pm4sand_step(std::string_view name) {
  CheckList checks(name);
  const Shaken usual = shaken_column(0.5, 1e-5);
  const Shaken fine_steps = shaken_column(0.1, 1e-5);
  const Shaken fine_strains = shaken_column(0.5, 1e-6);
  checks.at_least("r_u", usual.r_u, 0.1);
  checks.near("surface_with_a_fifth_of_the_step", fine_steps.surface / usual.surface, 1.0, 0.01);
  checks.near("r_u_with_a_fifth_of_the_step", fine_steps.r_u, usual.r_u, 0.01);
  checks.near("surface_with_a_tenth_of_the_strain_increment", fine_strains.surface / usual.surface,
              1.0, 0.01);
  checks.near("r_u_with_a_tenth_of_the_strain_increment", fine_strains.r_u, usual.r_u, 0.01);
  return checks.take();
}

namespace {

enum class HostileOutcome { finished, named, bad };

bool finite(const FemHistory& history) {
  const auto all = [](const auto& array) {
    const auto* values = reinterpret_cast<const double*>(array.data());
    return std::all_of(values, values + array.size() * sizeof(array[0]) / sizeof(double),
                       [](double x) { return std::isfinite(x); });
  };
  for (std::size_t i = 0; i < history.times().size(); ++i) {
    const FemFrame f = history.frame(i);
    if (!all(f.displacement) || !all(f.velocity) || !all(f.pore_pressure) || !all(f.stress) ||
        !all(f.strain))
      return false;
  }
  return history.times().size() >= 2;
}

/// One random section and motion, from settings to the file; `random` goes on.
HostileOutcome hostile(std::mt19937& random) {
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
  };
  const auto log_uniform = [&](double a, double b) { return exp(uniform(log(a), log(b))); };
  const double height = log_uniform(0.5, 30.0);
  SectionMesh mesh = section({.columns = 4,
                              .rows = 4,
                              .width = height * uniform(0.3, 3.0),
                              .height = height,
                              .distortion = uniform(0.0, 0.3)});
  const double steep = uniform(0.0, 0.9), width = mesh.mesh.nodes[4][0];
  for (Vec2& x : mesh.mesh.nodes) x[1] *= 1.0 - steep * x[0] / width;
  FemMaterialConfig m = sand(uniform(0.2, 0.9), uniform(100.0, 1200.0), log_uniform(0.02, 5.0));
  m.laws.of<PM4Sand>()->max_strain_increment = 1e-3;
  m.laws.of<PM4Sand>()->tolerance = 1e-2;
  m.permeability = {log_uniform(1e-14, 1.0), log_uniform(1e-14, 1.0)};
  m.void_ratio = uniform(0.3, 2.0);
  m.density = uniform(1100.0, 2400.0);
  m.k0 = uniform(0.2, 0.95);
  if (random() % 5 == 0) {
    m.laws.of<PM4Sand>().reset();
    m.laws.of<MohrCoulomb>().emplace();
    m.laws.of<MohrCoulomb>()->youngs_modulus = log_uniform(1e5, 1e9);
    m.laws.of<MohrCoulomb>()->poisson_ratio = 0.3;
    m.laws.of<MohrCoulomb>()->cohesion = log_uniform(1.0, 1e5);
    m.laws.of<MohrCoulomb>()->friction_angle = uniform(0.0, 0.8);
  }
  FemConfig c = config(m, height * uniform(-0.2, 1.5));
  c.sides.kind = SideKind::fixed;
  c.water->bulk_modulus = log_uniform(1e5, 1e10);
  c.damping.stiffness = log_uniform(1e-6, 1e-2);
  if (steep > 0.45) c.damping.largest_ratio = 1.0;
  const double amplitude = 9.81 * log_uniform(0.01, 2.0), w = 2.0 * kPi * log_uniform(0.3, 20.0);
  const TemporaryFolder folder;
  const FemPaths paths{folder / "history.h5", folder / "checkpoint"};
  try {
    // the number of steps, not the time, is what costs
    c.end = std::min(1.0, 300.0 * at_rest(mesh, c).dt);
    c.output_interval = 0.5 * *c.end;
    GroundMotion motion{.dt = 0.01 * *c.end, .acceleration = {}, .origin = "sine"};
    for (int i = 0; i <= 100; ++i)
      motion.acceleration.push_back(amplitude * sin(w * motion.dt * i));
    run_fem(mesh, motion, c, paths, 1, {});
    return finite(FemHistory(paths.history)) ? HostileOutcome::finished : HostileOutcome::bad;
  } catch (const Error& e) {
    const bool left = std::filesystem::exists(paths.history);
    return !left && std::string_view(e.what()).size() > 20 ? HostileOutcome::named
                                                           : HostileOutcome::bad;
  }
}

}  // namespace

std::vector<Check> verify_hostile(std::string_view name) {
  CheckList checks(name);
  std::mt19937 random(2026);
  std::array<int, 3> count{};
  for (int k = 0; k < 100; ++k) ++count[static_cast<int>(hostile(random))];
  // all of them finish here; other rounding may end a few with a cause
  checks.at_least("finished", count[0], 95);
  checks.near("finished_or_named", count[0] + count[1], 100, 0);
  return checks.take();
}

}  // namespace flowslide::fem
