#pragma once
#include "constitutive/pm4sand_step.hpp"

#include <bit>
#include <cmath>
#include <cstring>

/// Integration of PM4Sand with error control in sub-steps of bounded strain, of as many points at a
/// time as a T has lanes. Each lane is at its own sub-step of its own point, and a point that is
/// done makes room for the next one. Lanes know nothing of each other, so that a point's result has
/// the same bits in whatever company. docs/theory/pm4sand.md, "Integration".
namespace flowslide::pm4sand {

/// Sub-steps are not made smaller than this strain; there the error is accepted.
inline constexpr double kSmallestIncrement = 1e-9;
/// Bounds the work of one call, whatever it is given.
inline constexpr double kMaxSubSteps = 1e6;

/// What integration knows of a point.
template <class T>
struct CourseOf {
  SoilOf<T> soil;
  StateOf<T> state;
  PointOf<T> at;
  StrainOf<T> whole;                        ///< the increment
  T largest, smallest;                      ///< sub-step, as shares of the increment
  T done, next;                             ///< share that is done, and next sub-step
  T sub_steps = 0.0, rejected = 0.0, floored = 0.0;
};

/// The start of an update; `size` is the largest component of the increment.
inline CourseOf<double> start(const PM4Sand::Task& task, double size) {
  const Stress<2>& sigma = *task.stress;
  const StrainIncrement<2>& de = task.increment;
  const PM4Sand::State& s = *task.state;
  CourseOf<double> r;
  r.soil = *task.constants;
  r.state = s;
  r.at = {-0.5 * (sigma[0] + sigma[1]) - s.held_p,
          DeviatorOf<double>{-0.5 * (sigma[0] - sigma[1]), -sigma[3]} - s.held, s.alpha, s.z};
  r.whole = {-(de[0] + de[1]), {-0.5 * (de[0] - de[1]), -0.5 * de[3]}};
  const double equal = std::ceil(size / r.soil.max_strain_increment * (1.0 - 1e-9));
  r.largest = 1.0 / std::clamp(equal, 1.0, kMaxSubSteps);
  r.smallest = std::min(r.largest, std::max(kSmallestIncrement / size, 1.0 / kMaxSubSteps));
  r.done = 0.0;
  r.next = r.largest;
  return r;
}

/// Writes what `start` began.
inline void finish(const PM4Sand::Task& task, const CourseOf<double>& r) {
  const double p = r.at.p + r.state.held_p;
  const DeviatorOf<double> s = r.at.s + r.state.held;
  *task.stress = {{-(p + s.d), -(p - s.d), -p, -s.t}};
  *task.state = r.state;
  task.work->sub_steps += static_cast<int>(r.sub_steps);
  task.work->rejected += static_cast<int>(r.rejected);
  task.work->floored += static_cast<int>(r.floored);
}

/// One sub-step, or an attempt at it.
template <class T>
void go_on(CourseOf<T>& r) {
  const T left = 1.0 - r.done;
  const auto last = r.next >= left * (1.0 - 1e-12);
  const T part = select(last, left, r.next);
  const StrainOf<T> step{part * r.whole.volumetric, part * r.whole.deviator};
  Trial<T> trial = attempt(r.soil, r.state, r.at, step, part <= r.smallest);
  const T tolerance = r.soil.tolerance;
  const T change = select(trial.error > T(0.0),
                          clamp(0.8 * sqrt(tolerance / trial.error), 0.1, 2.0), T(2.0));
  const auto taken = !(trial.error > tolerance && part > r.smallest);
  const auto low = settle(r.soil, r.state, trial);
  StateOf<T>& s = r.state;
  const auto take = [&taken](T& to, const T& value) { to = select(taken, value, to); };
  take(s.void_ratio, s.void_ratio - (1.0 + r.soil.initial_void_ratio) * step.volumetric);
  take(s.z_cum, s.z_cum + kRootHalf * norm(trial.end.z - r.at.z));
  take(s.z_peak, max(s.z_peak, kRootHalf * norm(trial.end.z)));
  r.at = select(taken, trial.end, r.at);
  s.alpha = r.at.alpha;
  s.z = r.at.z;
  r.done = select(taken, select(last, T(1.0), r.done + part), r.done);
  r.next = select(taken, clamp(part * change, r.smallest, r.largest),
                  max(part * min(change, T(0.8)), r.smallest));
  r.sub_steps += select(taken, T(1.0), T(0.0));
  r.rejected += select(taken, T(0.0), T(1.0));
  r.floored += select(taken && low, T(1.0), T(0.0));
}

/// Numbers of lane `lane` of a struct of T, as the same struct of double.
template <template <class> class Struct, class T>
Struct<double> lane_of(const Struct<T>& from, int lane) {
  constexpr std::size_t n = sizeof(Struct<double>) / sizeof(double), lanes = kLanes<T>;
  static_assert(sizeof from == sizeof(double) * lanes * n);
  Struct<double> r;
  for (std::size_t k = 0; k < n; ++k)
    std::memcpy(reinterpret_cast<char*>(&r) + sizeof(double) * k,
                reinterpret_cast<const char*>(&from) + sizeof(double) * (lanes * k + lane),
                sizeof(double));
  return r;
}
template <template <class> class Struct, class T>
void set_lane(Struct<T>& to, int lane, const Struct<double>& from) {
  constexpr std::size_t n = sizeof from / sizeof(double), lanes = kLanes<T>;
  for (std::size_t k = 0; k < n; ++k)
    std::memcpy(reinterpret_cast<char*>(&to) + sizeof(double) * (lanes * k + lane),
                reinterpret_cast<const char*>(&from) + sizeof(double) * k, sizeof(double));
}

/// The next task that takes any work, started; false at the end of all. A point that is not
/// strained stays as it is, and what is not a number is handed on.
template <class Next>
bool next_course(PM4Sand::Task& task, CourseOf<double>& r, Next&& next) {
  while (next(task)) {
    const StrainIncrement<2>& de = task.increment;
    const double size = std::max({std::abs(de[0]), std::abs(de[1]), std::abs(de[3])});
    r = start(task, size);
    if (!std::isfinite(r.at.p + r.at.s.d + r.at.s.t + de[0] + de[1] + de[3]))
      task.stress->v.fill(kUnset);
    else if (size != 0.0)
      return true;
  }
  return false;
}

/// All that `next` names; see PM4Sand::update_all.
template <class T, class Next>
void integrate(Next&& next) {
  constexpr int lanes = kLanes<T>;
  constexpr unsigned all_lanes = (1u << lanes) - 1u;
  CourseOf<T> course;
  std::array<PM4Sand::Task, lanes> tasks;
  unsigned busy = 0;
  bool more = true;
  while (more || busy != 0) {
    for (unsigned idle = all_lanes & ~busy; more && idle != 0; idle &= idle - 1) {
      const int lane = std::countr_zero(idle);
      CourseOf<double> fresh;
      more = next_course(tasks[lane], fresh, next);
      if (!more) break;
      // the first one fills all lanes, so that none holds what is not a number
      for (int i = lane; i < (busy == 0 ? lanes : lane + 1); ++i) set_lane(course, i, fresh);
      busy |= 1u << lane;
    }
    if (busy == 0) return;
    go_on(course);
    for (unsigned done = bits(course.done >= T(1.0)) & busy; done != 0; done &= done - 1) {
      const int lane = std::countr_zero(done);
      finish(tasks[lane], lane_of(course, lane));
      busy &= ~(1u << lane);
    }
  }
}

}  // namespace flowslide::pm4sand
