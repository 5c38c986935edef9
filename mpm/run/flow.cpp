#include "mpm/run/flow.hpp"

#include "model/long_run.hpp"
#include "mpm/run/extrude.hpp"
#include "mpm/run/load.hpp"
#include "mpm/run/rest_forecast.hpp"
#include "mpm/solver/balance.hpp"
#include "mpm/solver/checkpoint.hpp"

#include <algorithm>
#include <numeric>

namespace flowslide {
namespace {

/// A step that shrank this much means that the state has gone wrong, not that the flow is fast; so
/// do many steps in a row that shrank by less.
constexpr double kDtCollapse = 1e-5, kDtShort = 1e-2;
constexpr std::int64_t kMostShort = 20'000;
constexpr double kEnergyNoise = 0.01;  ///< cells that the soil may sink before energy is watched
/// Steps, and bytes of stored states, above which a run is not begun.
constexpr double kMostSteps = 1e8, kMostBytes = 1e12;
constexpr double kFrameBytesPerPoint = 15 * sizeof(double);
constexpr double kUpdatesPerSecond = 5e6;  ///< of a thread, for predictions of cost

/// The history keeps particles in order of id; the solver's `index` refers to that order.
template <int Dim>
void index_by_id(mpm::Simulation<Dim>& s, const ParticleSet& particles) {
  std::vector<std::int32_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return particles.id[a] < particles.id[b]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    s.points.index[order[rank]] = static_cast<std::int32_t>(rank);
}

bool at_rest(const mpm::RunState& run, const MpmSample& now, const RestRule& rest) {
  if (now.time < rest.window || run.recent.empty()) return false;
  const auto [low, high] =
      std::minmax_element(run.recent.begin(), run.recent.end(),
                          [](const auto& a, const auto& b) { return a[1] < b[1]; });
  return now.kinetic <= rest.kinetic_share * run.peak_kinetic &&
         (*high)[1] - (*low)[1] < rest.runout_change;
}

template <int Dim>
void check_step(const mpm::Simulation<Dim>& s, mpm::RunState& run) {
  const double first = run.first_dt;
  const bool finite =
      std::isfinite(s.last.max_speed2) && std::isfinite(s.last.max_strain) && std::isfinite(s.dt);
  run.short_steps = s.dt > kDtShort * first ? 0 : run.short_steps + 1;
  if (finite && s.dt > kDtCollapse * first && run.short_steps < kMostShort) return;
  throw NumericsError(fmt::format(
      "step {}, t = {:.4f} s: {} (fastest point {:.3g} m/s, step {:.3g} s against {:.3g} s at the "
      "start; the state has become unphysical) check strengths and stiffness of the materials, or "
      "try a smaller courant",
      s.step, s.time, finite ? "the time step has collapsed" : "velocities are no longer finite",
      std::sqrt(s.last.max_speed2), s.dt, first));
}

/// Brings the next frame forward to now if the fastest point has gone too far since the last one.
void hurry_frame(mpm::RunState& run, const MpmSample& now, const FlowConfig& config) {
  const double since = now.time - (run.next_frame - config.frame_interval);
  if (config.frame_travel && now.max_speed * since >= *config.frame_travel)
    run.next_frame = now.time;
}

/// Refuses a run that would not end in any useful time, or fill any disk.
template <int Dim>
void check_cost(const mpm::Simulation<Dim>& s, const std::vector<MaterialSpec>& materials,
                const FlowConfig& config, double dt, int threads) {
  const auto points = static_cast<double>(s.points.size());
  const double interval = config.frame_travel
                              ? std::min(config.frame_interval, config.sample_interval)
                              : config.frame_interval;
  const double bytes = points * kFrameBytesPerPoint * config.end / interval;
  validate(bytes <= kMostBytes,
           "frame_interval = {:g} s asks for {:.3g} GB of stored states of {} points until {:g} s "
           "(at most {:g} GB are written) raise frame_interval or lower end",
           config.frame_interval, bytes * 1e-9, s.points.size(), config.end, kMostBytes * 1e-9);
  const double steps = config.end / dt;
  if (steps <= kMostSteps || std::isinf(steps)) return;  // a step of 0 ends the run at once
  std::size_t fastest = 0;
  double wave2 = 0.0;
  for (std::size_t q = 0; q < s.points.size(); ++q) {
    const auto m = static_cast<std::size_t>(s.points.material[q]);
    const double own = s.materials[m].wave_modulus * s.points.volume[q] / s.points.mass[q];
    if (own > wave2) fastest = m, wave2 = own;
  }
  throw InputError(fmt::format(
      "the run would take {:.2g} steps of {:.2g} s until {:g} s, about {:.2g} days (waves in "
      "'{}' travel at {:.3g} m/s through cells of {:g} m; at most {:g} steps are begun) check end, "
      "cell, and stiffness and density of that material, courant, velocity_limit and the speeds at "
      "the start",
      steps, dt, config.end, steps * points / (kUpdatesPerSecond * threads) / 86400.0,
      materials[fastest].name, std::sqrt(wave2), config.cell, kMostSteps));
}

/// What the run remembers of its start.
template <int Dim>
void note_start(const mpm::Simulation<Dim>& s, const FlowConfig& config, mpm::RunState& run) {
  const mpm::PointSums<Dim> start = mpm::sum_points(s);
  run.mass_start = start.mass;
  run.kinetic_start = start.kinetic;
  run.potential_start = start.potential;
  run.recoverable_start = start.recoverable;
  // The balance of the first steps is wrong by as much as they do.
  const double noise = kEnergyNoise * start.mass * config.gravity * config.cell;
  run.energy.begin(start.kinetic, start.recoverable, noise);
  std::copy(start.momentum.begin(), start.momentum.end(), run.momentum_start.begin());
  run.first_dt = mpm::stable_step(s);
}

template <int Dim>
mpm::Reference<Dim> reference_of(const mpm::RunState& run, double toe) {
  mpm::Reference<Dim> r{
      {run.mass_start, run.kinetic_start, run.potential_start, run.recoverable_start, {}, true, -1},
      toe};
  std::copy_n(run.momentum_start.begin(), Dim, r.start.momentum.begin());
  return r;
}

/// A runout as a LongRun.
template <int Dim>
struct Runout {
  mpm::Simulation<Dim>& s;
  mpm::StepScratch<Dim>& scratch;
  mpm::RunState& run;
  const FlowConfig& config;
  std::filesystem::path checkpoint;
  mpm::Reference<Dim> reference;
  std::vector<bool> counts;  ///< per material: its points count for the front
  bool elastic;              ///< all materials are
  MpmHistoryWriter history;
  MpmFrame frame{};
  std::vector<Place> front_scratch{};
  MpmSample last{.time = s.time};
  bool over = false, rests = false;
  RestForecast forecast{};

