#pragma once
#include "constitutive/pm4sand_step.hpp"
#include "core/unroll.hpp"

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
/// Where a sub-step ends below the floor of mean stress, lifting corrects more than its error: its
/// tolerance is larger by this factor, and from floor to floor none is made smaller than this
/// strain. Torn soil would else take up to 1e5 sub-steps a call.
inline constexpr double kFloorTolerance = 100.0, kSmallestOnFloor = 1e-5;
/// Bounds the work of one call, whatever it is given.
inline constexpr double kMaxSubSteps = 1e5;
inline constexpr double kMostStrain = 1.0;

/// Where integration stands with a point; alpha and z of its state are those of `at`.
template <class T>
struct CourseOf {
  PointOf<T> at;
  StrainOf<T> whole;    ///< the increment
  T largest, smallest;  ///< sub-step, as shares of the increment
  T smallest_on_floor;
  T done, next;  ///< share that is done, and next sub-step
};

/// The start of an update; `size` is the largest component of the increment.
inline CourseOf<double> start(const PM4Sand::Task& task, double size) {
  const Stress<2>& sigma = *task.stress;
  const StrainIncrement<2>& de = task.increment;
  const PM4Sand::State& s = *task.state;
  const double equal = std::ceil(size / task.constants->max_strain_increment * (1.0 - 1e-9));
  const double largest = 1.0 / std::clamp(equal, 1.0, kMaxSubSteps);
  const auto smallest = [&](double strain) {
    return std::min(largest, std::max(strain / size, 1.0 / kMaxSubSteps));
  };
  return {{-0.5 * (sigma[0] + sigma[1]) - s.held_p,
           DeviatorOf<double>{-0.5 * (sigma[0] - sigma[1]), -sigma[3]} - s.held, s.alpha, s.z},
          {-(de[0] + de[1]), {-0.5 * (de[0] - de[1]), -0.5 * de[3]}},
          largest,
          smallest(kSmallestIncrement),
          smallest(kSmallestOnFloor),
          0.0,
          largest};
}

/// The stress, and what else of the state, of a point that is done.
inline void finish(const PM4Sand::Task& task, const PointOf<double>& at) {
  PM4Sand::State& state = *task.state;
  const double p = at.p + state.held_p;
  const DeviatorOf<double> s = at.s + state.held;
  *task.stress = {{-(p + s.d), -(p - s.d), -p, -s.t}};
  state.alpha = at.alpha;
  state.z = at.z;
}

/// What a sub-step, or an attempt at it, came to.
template <class Mask>
struct Outcome {
  Mask taken, floored, done;
};

template <class T>
[[gnu::flatten]] auto go_on(const SoilOf<T>& soil, StateOf<T>& s, CourseOf<T>& r) {
  const T left = 1.0 - r.done;
  const auto last = r.next >= left * (1.0 - 1e-12);
  const T part = select(last, left, r.next);
  const StrainOf<T> step{part * r.whole.volumetric, part * r.whole.deviator};
  // with room for rounding: what is left may be larger than the smallest by a few digits
  const T small = (1.0 + 1e-9) * r.smallest, small_on_floor = (1.0 + 1e-9) * r.smallest_on_floor;
  const auto spent = part <= small;
  const auto torn = r.at.p <= kOnFloor * s.p_min && part <= small_on_floor;
  Trial<T> trial = attempt(soil, s, r.at, step, spent || torn);
  const auto lifted = trial.end.p < kFloor * s.p_min;
  const T allowed = select(lifted, T(kFloorTolerance), T(1.0)) * soil.tolerance * trial.size;
  const T change =
      select(trial.error > T(0.0), clamp(0.8 * sqrt(allowed / trial.error), 0.1, 2.0), T(2.0));
  const auto taken = spent || (torn && lifted) || !(trial.error > allowed);
  settle(soil, s, trial);
  s.void_ratio = select(taken, s.void_ratio - soil.void_rate * step.volumetric, s.void_ratio);
  const DeviatorOf<T> dz = trial.end.z - r.at.z;
  const T grown2 = dot(dz, dz);
  const auto grows = taken && grown2 > T(0.0);
  if (any(grows)) {
    s.z_cum = select(grows, s.z_cum + kRootHalf * sqrt(grown2), s.z_cum);
    s.z_peak = select(grows, max(s.z_peak, kRootHalf * norm(trial.end.z)), s.z_peak);
  }
  r.at = select(taken, trial.end, r.at);
  r.done = select(taken, select(last, T(1.0), r.done + part), r.done);
  // in this order what is not a number becomes the smallest, so that every point comes to its end
  r.next = select(taken, min(max(r.smallest, part * change), r.largest),
                  max(r.smallest, part * min(change, T(0.8))));
  return Outcome<decltype(last)>{taken, taken && lifted, !(r.done < T(1.0))};
}

