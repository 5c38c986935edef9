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
  const T depth = max(c.Q - log(100.0 * p / c.P_atm), T(0.1));
  const T xi = c.R / depth - Dr;
  const auto dense = xi <= T(0.0);
  return {xi, c.M * exp(-select(dense, c.nb, 0.25 * c.nb) * xi),
          c.M * exp(select(dense, c.nd, 4.0 * c.nd) * xi)};
}

template <class T>
T relative_density(const SoilOf<T>& c, T void_ratio) {
  return (c.emax - void_ratio) / (c.emax - c.emin);
}

template <class T>
struct Moduli {
  T K, G;
  T M_cur;  ///< q/p
};

/// Eqs (4) to (6).
template <class T>
Moduli<T> moduli(const SoilOf<T>& c, const StateOf<T>& s, const Surfaces<T>& f, T p,
                 const DeviatorOf<T>& dev) {
  const T pn = max(p, s.p_min);
  const T M_cur = kRoot2 * norm(dev) / pn;
  const T ratio = M_cur / f.Mb, ratio2 = ratio * ratio;
  const T c_sr = 1.0 - 0.5 * min(T(1.0), ratio2 * ratio2);
  const T fabric = s.z_cum / s.z_max;
  T G = c.G0 * sqrt(pn * c.P_atm) * c_sr * (1.0 + fabric) / (1.0 + fabric * c.Cgd);
  const auto settling = c.post_shake > T(0.0);
  if (any(settling)) {
    const T p_sed = c.p_sedo * (s.z_cum / (s.z_cum + s.z_max)) *
                    sqrt(sqrt(positive(1.0 - M_cur / f.Md)));
    const T softer = min(T(1.0), c.Fsed_min + (1.0 - c.Fsed_min) * positive(p) /
                                                  (20.0 * (p_sed + 1e-9 * c.P_atm)));
    G = select(settling, G * softer, G);
  }
  return {c.bulk_ratio * G, G, M_cur};
}

/// What depends on the history but not on the stress: one set per sub-step.
template <class T>
struct History {
  T inverse_z_max;
  T peak_ratio;  ///< z_peak/z_max
  T C_zpk1, root_zpk2;
  T C_dz;
  T fabric_rate;  ///< c_z / (1 + <z_cum/(2 z_max) - 1>)
};

template <class T>
History<T> history(const SoilOf<T>& c, const StateOf<T>& s) {
  const T C_zpk2 = min(s.z_peak / (s.z_cum + s.z_max / 100.0), T(1.0 - 1e-10));
  const T C_rot2 = 1.0 - C_zpk2;
  const T inverse = 1.0 / s.z_max;
  return {inverse,
          s.z_peak * inverse,
          s.z_peak / (s.z_cum + 0.2 * s.z_max),
          sqrt(C_rot2),
          max((1.0 - C_rot2 * kRoot2 * s.z_peak * inverse) * s.z_max / (s.z_max + C_rot2 * s.z_cum),
              1.0 / (1.0 + 0.5 * s.z_max)),
          c.cz / (1.0 + positive(0.5 * s.z_cum * inverse - 1.0))};
}

template <class T>
struct Flow {
  DeviatorOf<T> n;                      ///< unit loading direction
  T D;                                  ///< dilatancy, contraction positive
  T Kp;                                 ///< plastic modulus [Pa]
  T b_n;                                ///< (alpha_b - alpha) : n, way to the image on the bounding surface
  DeviatorOf<T> b_side;                 ///< the part of alpha_b - alpha across n
  T pull;                               ///< d alpha = L pull (b_n n + b_side)
  decltype(T() < T()) beyond_dilatancy; ///< (alpha_d - alpha) : n < 0, where fabric grows
};

/// Dilatancy beyond the rotated dilatancy surface, eqs (14) to (19).
template <class T>
T dilation(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Surfaces<T>& f,
           T M_cur, T p, T minus_z_n, T C_zin1, T to_dilatancy, T to_rotated) {
  const T p_ratio = select(s.p_zp > T(0.0), 2.5 * p / s.p_zp, T(0.0));
  const T p_ratio2 = p_ratio * p_ratio;
  const T C_pzp = 1.0 / (1.0 + p_ratio2 * p_ratio2 * p_ratio);
  const T floor_ratio = 10.0 * s.p_min / p;
  const T C_pmin = 1.0 / (1.0 + floor_ratio * floor_ratio);
  const T turned = C_zin1 * (s.z_cum - s.z_peak) * h.inverse_z_max / 3.0;
  const T C_zin2 = (1.0 + turned) / (1.0 + 3.0 * turned);
  const T free = 1.0 - minus_z_n * kRootHalf / s.z_peak;
  const T A_d = s.A_do * C_zin2 /
                (s.z_cum * s.z_cum * h.inverse_z_max * free * free * free * c.ce * c.ce * C_pzp *
                     C_pmin * C_zin1 +
                 1.0);
  T D = A_d * to_dilatancy;
  const T D_rot = A_d * minus_z_n * kRootHalf * h.inverse_z_max * to_rotated / c.Cdr;
  const T below_bounding = positive(f.Mb - M_cur);
  D = select(D > D_rot, D + (D_rot - D) * below_bounding / (below_bounding + 0.01), D);
  const T least = -3.5 * s.A_do * positive(f.Mb - f.Md) * (2.0 * s.p_min - p) / s.p_min;
  return select(p <= 2.0 * s.p_min, min(D, least), D);
}

