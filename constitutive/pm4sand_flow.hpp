#pragma once
#include "constitutive/pm4sand.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

/// The rate equations of PM4Sand at one state: surfaces, moduli, plastic modulus, dilatancy.
/// Symbols and equation numbers: docs/theory/pm4sand.md. Compression positive, Pa.
namespace flowslide::pm4sand {

using Deviator = PM4Sand::Deviator;

inline constexpr double kRoot2 = 1.4142135623730951;
inline constexpr double kRootHalf = 0.7071067811865476;

constexpr Deviator operator+(const Deviator& a, const Deviator& b) {
  return {a.d + b.d, a.t + b.t};
}
constexpr Deviator operator-(const Deviator& a, const Deviator& b) {
  return {a.d - b.d, a.t - b.t};
}
constexpr Deviator operator*(double f, const Deviator& a) { return {f * a.d, f * a.t}; }
/// a : b, both normal components and both shear components counted.
constexpr double dot(const Deviator& a, const Deviator& b) { return 2.0 * (a.d * b.d + a.t * b.t); }
inline double norm(const Deviator& a) { return std::sqrt(dot(a, a)); }
constexpr double positive(double x) { return x > 0.0 ? x : 0.0; }

/// What integration carries from sub-step to sub-step.
struct Point {
  double p;    ///< (xx + yy)/2 [Pa]
  Deviator s;  ///< [Pa]
  Deviator alpha, z;
};

/// A strain increment.
struct Strain {
  double volumetric;
  Deviator deviator;
};

struct Surfaces {
  double xi;  ///< relative state parameter index xi_R
  double Mb, Md;
};

/// Eqs (2), (3).
inline Surfaces surfaces(const PM4Sand::Constants& c, double p, double Dr) {
  const double depth = std::max(c.Q - log(100.0 * p / c.P_atm), 0.1);
  const double xi = c.R / depth - Dr;
  const bool dense = xi <= 0.0;
  return {xi, c.M * exp(-(dense ? c.nb : 0.25 * c.nb) * xi),
          c.M * exp((dense ? c.nd : 4.0 * c.nd) * xi)};
}

inline double relative_density(const PM4Sand::Constants& c, double void_ratio) {
  return (c.emax - void_ratio) / (c.emax - c.emin);
}

struct Moduli {
  double K, G;
  double M_cur;  ///< q/p
};

/// Eqs (4) to (6).
inline Moduli moduli(const PM4Sand::Constants& c, const PM4Sand::State& s, const Surfaces& f,
                     double p, const Deviator& dev) {
  const double pn = std::max(p, s.p_min);
  const double M_cur = kRoot2 * norm(dev) / pn;
  const double ratio = M_cur / f.Mb, ratio2 = ratio * ratio;
  const double c_sr = 1.0 - 0.5 * std::min(1.0, ratio2 * ratio2);
  const double fabric = s.z_cum / s.z_max;
  double G = c.G0 * std::sqrt(pn * c.P_atm) * c_sr * (1.0 + fabric) / (1.0 + fabric * c.Cgd);
  if (c.post_shake) {
    const double p_sed =
        c.p_sedo * (s.z_cum / (s.z_cum + s.z_max)) *
        std::sqrt(std::sqrt(positive(1.0 - M_cur / f.Md)));
    G *= std::min(
        1.0, c.Fsed_min + (1.0 - c.Fsed_min) * positive(p) / (20.0 * (p_sed + 1e-9 * c.P_atm)));
  }
  return {c.bulk_ratio * G, G, M_cur};
}

/// What depends on the history but not on the stress: one set per sub-step.
struct History {
  double inverse_z_max;
  double peak_ratio;  ///< z_peak/z_max
  double C_zpk1, C_zpk2, root_zpk2;
  double C_dz;
  double fabric_rate;  ///< c_z / (1 + <z_cum/(2 z_max) - 1>)
};

inline History history(const PM4Sand::Constants& c, const PM4Sand::State& s) {
  const double C_zpk2 = std::min(s.z_peak / (s.z_cum + s.z_max / 100.0), 1.0 - 1e-10);
  const double C_rot2 = 1.0 - C_zpk2;
  const double inverse = 1.0 / s.z_max;
  return {inverse,
          s.z_peak * inverse,
          s.z_peak / (s.z_cum + 0.2 * s.z_max),
          C_zpk2,
          std::sqrt(C_rot2),
          std::max(
              (1.0 - C_rot2 * kRoot2 * s.z_peak * inverse) * s.z_max / (s.z_max + C_rot2 * s.z_cum),
              1.0 / (1.0 + 0.5 * s.z_max)),
          c.cz / (1.0 + positive(0.5 * s.z_cum * inverse - 1.0))};
}

struct Flow {
  Deviator n;             ///< unit loading direction
  double D;               ///< dilatancy, contraction positive
  double Kp;              ///< plastic modulus [Pa]
  double b_n;             ///< (alpha_b - alpha) : n, way to the image on the bounding surface
  Deviator b_side;        ///< the part of alpha_b - alpha across n
  double pull;            ///< d alpha = L pull (b_n n + b_side)
  bool beyond_dilatancy;  ///< (alpha_d - alpha) : n < 0, where fabric grows
};

/// Dilatancy beyond the rotated dilatancy surface, eqs (14) to (19).
inline double dilation(const PM4Sand::Constants& c, const PM4Sand::State& s, const History& h,
                       const Surfaces& f, double M_cur, double p, double minus_z_n, double C_zin1,
                       double to_dilatancy, double to_rotated) {
  const double p_ratio = s.p_zp > 0.0 ? 2.5 * p / s.p_zp : 0.0;
  const double p_ratio2 = p_ratio * p_ratio;
  const double C_pzp = 1.0 / (1.0 + p_ratio2 * p_ratio2 * p_ratio);
  const double floor_ratio = 10.0 * s.p_min / p;
  const double C_pmin = 1.0 / (1.0 + floor_ratio * floor_ratio);
  const double turned = C_zin1 * (s.z_cum - s.z_peak) * h.inverse_z_max / 3.0;
  const double C_zin2 = (1.0 + turned) / (1.0 + 3.0 * turned);
  const double free = 1.0 - minus_z_n * kRootHalf / s.z_peak;
  const double A_d = s.A_do * C_zin2 /
                     (s.z_cum * s.z_cum * h.inverse_z_max * free * free * free * c.ce * c.ce *
                          C_pzp * C_pmin * C_zin1 +
                      1.0);
  double D = A_d * to_dilatancy;
  const double D_rot = A_d * minus_z_n * kRootHalf * h.inverse_z_max * to_rotated / c.Cdr;
  if (D > D_rot) {
    const double below_bounding = positive(f.Mb - M_cur);
    D += (D_rot - D) * below_bounding / (below_bounding + 0.01);
  }
  if (p <= 2.0 * s.p_min)
    D = std::min(D, -3.5 * s.A_do * positive(f.Mb - f.Md) * (2.0 * s.p_min - p) / s.p_min);
  return D;
}

/// Dilatancy inside the rotated dilatancy surface, eqs (20) to (24).
inline double contraction(const PM4Sand::Constants& c, const PM4Sand::State& s, const History& h,
                          const Surfaces& f, double p, double z_n, double contracted,
                          double to_dilatancy) {
  const double loose = positive(0.5 - f.xi);
  const double hp = c.hpo * exp(-0.7 + 7.0 * loose * loose);
  const double A_dc = s.A_do * (1.0 + positive(z_n)) / (hp * h.C_dz);
  const double x = contracted + kRoot2 * positive(z_n) * h.inverse_z_max;
  const double D = std::min(A_dc * x * x, 1.5 * s.A_do) * to_dilatancy / (to_dilatancy + 0.16);
  return D * std::clamp((p - 2.0 * s.p_min) / (16.0 * s.p_min), 0.0, 1.0);
}

/// The flow rule at stress (p, dev); `p` is not below p_min.
inline Flow flow(const PM4Sand::Constants& c, const PM4Sand::State& s, const History& h,
                 const Surfaces& f, const Moduli& e, double p, const Point& at) {
  Flow r;
  r.n = at.s - at.p * at.alpha;
  const double length = norm(r.n);
  r.n = length > 1e-12 * c.P_atm ? (1.0 / length) * r.n : Deviator{0.0, kRootHalf};

  const double alpha_n = dot(at.alpha, r.n);
  const double to_bounding = kRootHalf * (f.Mb - c.m) - alpha_n;
  const double to_dilatancy = kRootHalf * (f.Md - c.m) - alpha_n;
  // distances from the start of the branch: true, apparent, and that of contraction
  const double from_in = alpha_n - dot(s.alpha_in, r.n);
  const double from_true = positive(alpha_n - dot(s.alpha_true, r.n));
  const bool inside = alpha_n <= dot(s.alpha_in_p, r.n);
  const double apparent = c.opensees_reversals ? positive(from_in) : std::max(from_in, from_true);
  const double contracted = c.opensees_reversals ? from_in : inside ? from_true : apparent;
  const double z_n = dot(at.z, r.n), minus_z_n = positive(-z_n);

  // plastic modulus, eqs (8) to (12)
  const double below_pzp = positive(s.p_zp - p);
  const double C_ka = 1.0 + c.Ckaf / (1.0 + 6.25 * from_true * from_true) * below_pzp /
                                (below_pzp + s.p_min) * h.C_zpk1;
  const double C_g1 = c.h0 / 200.0;
  const double root_b = std::sqrt(std::max(std::abs(to_bounding), 1e-10));
  double rate = e.G * c.h0 * C_ka /
                ((exp(apparent) - 1.0 + C_g1) * root_b *
                 (1.0 + 2.0 * h.peak_ratio * positive(to_bounding) * h.root_zpk2));
  if (inside) rate *= (apparent + C_g1) / (from_true + C_g1);
  r.Kp = rate * to_bounding;
  r.pull = rate / p;
  r.b_n = to_bounding;
  r.b_side = alpha_n * r.n - at.alpha;

  const double C_zin1 = 1.0 - exp(-2.0 * std::abs(dot(s.z_in, r.n) - z_n) * h.inverse_z_max);
  const double C_rot1 = 1.0 + kRoot2 * minus_z_n * h.inverse_z_max * (1.0 - C_zin1);
  const double to_rotated = kRootHalf * (f.Md / C_rot1 - c.m) - alpha_n;
  if (to_rotated <= 0.0) {
    r.D = dilation(c, s, h, f, e.M_cur, p, minus_z_n, C_zin1, to_dilatancy, to_rotated);
  } else {
    r.Kp = std::max(r.Kp, 0.0);
    r.D = contraction(c, s, h, f, p, z_n, contracted, to_dilatancy);
  }
  r.beyond_dilatancy = to_dilatancy < 0.0;
  return r;
}

}  // namespace flowslide::pm4sand