/// Lane `lane` of a struct of T, a struct of double: reads and writes it.
template <template <class> class Struct, class T>
[[gnu::always_inline]] inline void get_lane(Struct<double>& to, const Struct<T>& from, int lane) {
  constexpr std::size_t size = sizeof(double), n = sizeof(Struct<double>) / size;
  static_assert(sizeof from == kLanes<T> * sizeof(Struct<double>));
  unroll<n>([&](auto k) {
    std::memcpy(reinterpret_cast<char*>(&to) + size * k,
                reinterpret_cast<const char*>(&from) + size * (kLanes<T> * k + lane), size);
  });
}
template <template <class> class Struct, class T>
[[gnu::always_inline]] inline void set_lane(Struct<T>& to, int lane, const Struct<double>& from) {
  constexpr std::size_t size = sizeof(double), n = sizeof from / size;
  unroll<n>([&](auto k) {
    std::memcpy(reinterpret_cast<char*>(&to) + size * (kLanes<T> * k + lane),
                reinterpret_cast<const char*>(&from) + size * k, size);
  });
}

/// The next task that takes any work, and the size of its increment; 0 at the end of all. A point
/// that is not strained stays as it is; what is not a number is handed on, and made of a stress
/// whose square is none and of more strain than any soil has in a step.
template <class Next>
double next_task(PM4Sand::Task& task, Next&& next) {
  while (next(task)) {
    const Stress<2>& sigma = *task.stress;
    const StrainIncrement<2>& de = task.increment;
    const double size = std::max({std::abs(de[0]), std::abs(de[1]), std::abs(de[3])});
    if (!std::isfinite(sigma[0] * sigma[0] + sigma[1] * sigma[1] + sigma[3] * sigma[3] + de[0] +
                       de[1] + de[3]) ||
        size > kMostStrain)
      task.stress->v.fill(kUnset);
    else if (size != 0.0)
      return size;
  }
  return 0.0;
}

/// All that `next` names; see PM4Sand::update_all.
template <class T, class Next>
PM4Sand::Work integrate(Next&& next) {
  constexpr int lanes = kLanes<T>;
  constexpr unsigned every = (1u << lanes) - 1u;
  SoilOf<T> soil;
  StateOf<T> state;
  CourseOf<T> course;
  std::array<PM4Sand::Task, lanes> tasks;
  std::array<const PM4Sand::Constants*, lanes> soil_of{};
  PM4Sand::Work work;
  unsigned busy = 0;
  bool more = true;
  for (;;) {
    for (unsigned idle = every & ~busy; more && idle != 0; idle &= idle - 1) {
      const int lane = std::countr_zero(idle);
      const double size = next_task(tasks[lane], next);
      more = size > 0.0;
      if (!more) break;
      const CourseOf<double> fresh = start(tasks[lane], size);
      // the first one fills all lanes, so that none holds what is not a number
      for (int i = lane; i < (busy == 0 ? lanes : lane + 1); ++i) {
        set_lane(state, i, *tasks[lane].state);
        set_lane(course, i, fresh);
        if (soil_of[i] == tasks[lane].constants) continue;
        soil_of[i] = tasks[lane].constants;
        set_lane<SoilOf>(soil, i, *soil_of[i]);
      }
      busy |= 1u << lane;
    }
    if (busy == 0) return work;
    const auto outcome = go_on(soil, state, course);
    const unsigned taken = bits(outcome.taken) & busy;
    work.sub_steps += std::popcount(taken);
    work.rejected += std::popcount(busy & ~taken);
    work.floored += std::popcount(bits(outcome.floored) & busy);
    for (unsigned done = bits(outcome.done) & busy; done != 0; done &= done - 1) {
      const int lane = std::countr_zero(done);
      PointOf<double> at;
      get_lane(at, course.at, lane);
      get_lane(*tasks[lane].state, state, lane);
      finish(tasks[lane], at);
    }
    busy &= ~bits(outcome.done);
  }
}

}  // namespace flowslide::pm4sand

template <class Next>
flowslide::PM4Sand::Work flowslide::PM4Sand::update_all(Next&& next) noexcept {
  return pm4sand::integrate<Pack>(next);
}