  [[nodiscard]] bool ended() const { return over; }
  bool step() {
    mpm::advance(s, scratch);
    check_step(s, run);
    run.updates += std::ssize(s.points.mass) - s.sleep.count;
    over = s.time >= config.end || s.points.size() == 0;
    if (s.time >= run.next_sample || over) sample();
    const bool due = s.time >= run.next_frame || over;
    if (due) store();
    return due;
  }
  void use_threads(int threads) { mpm::use_threads(s, scratch, threads); }
  void save(double) {
    history.flush();
    mpm::write_checkpoint(checkpoint, s, run);
  }
  void store() {
    mpm::store_frame(s, frame);
    history.append(frame);
    ++run.frames;
    pass_output(run.next_frame, s.time, config.frame_interval);
  }
  /// Until rest, as soon as it can be foreseen.
  [[nodiscard]] Share share() const {
    const auto rest = forecast.rest(run.peak_kinetic, config.rest.kinetic_share);
    if (!rest) return {s.time / config.end, true};
    return s.time / std::min(config.end, std::max(*rest, s.time) + config.rest.window);
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("t {:.1f} s, runout {:.1f} m, fastest {:.2f} m/s", s.time, last.runout,
                       std::sqrt(s.last.max_speed2));
  }
  [[nodiscard]] std::string place() const { return fmt::format("t = {:.2f} s", s.time); }

