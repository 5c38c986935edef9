#pragma once
#include "constitutive/pm4sand_flow.hpp"

/// One sub-step of PM4Sand: elastic part in closed form, then modified Euler, and its error.
/// docs/theory/pm4sand.md, "Integration". T as in pm4sand_flow.hpp.
namespace flowslide::pm4sand {

/// The floor of mean stress over p_min.
inline constexpr double kFloor = 0.2;
inline constexpr double kOnFloor = kFloor * (1.0 + 1e-9);

template <class T>
struct Rates {
  T p = 0.0;
  DeviatorOf<T> s, alpha, z;
};

template <class T>
Rates<T> elastic_rates(const SoilOf<T>& c, T G, const StrainOf<T>& step) {
  return {c.pressure_ratio * G * step.volumetric, 2.0 * G * step.deviator, {}, {}};
}

/// What alpha has to follow so that a long step does not turn the loading direction too far. It
/// turns towards the strain at the rate 2 G/(m p/sqrt(2)), which no explicit step can follow where
/// p is far below p_min and G is not: this is the linearly implicit step, and no more than what
/// turning moves alpha, m/sqrt(2). `inverse` is 1/p.
template <class T>
DeviatorOf<T> held_direction(const SoilOf<T>& c, const PointOf<T>& at, T inverse, T G,
                             const DeviatorOf<T>& n, const StrainOf<T>& step, const Rates<T>& r) {
  const T turns = positive(2.0 * G * dot(n, step.deviator)) / (kRootHalf * c.m * at.p);
  const DeviatorOf<T> moves = r.s - at.p * r.alpha - r.p * at.alpha;
  return (turns / (1.0 + turns) * inverse) * (moves - dot(moves, n) * n);
}

/// Increments over `step` with the flow rule at `at`, eqs (25) to (28).
template <class T>
Rates<T> rates(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Local<T>& l,
               const PointOf<T>& at, const StrainOf<T>& step) {
  const T G = l.G, K = c.bulk_ratio * G;
  Rates<T> r = elastic_rates(c, G, step);
  const T inverse = 1.0 / at.p;
  const T inverse_p = select(at.p > s.p_min, inverse, h.inverse_p_min);
  const Flow<T> w = flow(c, s, h, l, inverse_p, at);
  const T n_r = dot(w.n, at.s) * inverse;
  const T driving = 2.0 * G * dot(w.n, step.deviator) - n_r * K * step.volumetric;
  // Beyond the undrained peak the band takes the plastic strain of the element.
  const T loss = K * w.D * n_r;
  const auto softens = w.Kp < loss;
  T share = 1.0;
  if (any(softens)) share = select(softens, max(s.band, min(T(1.0), (loss - w.Kp) / G)), T(1.0));
  const T elastic = 2.0 * G * share - loss;
  T L = driving / (w.Kp + elastic);
  // Near the bounding surface the pull on the back-stress ratio is too stiff for explicit steps.
  // Along n it ends at the image; across n it may turn the loading direction, which changes by
  // d alpha/(m/sqrt(2)), no farther than onto alpha. Beyond that surface it may soften faster than
  // stress unloads: then it is at the image at once.
  const auto snaps =
      w.Kp < T(0.0) && w.Kp + elastic <= T(0.0) && elastic > T(0.0) && driving > T(0.0);
  const auto torn = at.p > kOnFloor * s.p_min && at.p < s.p_min;
  const T pressure = select(torn, at.p, l.p);
  const T pulled = select(snaps, T(1.0), L * (w.rate * select(torn, inverse, inverse_p)));
  const T along = min(pulled, T(1.0));
  T across = pulled;
  const T farthest = kRootHalf * c.m, alpha2 = dot(at.alpha, at.alpha), m2 = c.m * c.m;
  const auto far = pulled > T(0.0) && pulled * pulled * max(alpha2, m2) > farthest * farthest;
  if (any(far)) across = select(far, farthest / sqrt(max(alpha2, m2)), pulled);
  const auto at_image = snaps || (along >= T(1.0) && w.Kp > T(0.0));
  if (any(at_image)) L = select(at_image, max(L, (driving - w.b_n * pressure) / elastic), L);
  const auto plastic = L > T(0.0);
  r.p = select(plastic, r.p - L * K * w.D, r.p);
  r.s = select(plastic, r.s - (2.0 * G * share * L) * w.n, r.s);
  r.alpha = select(plastic, (along * w.b_n) * w.n + across * w.b_side, r.alpha);
  if (any(torn && plastic))
    r.alpha =
        select(torn && plastic, r.alpha + held_direction(c, at, inverse, G, w.n, step, r), r.alpha);
  const auto grows = plastic && w.beyond_dilatancy && w.D < T(0.0);
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

/// A stress on the yield surface lies within it by rounding: below this an elastic part is none.
inline constexpr double kRounding = 1e-8;

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
  const T root = select(leaves, (-B + sqrt(root2)) / A, T(0.0));
  const T part = select(root > T(kRounding), min(root, T(1.0)), T(0.0));
  return select(inside, T(1.0), part);
}

/// A reversal of loading where `turns`: the present back-stress ratio becomes the initial one,
/// limited by the earlier branches where the shear stress has not changed its sign.
template <class Mask, class T>
void reverse(const SoilOf<T>& c, StateOf<T>& state, const Mask& turns, const PointOf<T>& at,
             const DeviatorOf<T>& n) {
  StateOf<T> s = state;
  s.alpha_in_p = select(c.opensees_reversals > T(0.0), s.alpha_in, s.alpha_true);
  s.alpha_true = at.alpha;
  s.z_in = at.z;
  const T p = max(at.p, s.p_min), zp = norm(at.z) * p;
  const auto higher = (zp > s.z_xp && p > s.p_zp) || s.reversed <= T(0.0);
  s.z_xp = select(higher, zp, s.z_xp);
  s.p_zp = select(higher, p, s.p_zp);
  s.reversed = select(higher, T(1.0), s.reversed);
  const auto track = [](T in, T alpha, T& lowest, T& highest) {
    const auto above = in > T(0.0);
    lowest = select(above, min(lowest, alpha), lowest);
    highest = select(above, highest, max(highest, alpha));
  };
  track(s.alpha_in.d, at.alpha.d, s.alpha_min.d, s.alpha_max.d);
  track(s.alpha_in.t, at.alpha.t, s.alpha_min.t, s.alpha_max.t);
  const auto apparent = [](T n_i, T lowest, T highest) {
    return select(n_i > T(0.0), max(T(0.0), lowest), min(T(0.0), highest));
  };
  const DeviatorOf<T> limited{apparent(n.d, s.alpha_min.d, s.alpha_max.d),
                              apparent(n.t, s.alpha_min.t, s.alpha_max.t)};
  s.alpha_in = select(at.alpha.t * s.alpha_in_p.t > T(0.0), limited, at.alpha);

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
T stress_norm(T p, const DeviatorOf<T>& s) {
  return sqrt(2.0 * p * p + dot(s, s));
}

/// What a sub-step would lead to.
template <class T>
struct Trial {
  PointOf<T> end;
  T error;  ///< of the stress [Pa]
  T size;   ///< what it is compared with [Pa]
  T Mb;     ///< bounding ratio at the end
};

/// The sub-step `step` from `at`; a reversal of loading goes into `s`. `forced`: this step is taken
/// whatever the error, so that a mean stress that would become tensile ends at the floor.
template <class Mask, class T>
Trial<T> attempt(const SoilOf<T>& c, StateOf<T>& s, const PointOf<T>& at, const StrainOf<T>& step,
                 const Mask& forced) {
  const T stiff = stiffening(c, s);
  const Local<T> start = local(c, s, stiff, at);
  const Rates<T> elastic = elastic_rates(c, start.G, step);
  const DeviatorOf<T> n = (at.s + elastic.s) - (at.p + elastic.p) * at.alpha;
  const auto turns = dot(at.alpha - s.alpha_true, n) < T(0.0);
  if (any(turns)) reverse(c, s, turns, at, n);

  const T a = elastic_part(c.m, at, elastic);
  const auto stays = a >= T(1.0), some = a > T(0.0);
  PointOf<T> from = at;
  const T size = 2.0 * max(stress_norm(at.p, at.s), s.p_min);
  T elastic_error = 0.0;
  if (any(some)) {
    from.p += a * elastic.p;
    from.s = from.s + a * elastic.s;
    // G follows sqrt(p): what an elastic step with the modulus of its start misses
    elastic_error = a * a * abs(elastic.p) * stress_norm(elastic.p, elastic.s) / (2.0 * start.p);
  }
  Trial<T> r{from, select(from.p > T(0.0) || forced, elastic_error, size), size, start.surfaces.Mb};
  if (all(stays)) return r;

  const StrainOf<T> rest{(1.0 - a) * step.volumetric, (1.0 - a) * step.deviator};
  const History<T> h = history(c, s);
  const Rates<T> r1 =
      rates(c, s, h, any(some && !stays) ? local(c, s, stiff, from) : start, from, rest);
  const PointOf<T> middle = moved(from, r1);
  const Local<T> at_middle = local(c, s, stiff, middle);
  const Rates<T> r2 = rates(c, s, h, at_middle, middle, rest);
  const PointOf<T> end{from.p + 0.5 * (r1.p + r2.p), from.s + 0.5 * (r1.s + r2.s),
                       from.alpha + 0.5 * (r1.alpha + r2.alpha), from.z + 0.5 * (r1.z + r2.z)};
  const T error = elastic_error + stress_norm(r2.p - r1.p, r2.s - r1.s);

  // Mean stress would become tensile: a smaller step, or, where that is spent, the floor.
  const auto holds = middle.p > T(0.0) && end.p > T(0.0);
  PointOf<T> collapsed = from;
  collapsed.p = select(forced, T(0.0), from.p);
  r.end = select(stays, from, select(holds, end, collapsed));
  r.error = select(stays, r.error, select(holds, error, size));
  r.Mb = select(!stays && holds, at_middle.surfaces.Mb, r.Mb);
  return r;
}

/// Ends a sub-step: the floor of mean stress, the stress on the yield surface and within the
/// bounding surface.
template <class T>
void settle(const SoilOf<T>& c, const StateOf<T>& s, Trial<T>& trial) {
  PointOf<T>& end = trial.end;
  end.p = max(end.p, kFloor * s.p_min);
  // drift: the back-stress ratio is moved so that the stress lies on the yield surface
  const DeviatorOf<T> offset = end.s - end.p * end.alpha;
  const T radius = kRootHalf * c.m * end.p, radius2 = radius * radius;
  const T length2 = dot(offset, offset);
  const auto outside = length2 > radius2;
  if (any(outside)) {
    const T length = sqrt(length2);
    end.alpha =
        select(outside, (1.0 / (length * end.p)) * (length * end.s - radius * offset), end.alpha);
  }
  const T q = max(end.p, s.p_min) * trial.Mb, q2 = 2.0 * dot(end.s, end.s);
  const auto beyond = q2 > q * q;
  if (any(beyond)) {
    end.s = select(beyond, (q / sqrt(q2)) * end.s, end.s);
    end.alpha = select(beyond, ((trial.Mb - c.m) / (trial.Mb * end.p)) * end.s, end.alpha);
  }
}

}  // namespace flowslide::pm4sand
