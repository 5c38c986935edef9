#pragma once
#include "constitutive/pm4sand.hpp"
#include "core/elementary_lanes.hpp"

/// The rate equations of PM4Sand at one state: surfaces, moduli, plastic modulus, dilatancy.
/// Symbols and equation numbers: docs/theory/pm4sand.md. Compression positive, Pa. T is double, or
/// lanes of them; what only some lanes need is left out where none does.
namespace flowslide::pm4sand {

using flowslide::select;

inline constexpr double kRoot2 = 1.4142135623730951;
inline constexpr double kRootHalf = 0.7071067811865476;

template <class T>
DeviatorOf<T> operator+(const DeviatorOf<T>& a, const DeviatorOf<T>& b) {
  return {a.d + b.d, a.t + b.t};
}
template <class T>
DeviatorOf<T> operator-(const DeviatorOf<T>& a, const DeviatorOf<T>& b) {
  return {a.d - b.d, a.t - b.t};
}
template <class T>
DeviatorOf<T> operator*(const std::type_identity_t<T>& f, const DeviatorOf<T>& a) {
  return {f * a.d, f * a.t};
}
template <class Mask, class T>
DeviatorOf<T> select(const Mask& c, const DeviatorOf<T>& a, const DeviatorOf<T>& b) {
  return {select(c, a.d, b.d), select(c, a.t, b.t)};
}
/// a : b, both normal components and both shear components counted.
template <class T>
T dot(const DeviatorOf<T>& a, const DeviatorOf<T>& b) {
  return 2.0 * (a.d * b.d + a.t * b.t);
}
template <class T>
T norm(const DeviatorOf<T>& a) {
  return sqrt(dot(a, a));
}
template <class T>
T positive(T x) {
  return select(x > T(0.0), x, T(0.0));
}
template <class T>
T clamp(T x, std::type_identity_t<T> low, std::type_identity_t<T> high) {
  return select(x < low, low, select(high < x, high, x));
}

/// What integration carries from sub-step to sub-step.
template <class T>
struct PointOf {
  T p;              ///< (xx + yy)/2 [Pa]
  DeviatorOf<T> s;  ///< [Pa]
  DeviatorOf<T> alpha, z;
};

/// A strain increment.
template <class T>
struct StrainOf {
  T volumetric;
  DeviatorOf<T> deviator;
};

template <class T>
struct Surfaces {
  T xi;  ///< relative state parameter index xi_R
  T Mb, Md;
};

/// Eqs (2), (3).
template <class T>
Surfaces<T> surfaces(const SoilOf<T>& c, T p, T Dr) {
  const T xi = c.R / max(c.depth - log(p), T(0.1)) - Dr;
  const auto dense = xi <= T(0.0);
  return {xi, c.M * exp(-select(dense, c.nb, 0.25 * c.nb) * xi),
          c.M * exp(select(dense, c.nd, 4.0 * c.nd) * xi)};
}

template <class T>
T relative_density(const SoilOf<T>& c, T void_ratio) {
  return c.density_rate * (c.emax - void_ratio);
}

/// The factor of fabric on G in eq (4); constant in a sub-step.
template <class T>
T stiffening(const SoilOf<T>& c, const StateOf<T>& s) {
  return (s.z_max + s.z_cum) / (s.z_max + c.Cgd * s.z_cum);
}

/// What depends on pressure and stress ratio at a point.
template <class T>
struct Local {
  T p;  ///< not below p_min
  Surfaces<T> surfaces;
  T squared_ratio;  ///< (M_cur/M_b)^2
  T G;
};

/// Eqs (2) to (7).
template <class T>
Local<T> local(const SoilOf<T>& c, const StateOf<T>& s, T stiffening, const PointOf<T>& at) {
  const T p = max(at.p, s.p_min);
  const Surfaces<T> f = surfaces(c, p, relative_density(c, s.void_ratio));
  const T q_bounding = p * f.Mb;
  const T ratio2 = 2.0 * dot(at.s, at.s) / (q_bounding * q_bounding);
  const T c_sr = 1.0 - 0.5 * min(T(1.0), ratio2 * ratio2);
  T G = c.G_unit * sqrt(p) * c_sr * stiffening;
  const auto settling = c.post_shake > T(0.0);
  if (any(settling)) {
    const T below_dilatancy = positive(1.0 - sqrt(ratio2) * f.Mb / f.Md);
    const T p_sed = c.p_sedo * (s.z_cum / (s.z_cum + s.z_max)) * sqrt(sqrt(below_dilatancy));
    const T softer = min(T(1.0), c.Fsed_min + (1.0 - c.Fsed_min) * positive(at.p) /
                                                  (20.0 * (p_sed + 1e-9 * c.P_atm)));
    G = select(settling, G * softer, G);
  }
  return {p, f, ratio2, G};
}

/// What depends on the history but not on the stress: one set per sub-step.
template <class T>
struct History {
  T inverse_z_max, inverse_p_min;
  T peak_ratio;  ///< z_peak/z_max
  T C_zpk1, root_zpk2;
  T inverse_C_dz;
  T fabric_rate;  ///< c_z / (1 + <z_cum/(2 z_max) - 1>)
};

template <class T>
History<T> history(const SoilOf<T>& c, const StateOf<T>& s) {
  History<T> h;
  const T both = 1.0 / (s.z_max * s.p_min);
  h.inverse_z_max = both * s.p_min;
  h.inverse_p_min = both * s.z_max;
  h.peak_ratio = s.z_peak * h.inverse_z_max;
  const T above1 = s.z_cum + 0.2 * s.z_max, above2 = s.z_cum + 0.01 * s.z_max;
  const T shares = s.z_peak / (above1 * above2);
  h.C_zpk1 = shares * above2;
  const T C_zpk2 = min(shares * above1, T(1.0 - 1e-10)), C_rot2 = 1.0 - C_zpk2;
  h.root_zpk2 = sqrt(C_rot2);
  const T most = 1.0 + 0.5 * s.z_max, kept = (1.0 - C_rot2 * kRoot2 * h.peak_ratio) * s.z_max;
  h.inverse_C_dz = select(kept > T(0.0), min((s.z_max + C_rot2 * s.z_cum) / kept, most), most);
  h.fabric_rate = c.cz / (1.0 + positive(0.5 * s.z_cum * h.inverse_z_max - 1.0));
  return h;
}

template <class T>
struct Flow {
  DeviatorOf<T> n;       ///< unit loading direction
  T D;                   ///< dilatancy, contraction positive
  T Kp;                  ///< plastic modulus [Pa]
  T b_n;                 ///< (alpha_b - alpha) : n, way to the image on the bounding surface
  DeviatorOf<T> b_side;  ///< the part of alpha_b - alpha across n
  T rate;                ///< d alpha = L rate/p (b_n n + b_side) [Pa]
  decltype(T() < T()) beyond_dilatancy;  ///< (alpha_d - alpha) : n < 0, where fabric grows
};

/// Where a point stands along its loading direction.
template <class T>
struct Along {
  T contracted;    ///< distance from the start of the branch that contraction counts
  T z_n;           ///< z : n
  T minus_z_n;     ///< <-z : n>
  T to_dilatancy;  ///< (alpha_d - alpha) : n
  T to_rotated;    ///< (alpha_dr - alpha) : n
  T C_zin1;        ///< given where -z : n > 0 or the dilatancy surface is passed
};

/// Dilatancy beyond the rotated dilatancy surface, eqs (14) to (19). A_d is a quotient of products
/// here: with K = 1/(C_pzp C_pmin) and F the rest of the sum, A_d = A_do C_zin2 K/(F + K).
template <class T>
T dilation(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Local<T>& l,
           T inverse_p, const Along<T>& w) {
  const T r = select(s.p_zp > T(0.0), 2.5 * l.p / s.p_zp, T(0.0)), r2 = r * r;
  const T floor_ratio = 10.0 * s.p_min * inverse_p;
  const T K = (1.0 + r2 * r2 * r) * (1.0 + floor_ratio * floor_ratio);
  const T turned = w.C_zin1 * (s.z_cum - s.z_peak) * h.inverse_z_max * (1.0 / 3.0);
  const T free = 1.0 - w.minus_z_n * kRootHalf / s.z_peak;
  const T F = s.z_cum * s.z_cum * h.inverse_z_max * (free * free * free) * c.ce2 * w.C_zin1;
  const T A_d = s.A_do * (1.0 + turned) * K / ((1.0 + 3.0 * turned) * (F + K));
  T D = A_d * w.to_dilatancy;
  const T D_rot = A_d * w.minus_z_n * (kRootHalf * h.inverse_z_max * c.inverse_Cdr) * w.to_rotated;
  const T below_bounding = positive(l.surfaces.Mb * (1.0 - sqrt(l.squared_ratio)));
  D = select(D > D_rot, D + (D_rot - D) * below_bounding / (below_bounding + 0.01), D);
  const T least = -3.5 * s.A_do * positive(l.surfaces.Mb - l.surfaces.Md) * (2.0 * s.p_min - l.p) *
                  h.inverse_p_min;
  return select(l.p <= 2.0 * s.p_min, min(D, least), D);
}

/// Dilatancy inside the rotated dilatancy surface, eqs (20) to (24).
template <class T>
T contraction(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Local<T>& l,
              const Along<T>& w) {
  const T loose = positive(0.5 - l.surfaces.xi);
  const T inverse_hp = c.inverse_hpo * exp(0.7 - 7.0 * loose * loose);
  const T A_dc = s.A_do * (1.0 + positive(w.z_n)) * inverse_hp * h.inverse_C_dz;
  const T x = w.contracted + kRoot2 * positive(w.z_n) * h.inverse_z_max;
  const T D = min(A_dc * x * x, 1.5 * s.A_do) * w.to_dilatancy / (w.to_dilatancy + 0.16);
  return D * clamp((l.p - 2.0 * s.p_min) * h.inverse_p_min * (1.0 / 16.0), 0.0, 1.0);
}

/// The flow rule at `at`; `inverse_p` is 1/l.p.
template <class T>
Flow<T> flow(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Local<T>& l,
             T inverse_p, const PointOf<T>& at) {
  Flow<T> r;
  r.n = at.s - at.p * at.alpha;
  const T length = norm(r.n);
  r.n = select(length > 1e-12 * c.P_atm, (1.0 / length) * r.n, DeviatorOf<T>{0.0, kRootHalf});

  Along<T> w;
  const T alpha_n = dot(at.alpha, r.n);
  const T to_bounding = kRootHalf * (l.surfaces.Mb - c.m) - alpha_n;
  w.to_dilatancy = kRootHalf * (l.surfaces.Md - c.m) - alpha_n;
  w.z_n = dot(at.z, r.n);
  w.minus_z_n = positive(-w.z_n);

  // plastic modulus, eqs (8) to (11), as one quotient
  const auto opensees = c.opensees_reversals > T(0.0);
  const T from_initial = alpha_n - dot(s.alpha_in, r.n);
  const T from_true = positive(alpha_n - dot(s.alpha_true, r.n));
  const T apparent = select(opensees, positive(from_initial), max(from_initial, from_true));
  const T below_pzp = positive(s.p_zp - l.p);
  const T below_C_ka = (1.0 + 6.25 * from_true * from_true) * (below_pzp + s.p_min);
  const T above_C_ka = below_C_ka + c.Ckaf * below_pzp * h.C_zpk1;
  const T root_b = sqrt(max(abs(to_bounding), T(1e-10)));
  const auto returns = alpha_n <= dot(s.alpha_in_p, r.n);
  w.contracted = select(opensees, from_initial, select(returns, from_true, apparent));
  const T above = l.G * c.h0 * above_C_ka * select(returns, apparent + c.C_g1, T(1.0));
  const T below = below_C_ka * (exp(apparent) - 1.0 + c.C_g1) * root_b *
                  (1.0 + 2.0 * h.peak_ratio * positive(to_bounding) * h.root_zpk2) *
                  select(returns, from_true + c.C_g1, T(1.0));
  r.rate = above / below;
  r.Kp = r.rate * to_bounding;
  r.b_n = to_bounding;
  r.b_side = alpha_n * r.n - at.alpha;

  // eq (13); the surface is rotated only where fabric opposes the loading
  const auto opposed = w.minus_z_n > T(0.0);
  w.C_zin1 = 0.0;
  w.to_rotated = w.to_dilatancy;
  if (any(opposed || w.to_dilatancy <= T(0.0)))
    w.C_zin1 = 1.0 - exp(-2.0 * abs(dot(s.z_in, r.n) - w.z_n) * h.inverse_z_max);
  if (any(opposed)) {
    const T C_rot1 = 1.0 + kRoot2 * w.minus_z_n * h.inverse_z_max * (1.0 - w.C_zin1);
    w.to_rotated = kRootHalf * (l.surfaces.Md / C_rot1 - c.m) - alpha_n;
  }
  const auto dilating = w.to_rotated <= T(0.0);
  r.D = 0.0;
  if (any(dilating)) r.D = dilation(c, s, h, l, inverse_p, w);
  if (!all(dilating)) {
    r.Kp = select(dilating, r.Kp, max(r.Kp, T(0.0)));  // eq (12)
    r.D = select(dilating, r.D, contraction(c, s, h, l, w));
  }
  r.beyond_dilatancy = w.to_dilatancy < T(0.0);
  return r;
}

}  // namespace flowslide::pm4sand