 private:
  void sample() {
    if (mpm::any_beyond(s.outlet, s.points)) mpm::prepare(s, scratch, true);
    last = mpm::sample(s, reference, counts, front_scratch);
    run.energy.look(last, elastic);
    history.append(last);
    ++run.samples;
    pass_output(run.next_sample, s.time, config.sample_interval);
    hurry_frame(run, last, config);
    run.peak_kinetic = std::max(run.peak_kinetic, last.kinetic);
    forecast.look(s.time, last.kinetic);
    run.recent.push_back({s.time, last.front});
    std::erase_if(run.recent, [&](const auto& r) { return r[0] < s.time - config.rest.window; });
    rests = at_rest(run, last, config.rest);
    over = over || rests || s.points.size() == 0;
  }
};

template <int Dim>
FlowFacts run_in(const ParticleSet& particles, const FlowConfig& config, const FlowPaths& paths,
                 int threads, const Progress& progress) {
  mpm::Simulation<Dim> s = mpm::make_simulation<Dim>(particles, config);
  index_by_id(s, particles);
  mpm::StepScratch<Dim> scratch(std::max(1, threads));
  mpm::RunState run;
  const bool resume = find_checkpoint(paths.checkpoint);
  if (resume) mpm::read_checkpoint(paths.checkpoint, s, run);
  mpm::prepare(s, scratch, !resume);
  if (resume) {
    mpm::check_walls(paths.checkpoint, s);
  } else {
    note_start(s, config, run);
    check_cost(s, particles.materials, config, run.first_dt, std::max(1, threads));
  }
  const auto& materials = particles.materials;
  std::vector<bool> counts;
  for (const MaterialSpec& m : materials) counts.push_back(m.counts_for_runout);
  Runout<Dim> runout{
      .s = s,
      .scratch = scratch,
      .run = run,
      .config = config,
      .checkpoint = paths.checkpoint,
      .reference = reference_of<Dim>(run, particles.toe),
      .counts = counts,
      .elastic = std::all_of(materials.begin(), materials.end(),
                             [](const auto& m) { return m.law == LinearElastic::name; }),
      .history = MpmHistoryWriter(paths.history, particles, config.rest, run.frames, run.samples)};
  if (!resume) runout.store();
  const std::int64_t first_updates = run.updates;
  FlowFacts facts;
  facts.step_seconds = run_to_end(runout, std::max(1, threads), paths.checkpoint, progress);
  facts.last = runout.last;
  facts.at_rest = runout.rests;
  facts.end_time = s.time;
  facts.steps = s.step;
  facts.point_updates = static_cast<double>(run.updates);
  facts.absorbed = s.balance.grid.absorbed;
  facts.updates_this_call = static_cast<double>(run.updates - first_updates);
  return facts;
}

}  // namespace

FlowFacts run_flow(const ParticleSet& particles, const FlowConfig& config, const FlowPaths& paths,
                   int threads, const Progress& progress) {
  validate(is_set(particles.toe),
           "the points do not say from where the runout counts (no soil among them counts for it) "
           "let a material count, or give them a toe");
  if (config.stiffness == Stiffness::automatic) {
    ParticleSet softened = particles;
    StiffnessChoice choice = soften(softened, config);
    FlowConfig as_is = config;
    as_is.stiffness = Stiffness::given;
    FlowFacts facts = run_flow(softened, as_is, paths, threads, progress);
    facts.stiffness = std::move(choice);
    return facts;
  }
  if (!config.extrude) return run_in<2>(particles, config, paths, threads, progress);
  FlowConfig valley = config;
  if (config.extrude->sides != Sides::open) valley.side_rollers = {0.0, config.extrude->width};
  return run_in<3>(extrude(particles, config.extrude->width), valley, paths, threads, progress);
}

}  // namespace flowslide
