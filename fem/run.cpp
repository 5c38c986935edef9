#include "fem/run.hpp"

#include "fem/build_model.hpp"
#include "fem/checkpoint.hpp"
#include "fem/gravity.hpp"
#include "fem/time_step.hpp"
#include "model/checkpoint_file.hpp"
#include "model/resumable_history.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <omp.h>

namespace flowslide {
namespace {

using namespace fem;

constexpr int kModuliInterval = 16;  ///< steps between looks at stiffness and step

Damping rayleigh(const FemDampingConfig& c) {
  if (c.mass) return {*c.mass, *c.stiffness};
  const double w1 = 2.0 * kPi * c.frequencies[0], w2 = 2.0 * kPi * c.frequencies[1];
  return {2.0 * c.ratio * w1 * w2 / (w1 + w2), 2.0 * c.ratio / (w1 + w2)};
}

/// Ground velocity: the acceleration integrated as the straight line between its samples.
class Velocity {
 public:
  explicit Velocity(const GroundMotion& m) : dt_(m.dt), acceleration_(m.acceleration) {
    velocity_.assign(acceleration_.size(), 0.0);
    for (std::size_t i = 1; i < acceleration_.size(); ++i)
      velocity_[i] = velocity_[i - 1] + 0.5 * dt_ * (acceleration_[i - 1] + acceleration_[i]);
  }
  /// Zero acceleration after the end.
  [[nodiscard]] double at(double time) const {
    const double x = std::max(0.0, time / dt_);
    const auto i = static_cast<std::size_t>(x);
    if (i + 1 >= velocity_.size()) return velocity_.back();
    const double t = time - static_cast<double>(i) * dt_;
    const double slope = (acceleration_[i + 1] - acceleration_[i]) / dt_;
    return velocity_[i] + t * (acceleration_[i] + 0.5 * slope * t);
  }

 private:
  double dt_;
  std::vector<double> acceleration_, velocity_;
};

void set_stabilisation(Solver& s, const StabilisationConfig& c) {
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) {
    const double modulus = c.modulus.value_or(s.lambda[e] + 2.0 * s.shear[e]);
    s.water.alpha[e] = c.pressure * s.layout.elements.area[e] / modulus;
  }
}

/// The state on the nodes and elements of the section.
void fill(FemFrame& frame, const Solver& s, std::size_t nodes, std::size_t elements) {
  frame.time = s.state.time;
  frame.displacement.resize(nodes);
  frame.velocity.resize(nodes);
  frame.pore_pressure.assign(s.state.pressure.begin(), s.state.pressure.begin() + nodes);
  frame.stress.resize(elements);
  frame.strain.resize(elements);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int d = 0; d < 2; ++d) {
      frame.displacement[i][d] = s.state.displacement[s.model.dof[i][d]];
      frame.velocity[i][d] = s.state.velocity[s.model.dof[i][d]];
    }
  const Elements& g = s.layout.elements;
  for (std::size_t k = 0; k < g.size(); ++k) {
    const auto e = static_cast<std::size_t>(s.layout.order[k]);
    if (e >= elements) continue;
    frame.stress[e] = s.state.stress[k];
    StrainIncrement<2>& strain = frame.strain[e];
    strain = {};
    for (int i = 0; i < 4; ++i) {
      const Vec2& u = frame.displacement[s.layout.nodes[k][i]];
      strain[0] += g.bx[i][k] * u[0];
      strain[1] += g.by[i][k] * u[1];
      strain[3] += g.by[i][k] * u[0] + g.bx[i][k] * u[1];
    }
  }
}

/// Water at rest that stands far below the table is easily overlooked: layers drain each other by
/// their permeabilities, and the soil is stronger for it.
std::optional<std::string> drained_note(const SectionMesh& section, const FemConfig& config,
                                        const Solver& s) {
  if (!config.water) return std::nullopt;
  const double unit_weight = s.model.fluid.density * s.model.gravity;
  double missing = 0.0, standing = 0.0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < section.mesh.num_nodes(); ++i) {
    const auto [x, y] = section.mesh.nodes[i];
    const double p = unit_weight * std::max(0.0, water_level(*config.water, x) - y);
    if (p - s.state.pressure[i] <= missing || is_set(s.model.known_pressure[i])) continue;
    missing = p - s.state.pressure[i];
    standing = p;
    worst = i;
  }
  if (!(missing > 0.5 * standing)) return std::nullopt;
  return fmt::format(
      "pore pressure at rest lies up to {:.0f} kPa below that of standing water ({:.0f} kPa at "
      "({:.1f}, {:.1f}) m): steady flow by the permeabilities given drains the ground; "
      "gravity.permeability, one for all soil, leaves the water standing",
      1e-3 * missing, 1e-3 * standing, section.mesh.nodes[worst][0], section.mesh.nodes[worst][1]);
}

/// Of the nodes against the mean of those at the base [m].
double largest_displacement(const FemFrame& frame, const std::vector<std::int32_t>& base) {
  Vec2 ground{};
  for (const std::int32_t i : base)
    for (int d = 0; d < 2; ++d)
      ground[d] += frame.displacement[i][d] / static_cast<double>(base.size());
  double largest = 0.0;
  for (const Vec2& u : frame.displacement)
    largest = std::max(largest, std::hypot(u[0] - ground[0], u[1] - ground[1]));
  return largest;
}

/// Keeps the step below the stable one and makes steps end at the times of output.
class StepControl {
 public:
  StepControl(Solver& s, double courant) : courant_(courant), water_(water_frequency(s)) {}