/// Dilatancy inside the rotated dilatancy surface, eqs (20) to (24).
template <class T>
T contraction(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Surfaces<T>& f,
              T p, T z_n, T from_initial, T to_dilatancy) {
  const T loose = positive(0.5 - f.xi);
  const T hp = c.hpo * exp(-0.7 + 7.0 * loose * loose);
  const T A_dc = s.A_do * (1.0 + positive(z_n)) / (hp * h.C_dz);
  const T x = from_initial + kRoot2 * positive(z_n) * h.inverse_z_max;
  const T D = min(A_dc * x * x, 1.5 * s.A_do) * to_dilatancy / (to_dilatancy + 0.16);
  return D * clamp((p - 2.0 * s.p_min) / (16.0 * s.p_min), 0.0, 1.0);
}

/// The flow rule at stress (p, dev); `p` is not below p_min.
template <class T>
Flow<T> flow(const SoilOf<T>& c, const StateOf<T>& s, const History<T>& h, const Surfaces<T>& f,
             const Moduli<T>& e, T p, const PointOf<T>& at) {
  Flow<T> r;
  r.n = at.s - at.p * at.alpha;
  const T length = norm(r.n);
  r.n = select(length > 1e-12 * c.P_atm, (1.0 / length) * r.n, DeviatorOf<T>{0.0, kRootHalf});

  const T alpha_n = dot(at.alpha, r.n);
  const T to_bounding = kRootHalf * (f.Mb - c.m) - alpha_n;
  const T to_dilatancy = kRootHalf * (f.Md - c.m) - alpha_n;
  const T from_initial = alpha_n - dot(s.alpha_in, r.n);
  const T from_true = positive(alpha_n - dot(s.alpha_true, r.n));
  const T z_n = dot(at.z, r.n), minus_z_n = positive(-z_n);

  // plastic modulus, eqs (8) to (12)
  const T below_pzp = positive(s.p_zp - p);
  const T C_ka = 1.0 + c.Ckaf / (1.0 + 6.25 * from_true * from_true) * below_pzp /
                           (below_pzp + s.p_min) * h.C_zpk1;
  const T C_g1 = c.h0 / 200.0;
  const T apparent = positive(from_initial);
  const T root_b = sqrt(max(abs(to_bounding), T(1e-10)));
  T rate = e.G * c.h0 * C_ka /
           ((exp(apparent) - 1.0 + C_g1) * root_b *
            (1.0 + 2.0 * h.peak_ratio * positive(to_bounding) * h.root_zpk2));
  rate = select(alpha_n <= dot(s.alpha_in_p, r.n), rate * ((apparent + C_g1) / (from_true + C_g1)),
                rate);
  r.Kp = rate * to_bounding;
  r.pull = rate / p;
  r.b_n = to_bounding;
  r.b_side = alpha_n * r.n - at.alpha;

  const T C_zin1 = 1.0 - exp(-2.0 * abs(dot(s.z_in, r.n) - z_n) * h.inverse_z_max);
  const T C_rot1 = 1.0 + kRoot2 * minus_z_n * h.inverse_z_max * (1.0 - C_zin1);
  const T to_rotated = kRootHalf * (f.Md / C_rot1 - c.m) - alpha_n;
  const auto dilating = to_rotated <= T(0.0);
  r.D = 0.0;
  if (any(dilating))
    r.D = dilation(c, s, h, f, e.M_cur, p, minus_z_n, C_zin1, to_dilatancy, to_rotated);
  if (!all(dilating)) {
    r.Kp = select(dilating, r.Kp, max(r.Kp, T(0.0)));
    r.D = select(dilating, r.D, contraction(c, s, h, f, p, z_n, from_initial, to_dilatancy));
  }
  r.beyond_dilatancy = to_dilatancy < T(0.0);
  return r;
}

}  // namespace flowslide::pm4sand
