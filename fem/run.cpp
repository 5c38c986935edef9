#include "fem/run.hpp"

#include "fem/build_model.hpp"
#include "fem/checkpoint.hpp"
#include "fem/gravity.hpp"
#include "fem/implicit.hpp"
#include "fem/permeability.hpp"
#include "fem/run_states.hpp"
#include "fem/time_step.hpp"
#include "model/long_run.hpp"
#include "model/resumable_history.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <omp.h>

namespace flowslide {
namespace {

using namespace fem;

constexpr int kModuliInterval = 16;  ///< steps between looks at stiffness and step
/// Steps, recorded states and bytes of them above which a run is not begun, and days.
constexpr double kMostSteps = 1e8, kMostFrames = 1e5, kMostBytes = 1e12, kMostDays = 365.0;
constexpr double kElementsPerSecond = 1e6;  ///< explicit steps of a thread, for predictions of cost

/// Refuses a run that would not end in any useful time.
void check_steps(const Solver& s, double left, double dt, int threads) {
  const double steps = left / dt;
  const double days = steps * static_cast<double>(s.layout.elements.size()) /
                      (kElementsPerSecond * threads) / 86400.0;
  if (steps <= kMostSteps && days <= kMostDays) return;
  const std::string text = fmt::format(
      "{:.2g} s of shaking would take {:.2g} steps of {:.2g} s, about {:.2g} days (at most {:g} "
      "steps and {:g} days are begun) check end, the stiffest soil, the water's bulk modulus and "
      "the thinnest element, or integrate implicitly",
      left, steps, dt, days, kMostSteps, kMostDays);
  if (s.state.step == 0) throw InputError(text);
  throw NumericsError(text);
}

void check_output(const FemConfig& config, double end, std::size_t nodes, std::size_t elements) {
  const double frames = end / config.output_interval;
  validate(frames <= kMostFrames,
           "output_interval = {:g} s asks for {:.2g} recorded states until {:g} s (at most {:g} "
           "are kept) raise output_interval or lower end",
           config.output_interval, frames, end, kMostFrames);
  const double bytes = frames *
                       (5.0 * static_cast<double>(nodes) + 8.0 * static_cast<double>(elements)) *
                       sizeof(double);
  validate(bytes <= kMostBytes,
           "output_interval = {:g} s asks for {:.3g} GB of recorded states until {:g} s (at most "
           "{:g} GB are written) raise output_interval or lower end",
           config.output_interval, bytes * 1e-9, end, kMostBytes * 1e-9);
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

/// Explicit steps follow each other without iterations, and laws may be integrated more coarsely.
void set_explicit_constants(Solver& s) {
  for (std::size_t i = 0; i < s.model.materials.size(); ++i)
    std::visit(
        [&]<class M>(const flowslide::Material<M>& law) {
          std::get<LawConstants<M>>(s.laws).of[i] = mesh_constants<M>(law.params);
        },
        s.model.materials[i].law);
}

/// Explicit steps below the stable one that end at the times of output.
class ExplicitSteps {
 public:
  /// Until `end` [s].
  ExplicitSteps(Solver& s, double courant, double end, int threads)
      : courant_(courant), water_(water_frequency(s)), end_(end), threads_(threads) {}

  void advance(Solver& s, RunState& run, double left, const Velocity& ground) {
    if (run.since++ >= kModuliInterval) {
      refresh_moduli(s);
      choose(s, left);
      run.since = 1;
    }
    refresh_permeability(s);
    fem::advance(s, {ground.at(s.state.time), ground.at(s.state.time + s.dt)});
  }

 private:
  void choose(Solver& s, double left) {
    const double allowed = courant_ * stable_step(s, water_);
    if (!(allowed > 1e-9))
      throw NumericsError(fmt::format(
          "the stable step has fallen to {:.3g} s at {:.4f} s (soil has become extremely stiff or "
          "an element extremely small)",
          allowed, s.state.time));
    check_steps(s, end_ - s.state.time, allowed, threads_);
    const bool fits = s.dt <= allowed && s.dt >= 0.8 * allowed;
    const double steps = left / s.dt;
    if (fits && std::abs(steps - std::round(steps)) < 1e-6 * steps && steps > 0.5) return;
    s.dt = left / std::max(1.0, std::ceil(left / (0.97 * allowed)));
  }

  double courant_, water_, end_;
  int threads_;
};

/// Takes one step of the scheme that the settings name; is told the time left to the next output.
/// False where it stopped before its end because a stop was asked for: nothing has changed.
using Stepper = std::function<bool(Solver&, RunState&, double)>;

Stepper make_stepper(Solver& s, const FemConfig& config, const GroundMotion& motion, double end,
                     int threads, const Progress& progress) {
  const IntegrationConfig& c = config.integration;
  const auto ground = std::make_shared<const Velocity>(motion);
  if (c.scheme == IntegrationScheme::implicit) {
    check_steps(s, end, c.step, threads);
    const auto steps = std::make_shared<ImplicitSteps>(
        s, ImplicitSettings{c.step, c.smallest_step, c.tolerance, c.max_iterations, c.theta});
    return [=, &progress](Solver& solver, RunState& run, double left) {
      refresh_moduli(solver);
      refresh_permeability(solver);
      return steps->advance(
          solver, run.implicit, left, [&](double t) { return ground->at(t); }, progress);
    };
  }
  set_explicit_constants(s);
  const auto steps = std::make_shared<ExplicitSteps>(s, config.courant, end, threads);
  return [=](Solver& solver, RunState& run, double left) {
    steps->advance(solver, run, left, *ground);
    return true;
  };
}

/// The section at rest under gravity, ready to be shaken.
Solver make_section_at_rest(const SectionMesh& section, const FemConfig& config,
                            const Progress& progress, FemFacts& facts) {
  Solver s = make_solver(build_model(section, config), rayleigh(config.damping));
  for (double& g : s.hourglass_shear) g *= config.stabilisation.hourglass;
  progress.poll();
  solve_gravity(s, {config.gravity.permeability.value_or(kUnset), config.gravity.compacts});
  if (config.softening_length) spread_softening(s, *config.softening_length);
  progress.poll();
  facts.out_of_balance = out_of_balance(s);
  refresh_moduli(s);
  if (config.damping.largest_ratio) limit_stiffness_damping(s, *config.damping.largest_ratio);
  set_stabilisation(s, config.stabilisation);
  if (config.stabilisation.hourglass_yields) let_hourglass_yield(s);
  let_permeability_rise(s);
  if (auto note = drained_note(section, config, s)) facts.notes.push_back(std::move(*note));
  return s;
}

/// Shaking as a LongRun.
struct Shaking {
  Solver& s;
  RunState& run;
  const FemConfig& config;
  double end;  ///< [s]
  Stepper take_step;
  const StopRule& rule;
  std::filesystem::path checkpoint;
  std::string origin;              ///< fingerprint() of the run
  std::vector<std::int32_t> base;  ///< nodes
  FemFrame frame;
  ResumableHistoryWriter history;
  double seconds_before = run.seconds;
  bool stopped = false, stopped_by_rule = false;

  [[nodiscard]] bool ended() const {
    return s.state.time >= end * (1.0 - 1e-9) || stopped || stopped_by_rule;
  }
  bool step() {
    const double target = std::min(end, static_cast<double>(run.output) * config.output_interval);
    const auto reached = [&] { return target - s.state.time <= 1e-9 * config.output_interval; };
    if (!reached() && take_step(s, run, target - s.state.time)) {
      run.smallest_step = std::min(run.smallest_step, s.dt);
      run.largest_step = std::max(run.largest_step, s.dt);
    }
    if (!reached()) return false;
    s.state.time = target;
    record();
    return true;
  }
  void use_threads(int threads) { omp_set_num_threads(threads); }
  void save(double seconds) {
    history.flush();
    run.seconds = seconds_before + seconds;
    write_checkpoint(checkpoint, origin, s, run);
  }
  [[nodiscard]] Share share() const {
    return {s.state.time / end, bool(rule.ends) || config.stop_displacement};
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("{:.2f} s, step {:.3g} s", s.state.time, s.dt);
  }
  [[nodiscard]] std::string place() const {
    return fmt::format("{:.2f} s of shaking", s.state.time);
  }

  /// The rule sees the states of before again.
  void show_states_before() {
    if (!rule.ends) return;
    rule.ends(frame);
    for (std::int64_t i = 0; i + 1 < run.output; ++i)
      rule.ends(history.frame(static_cast<std::size_t>(i)));
  }

 private:
  void record() {
    fill(frame, s, frame.displacement.size(), frame.stress.size());
    history.append(frame);
    ++run.output;
    run.since = kModuliInterval;
    run.largest_displacement = largest_displacement(frame, base);
    stopped_by_rule = rule.ends && rule.ends(frame);
    stopped = config.stop_displacement && run.largest_displacement >= *config.stop_displacement;
  }
};

void summarise(const Solver& s, const RunState& run, FemFacts& facts) {
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
  facts.iterations = run.implicit.iterations;
  facts.most_iterations = run.implicit.most_iterations;
  facts.cut_steps = run.implicit.cut;
}

}  // namespace

FemFacts run_fem(const SectionMesh& section, const GroundMotion& motion, const FemConfig& config,
                 const FemPaths& paths, int threads, const Progress& progress,
                 const StopRule& rule) {
  check(motion);
  omp_set_num_threads(std::max(1, threads));
  const double end = config.end.value_or(motion.duration());
  const std::size_t nodes = section.mesh.num_nodes(), elements = section.mesh.num_elements();
  check_output(config, end, nodes, elements);
  FemFacts facts;
  Solver s = make_section_at_rest(section, config, progress, facts);
  std::vector<std::string> notes = section.notes;
  notes.insert(notes.end(), facts.notes.begin(), facts.notes.end());
  FemFrame rest;
  fill(rest, s, nodes, elements);
  Stepper step = make_stepper(s, config, motion, end, std::max(1, threads), progress);
  start_motion(s);
  s.dt = 1e-12;
  RunState run{.since = kModuliInterval, .smallest_step = end};
  const std::string origin = fingerprint(section, motion, config, rule.settings);
  if (find_checkpoint(paths.checkpoint)) {
    read_checkpoint(paths.checkpoint, origin, s, run);
    check_progress(paths.checkpoint, s, run, end, config.output_interval);
  }
  Shaking shaking{.s = s,
                  .run = run,
                  .config = config,
                  .end = end,
                  .take_step = std::move(step),
                  .rule = rule,
                  .checkpoint = paths.checkpoint,
                  .origin = origin,
                  .base = nodes_of(find_set(section, "base")),
                  .frame = rest,
                  .history = ResumableHistoryWriter(
                      paths.history, section.mesh, history_materials(section, config),
                      {"flowslide fem.run",
                       "mean of xx and yy for PM4Sand, elastic plane strain for other laws", notes},
                      rest, static_cast<std::size_t>(run.output - 1))};
  shaking.show_states_before();
  facts.seconds = shaking.seconds_before +
                  run_to_end(shaking, std::max(1, threads), paths.checkpoint, progress);
  omp_set_num_threads(std::max(1, threads));  // of whatever comes after it
  facts.stopped = shaking.stopped;
  facts.stopped_by_rule = shaking.stopped_by_rule;
  summarise(s, run, facts);
  return facts;
}

}  // namespace flowslide
