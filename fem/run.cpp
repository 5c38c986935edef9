#include "fem/run.hpp"

#include "fem/build_model.hpp"
#include "fem/checkpoint.hpp"
#include "fem/gravity.hpp"
#include "fem/implicit.hpp"
#include "fem/run_states.hpp"
#include "fem/time_step.hpp"
#include "model/checkpoint_file.hpp"
#include "model/resumable_history.hpp"

#include <algorithm>
#include <chrono>
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
  const double bytes = frames * (5.0 * static_cast<double>(nodes) +
                                 8.0 * static_cast<double>(elements)) * sizeof(double);
  validate(bytes <= kMostBytes,
           "output_interval = {:g} s asks for {:.3g} GB of recorded states until {:g} s (at most "
           "{:g} GB are written) raise output_interval or lower end",
           config.output_interval, bytes * 1e-9, end, kMostBytes * 1e-9);
}

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
    fem::advance(s, {ground.at(s.state.time), ground.at(s.state.time + s.dt)});
  }

 private:
  void choose(Solver& s, double left) {
    const double allowed = courant_ * stable_step({soil_frequency(s), water_}, s.damping.stiffness);
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
      return steps->advance(
          solver, run.implicit, left, [&](double t) { return ground->at(t); }, progress);
    };
  }
  const auto steps = std::make_shared<ExplicitSteps>(s, config.courant, end, threads);
  return [=](Solver& solver, RunState& run, double left) {
    steps->advance(solver, run, left, *ground);
    return true;
  };
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
  Solver s = make_solver(build_model(section, config), rayleigh(config.damping));
  for (double& g : s.hourglass_shear) g *= config.stabilisation.hourglass;
  progress.poll();
  solve_gravity(s, {config.gravity.permeability.value_or(kUnset), config.gravity.compacts});
  progress.poll();
  FemFacts facts;
  facts.out_of_balance = out_of_balance(s);
  refresh_moduli(s);
  set_stabilisation(s, config.stabilisation);
  if (config.stabilisation.hourglass_yields) let_hourglass_yield(s);

  std::vector<std::string> notes = section.notes;
  if (auto note = drained_note(section, config, s)) {
    facts.notes.push_back(*note);
    notes.push_back(std::move(*note));
  }
  FemFrame frame;
  fill(frame, s, nodes, elements);
  const Stepper step = make_stepper(s, config, motion, end, std::max(1, threads), progress);
  start_motion(s);
  s.dt = 1e-12;
  RunState run{.since = kModuliInterval, .smallest_step = end};
  const std::string origin = fingerprint(section, motion, config, rule.settings);
  if (find_checkpoint(paths.checkpoint)) {
    read_checkpoint(paths.checkpoint, origin, s, run);
    check_progress(paths.checkpoint, s, run, end, config.output_interval);
  }
  ResumableHistoryWriter history(
      paths.history, section.mesh, history_materials(section, config),
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
      if (step(s, run, target - s.state.time)) {
        run.smallest_step = std::min(run.smallest_step, s.dt);
        run.largest_step = std::max(run.largest_step, s.dt);
      }
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
  remove_checkpoint(paths.checkpoint);
  history.remove_parts();
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
  facts.iterations = run.implicit.iterations;
  facts.most_iterations = run.implicit.most_iterations;
  facts.cut_steps = run.implicit.cut;
  return facts;
}

}  // namespace flowslide