  void choose(Solver& s, double left) {
    const double allowed = courant_ * stable_step({soil_frequency(s), water_}, s.damping.stiffness);
    if (!(allowed > 1e-9))
      throw NumericsError(fmt::format(
          "the stable step has fallen to {:.3g} s at {:.4f} s (soil has become extremely stiff or "
          "an element extremely small)",
          allowed, s.state.time));
    const bool fits = s.dt <= allowed && s.dt >= 0.8 * allowed;
    const double steps = left / s.dt;
    if (fits && std::abs(steps - std::round(steps)) < 1e-6 * steps && steps > 0.5) return;
    s.dt = left / std::max(1.0, std::ceil(left / (0.97 * allowed)));
  }

 private:
  double courant_, water_;
};

}  // namespace

FemFacts run_fem(const SectionMesh& section, const GroundMotion& motion, const FemConfig& config,
                 const FemPaths& paths, int threads, const Progress& progress,
                 const StopRule& rule) {
  check(motion);
  omp_set_num_threads(std::max(1, threads));
  Solver s = make_solver(build_model(section, config), rayleigh(config.damping));
  for (double& g : s.hourglass_shear) g *= config.stabilisation.hourglass;
  solve_gravity(s, {config.gravity.permeability.value_or(kUnset), config.gravity.compacts});
  FemFacts facts;
  facts.out_of_balance = out_of_balance(s);
  refresh_moduli(s);
  set_stabilisation(s, config.stabilisation);
  if (config.stabilisation.hourglass_yields) let_hourglass_yield(s);

  const Velocity ground(motion);
  const double end = config.end.value_or(motion.duration());
  const std::size_t nodes = section.mesh.num_nodes(), elements = section.mesh.num_elements();
  std::vector<std::string> notes = section.notes;
  if (auto note = drained_note(section, config, s)) {
    facts.notes.push_back(*note);
    notes.push_back(std::move(*note));
  }
  FemFrame frame;
  fill(frame, s, nodes, elements);
  StepControl control(s, config.courant);
  start_motion(s);
  s.dt = 1e-12;
  RunState run{.since = kModuliInterval, .smallest_step = end};
  const std::string origin = fingerprint(section, motion, config, rule.settings);
  if (std::filesystem::exists(paths.checkpoint)) read_checkpoint(paths.checkpoint, origin, s, run);
  ResumableHistoryWriter history(
      paths.history, section.mesh,
      {"flowslide fem.run", "mean of xx and yy for PM4Sand, elastic plane strain for other laws",
       notes},
      frame, static_cast<std::size_t>(run.output - 1));
  if (rule.ends) {
    rule.ends(frame);
    for (std::int64_t i = 0; i + 1 < run.output; ++i)
      rule.ends(history.frame(static_cast<std::size_t>(i)));
  }

  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const double seconds_before = run.seconds;
  Clock::time_point last_checkpoint = start;
  const auto seconds_since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  const auto checkpoint = [&] {
    history.flush();
    run.seconds = seconds_before + seconds_since(start);
    write_checkpoint(paths.checkpoint, origin, s, run);
    last_checkpoint = Clock::now();
  };
  const std::vector<std::int32_t> base = nodes_of(find_set(section, "base"));
  while (s.state.time < end * (1.0 - 1e-9) && !facts.stopped && !facts.stopped_by_rule) {
    const double target = std::min(end, static_cast<double>(run.output) * config.output_interval);
    while (target - s.state.time > 1e-9 * config.output_interval) {
      if (run.since++ >= kModuliInterval) {
        refresh_moduli(s);
        control.choose(s, target - s.state.time);
        run.smallest_step = std::min(run.smallest_step, s.dt);
        run.largest_step = std::max(run.largest_step, s.dt);
        run.since = 1;
      }
      advance(s, {ground.at(s.state.time), ground.at(s.state.time + s.dt)});
      if (progress.should_stop()) {
        checkpoint();
        throw Interrupted(
            fmt::format("interrupted at {:.2f} s of shaking; the same command continues from there",
                        s.state.time));
      }
      if (seconds_since(last_checkpoint) > kCheckpointSeconds) checkpoint();
    }
    s.state.time = target;
    fill(frame, s, nodes, elements);
    history.append(frame);
    ++run.output;
    run.since = kModuliInterval;
    run.largest_displacement = largest_displacement(frame, base);
    facts.stopped_by_rule = rule.ends && rule.ends(frame);
    facts.stopped =
        config.stop_displacement && run.largest_displacement >= *config.stop_displacement;
    progress.report(target / end, fmt::format("{:.2f} s, step {:.3g} s", target, s.dt));
  }
  history.finish();
  std::filesystem::remove(paths.checkpoint);
  facts.seconds = seconds_before + seconds_since(start);
  facts.end_time = s.state.time;
  facts.steps = s.state.step;
  facts.largest_displacement = run.largest_displacement;
  facts.smallest_step = run.smallest_step;
  facts.largest_step = run.largest_step;
  const Energy& energy = s.state.energy;
  facts.energy_error = energy.error();
  facts.base_work = energy.base;
  facts.damping_work = energy.damping + energy.viscous;
  facts.kinetic_energy = energy.kinetic;
  facts.sub_steps = static_cast<double>(s.counters.sub_steps);
  facts.floored = static_cast<double>(s.counters.floored);
  return facts;
}

}  // namespace flowslide
