#pragma once
#include "constitutive/pm4sand_flow.hpp"

/// One sub-step of PM4Sand: elastic part in closed form, then modified Euler, and its error.
/// docs/theory/pm4sand.md, "Integration". T as in pm4sand_flow.hpp.
namespace flowslide::pm4sand {

template <class T>
struct Rates {
  T p = 0.0;
  DeviatorOf<T> s, alpha, z;
};

template <class T>
Rates<T> elastic_rates(const Moduli<T>& e, const StrainOf<T>& step) {
  return {(e.K + e.G / 3.0) * step.volumetric, 2.0 * e.G * step.deviator, {}, {}};
}

template <class T>
struct Local {
  T p;  ///< not below p_min
  Surfaces<T> surfaces;
  Moduli<T> moduli;
};

template <class T>
Local<T> local(const SoilOf<T>& c, const StateOf<T>& s, T Dr, const PointOf<T>& at) {
  const T p = max(at.p, s.p_min);
  const Surfaces<T> f = surfaces(c, p, Dr);
  return {p, f, moduli(c, s, f, at.p, at.s)};
}

/// Increments over `step` with the flow rule at `at`, eqs (25) to (28).
template <class T>
Rates<T> rates(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Local<T>& l,
               const PointOf<T>& at, const StrainOf<T>& step) {
  const Moduli<T>& e = l.moduli;
  Rates<T> r = elastic_rates(e, step);
  const Flow<T> w = flow(c, s, h, l.surfaces, e, l.p, at);
  const T n_r = dot(w.n, at.s) / at.p;
  const T driving = 2.0 * e.G * dot(w.n, step.deviator) - n_r * e.K * step.volumetric;
  const T elastic = 2.0 * e.G - e.K * w.D * n_r;
  T L = driving / (w.Kp + elastic);
  const auto plastic = L > T(0.0);
  // Near the bounding surface the pull on the back-stress ratio is too stiff for explicit steps.
  // Along n it ends at the image; across n it may turn the loading direction, which changes by
  // d alpha/(m/sqrt(2)), no farther than onto alpha.
  const T along = min(L * w.pull, T(1.0));
  const T across = min(L * w.pull, kRootHalf * c.m / max(norm(at.alpha), c.m));
  L = select(along >= T(1.0) && w.Kp > T(0.0), max(L, (driving - w.Kp / w.pull) / elastic), L);
  const auto grows = plastic && w.beyond_dilatancy && w.D < T(0.0);
  r.p = select(plastic, r.p - L * e.K * w.D, r.p);
  r.s = select(plastic, r.s - (2.0 * e.G * L) * w.n, r.s);
  r.alpha = select(plastic, (along * w.b_n) * w.n + across * w.b_side, r.alpha);
  r.z = select(grows, (-h.fabric_rate * L) * (s.z_max * w.n + at.z), r.z);
  return r;
}

template <class T>
PointOf<T> moved(const PointOf<T>& a, const Rates<T>& r) {
  return {a.p + r.p, a.s + r.s, a.alpha + r.alpha, a.z + r.z};
}
template <class Mask, class T>
PointOf<T> select(const Mask& c, const PointOf<T>& a, const PointOf<T>& b) {
  return {select(c, a.p, b.p), select(c, a.s, b.s), select(c, a.alpha, b.alpha),
          select(c, a.z, b.z)};
}

/// The part of an elastic step after which the stress leaves the yield surface |s - p alpha| =
/// m p/sqrt(2) for good: the larger root of a quadratic, 1 where the step stays inside.
template <class T>
T elastic_part(T m, const PointOf<T>& from, const Rates<T>& step) {
  const DeviatorOf<T> a = from.s - from.p * from.alpha;
  const DeviatorOf<T> b = step.s - step.p * from.alpha;
  const T k2 = 0.5 * m * m;
  const DeviatorOf<T> end = a + b;
  const T p_end = from.p + step.p;
  const auto inside = p_end > T(0.0) && dot(end, end) <= k2 * p_end * p_end;
  const T A = dot(b, b) - k2 * step.p * step.p;
  const T B = dot(a, b) - k2 * from.p * step.p;
  const T C = dot(a, a) - k2 * from.p * from.p;
  const T root2 = B * B - A * C;
  const auto leaves = root2 > T(0.0) && A > T(0.0);
  const T part = select(leaves, clamp((-B + sqrt(root2)) / A, 0.0, 1.0), T(0.0));
  return select(inside, T(1.0), part);
}

/// A reversal of loading where `turns`: the present back-stress ratio becomes the initial one,
/// limited by the earlier branches where the shear stress has not changed its sign.
template <class Mask, class T>
void reverse(StateOf<T>& state, const Mask& turns, T p, const DeviatorOf<T>& n) {
  StateOf<T> s = state;
  s.alpha_in_p = s.alpha_in;
  s.alpha_true = s.alpha;
  s.z_in = s.z;
  p = max(p, s.p_min);
  const T zp = norm(s.z) * p;
  const auto higher = (zp > s.z_xp && p > s.p_zp) || s.reversed <= T(0.0);
  s.z_xp = select(higher, zp, s.z_xp);
  s.p_zp = select(higher, p, s.p_zp);
  s.reversed = select(higher, T(1.0), s.reversed);
  const auto track = [](T in, T alpha, T& lowest, T& highest) {
    const auto above = in > T(0.0);
    lowest = select(above, min(lowest, alpha), lowest);
    highest = select(above, highest, max(highest, alpha));
  };
  track(s.alpha_in.d, s.alpha.d, s.alpha_min.d, s.alpha_max.d);
  track(s.alpha_in.t, s.alpha.t, s.alpha_min.t, s.alpha_max.t);
  const auto apparent = [](T n_i, T lowest, T highest) {
    return select(n_i > T(0.0), max(T(0.0), lowest), min(T(0.0), highest));
  };
  const DeviatorOf<T> limited{apparent(n.d, s.alpha_min.d, s.alpha_max.d),
                              apparent(n.t, s.alpha_min.t, s.alpha_max.t)};
  s.alpha_in = select(s.alpha.t * s.alpha_in_p.t > T(0.0), limited, s.alpha);

  state.alpha_in = select(turns, s.alpha_in, state.alpha_in);
  state.alpha_in_p = select(turns, s.alpha_in_p, state.alpha_in_p);
  state.alpha_true = select(turns, s.alpha_true, state.alpha_true);
  state.alpha_max = select(turns, s.alpha_max, state.alpha_max);
  state.alpha_min = select(turns, s.alpha_min, state.alpha_min);
  state.z_in = select(turns, s.z_in, state.z_in);
  state.z_xp = select(turns, s.z_xp, state.z_xp);
  state.p_zp = select(turns, s.p_zp, state.p_zp);
  state.reversed = select(turns, s.reversed, state.reversed);
}

template <class T>
T stress_norm(const PointOf<T>& x) {
  return sqrt(2.0 * x.p * x.p + dot(x.s, x.s));
}

/// What a sub-step would lead to.
template <class T>
struct Trial {
  PointOf<T> end;
  T error;  ///< of the stress, relative
  T Mb;     ///< bounding ratio at the end
};

/// The sub-step `step` from `at`; a reversal of loading goes into `s`. `forced`: this step is taken
/// whatever the error, so that a mean stress that would become tensile ends at the floor.
template <class Mask, class T>
Trial<T> attempt(const SoilOf<T>& c, StateOf<T>& s, const PointOf<T>& at, const StrainOf<T>& step,
                 const Mask& forced) {
  const T Dr = relative_density(c, s.void_ratio);
  const Local<T> start = local(c, s, Dr, at);
  const Rates<T> elastic = elastic_rates(start.moduli, step);
  const DeviatorOf<T> n = (at.s + elastic.s) - (at.p + elastic.p) * at.alpha;
  const auto turns = dot(s.alpha - s.alpha_true, n) < T(0.0);
  if (any(turns)) reverse(s, turns, at.p, n);

  const T a = elastic_part(c.m, at, elastic);
  PointOf<T> from = at;
  from.p += a * elastic.p;
  from.s = from.s + a * elastic.s;
  // G follows sqrt(p): what an elastic step with the modulus of its start misses
  const T size = 2.0 * max(stress_norm(at), s.p_min);
  const T elastic_error = a * abs(elastic.p) / (2.0 * max(at.p, s.p_min)) * a *
                          sqrt(2.0 * elastic.p * elastic.p + dot(elastic.s, elastic.s)) / size;
  const auto stays = a >= T(1.0);
  Trial<T> r{from, select(from.p > T(0.0) || forced, elastic_error, T(1.0)), start.surfaces.Mb};
  if (all(stays)) return r;

  const StrainOf<T> rest{(1.0 - a) * step.volumetric, (1.0 - a) * step.deviator};
  const History<T> h = history(c, s);
  const Rates<T> r1 =
      rates(c, s, h, any(a > T(0.0)) ? local(c, s, Dr, from) : start, from, rest);
  const PointOf<T> middle = moved(from, r1);
  const Local<T> at_middle = local(c, s, Dr, middle);
  const Rates<T> r2 = rates(c, s, h, at_middle, middle, rest);
  const PointOf<T> end{from.p + 0.5 * (r1.p + r2.p), from.s + 0.5 * (r1.s + r2.s),
                       from.alpha + 0.5 * (r1.alpha + r2.alpha), from.z + 0.5 * (r1.z + r2.z)};
  const DeviatorOf<T> ds = r2.s - r1.s;
  const T dp = r2.p - r1.p;
  const T error = elastic_error + sqrt(2.0 * dp * dp + dot(ds, ds)) / size;

  // Mean stress would become tensile: a smaller step, or, where that is spent, the floor.
  const auto holds = middle.p > T(0.0) && end.p > T(0.0);
  PointOf<T> collapsed = from;
  collapsed.p = select(forced, T(0.0), from.p);
  r.end = select(stays, from, select(holds, end, collapsed));
  r.error = select(stays, r.error, select(holds, error, T(1.0)));
  r.Mb = select(!stays && holds, at_middle.surfaces.Mb, r.Mb);
  return r;
}

/// Ends a sub-step: the floor of mean stress, the stress on the yield surface and within the
/// bounding surface. Returns where the floor was met.
template <class T>
auto settle(const SoilOf<T>& c, const StateOf<T>& s, Trial<T>& trial) {
  PointOf<T>& end = trial.end;
  const auto low = end.p < 0.2 * s.p_min;
  end.p = select(low, 0.2 * s.p_min, end.p);
  // drift: the back-stress ratio is moved so that the stress lies on the yield surface
  const DeviatorOf<T> offset = end.s - end.p * end.alpha;
  const T radius = kRootHalf * c.m * end.p, length = norm(offset);
  end.alpha = select(length > radius, (1.0 / end.p) * (end.s - (radius / length) * offset),
                     end.alpha);
  const T M_cur = kRoot2 * norm(end.s) / max(end.p, s.p_min);
  const auto beyond = M_cur > trial.Mb;
  end.s = select(beyond, (trial.Mb / M_cur) * end.s, end.s);
  end.alpha = select(beyond, ((trial.Mb - c.m) / (trial.Mb * end.p)) * end.s, end.alpha);
  return low;
}

}  // namespace flowslide::pm4sand
