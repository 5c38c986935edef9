#pragma once
#include "constitutive/concept.hpp"

/// Return of principal stresses to the Mohr-Coulomb surface with a Rankine tension cut-off.
/// All regions (face, both edges, tension face, edges and corner) in closed form after
/// Clausen, Damkilde & Andersen (2006), IJNME 66; written without branches so that it vectorises.
/// docs/theory/mohr-coulomb.md
namespace flowslide {

template <class T>
struct Principal {
  T s1, s2, s3;  ///< [Pa], tension positive, s1 >= s2 >= s3
};

/// f = k s1 - s3 - sigma_c <= 0 and s1 <= tension; flow direction m s1 - s3.
template <class T>
struct MohrCoulombSurface {
  T k;        ///< (1 + sin phi) / (1 - sin phi)
  double m;   ///< (1 + sin psi) / (1 - sin psi)
  T sigma_c;  ///< uniaxial compressive strength 2 c sqrt(k) [Pa]
  T tension;  ///< cut-off [Pa], at most the apex c / tan phi
};

/// Largest violation of the surface [Pa]; <= 0 is admissible.
template <class T>
[[nodiscard]] T yield_violation(const MohrCoulombSurface<T>& y, const Principal<T>& s) noexcept {
  return max(y.k * s.s1 - s.s3 - y.sigma_c, s.s1 - y.tension);
}

/// Return to the face or the edges of the cone; `f13` is the trial's violation.
template <class T>
[[nodiscard, gnu::always_inline]] inline Principal<T> return_to_cone(double lambda, double two_g,
                                                                     const MohrCoulombSurface<T>& y,
                                                                     const Principal<T>& t,
                                                                     T f13) noexcept {
  // D b of the flow directions of s1-s3; the planes of the edges follow by exchanging components.
  const double common = lambda * (y.m - 1.0);
  const double db_one = common + two_g * y.m;
  const double db_three = common - two_g;
  const T a_db = y.k * db_one - db_three;  // a^T D b of one plane

  // Face.
  const T q1 = y.k * common - db_three, det1 = a_db * a_db - q1 * q1;
  const T q2 = y.k * db_one - common, det2 = a_db * a_db - q2 * q2;
  // One division for three: a_db, det1 and det2 are positive.
  const T inverse = reciprocal(a_db * det1 * det2);
  const T x = max(T(0.0), f13) * (inverse * det1 * det2);
  const Principal<T> face{t.s1 - x * db_one, t.s2 - x * common, t.s3 - x * db_three};

  // Edge s1 = s2: planes 13 and 23 together, multipliers from a symmetric 2 x 2 system.
  const T f23 = y.k * t.s2 - t.s3 - y.sigma_c;
  const T over_det1 = inverse * a_db * det2;
  const T xa = (a_db * f13 - q1 * f23) * over_det1, xb = (a_db * f23 - q1 * f13) * over_det1;
  const T upper = 0.5 * ((t.s1 - xa * db_one - xb * common) + (t.s2 - xb * db_one - xa * common));
  const Principal<T> edge12{upper, upper, y.k * upper - y.sigma_c};

  // Edge s2 = s3: planes 13 and 12.
  const T f12 = y.k * t.s1 - t.s2 - y.sigma_c;
  const T over_det2 = inverse * a_db * det1;
  const T xc = (a_db * f13 - q2 * f12) * over_det2, xd = (a_db * f12 - q2 * f13) * over_det2;
  const T top = t.s1 - (xc + xd) * db_one;
  const T lower = y.k * top - y.sigma_c;
  const Principal<T> edge23{top, lower, lower};

  const auto use12 = face.s2 > face.s1;
  const auto use23 = face.s3 > face.s2;
  return {select(use12, edge12.s1, select(use23, edge23.s1, face.s1)),
          select(use12, edge12.s2, select(use23, edge23.s2, face.s2)),
          select(use12, edge12.s3, select(use23, edge23.s3, face.s3))};
}

/// Return to the face, edge or corner of the Rankine planes of the cut-off `st`.
template <class T>
[[nodiscard, gnu::always_inline]] inline Principal<T> return_to_cut_off(
    double lambda, double two_g, double shear, T st, const Principal<T>& t) noexcept {
  const T over1 = max(T(0.0), t.s1 - st);
  const double ratio1 = lambda / (lambda + two_g);
  const T r2 = t.s2 - over1 * ratio1, r3 = t.s3 - over1 * ratio1;
  const T over12 = 0.5 * ((t.s1 - st) + (t.s2 - st));
  const double ratio12 = lambda / (lambda + shear);
  const T r3_edge = t.s3 - over12 * ratio12;
  const auto two = r2 > st;
  const auto three = two && r3_edge > st;
  return {st, select(two, st, r2), select(three, st, select(two, r3_edge, r3))};
}

template <class T>
[[nodiscard]] Principal<T> return_to_mohr_coulomb(const Elasticity& e,
                                                  const MohrCoulombSurface<T>& y,
                                                  const Principal<T>& t) noexcept {
  const double lambda = e.bulk - 2.0 / 3.0 * e.shear;
  const double two_g = 2.0 * e.shear;
  const T st = y.tension, f13 = y.k * t.s1 - t.s3 - y.sigma_c;
  const Principal<T> shear = return_to_cone(lambda, two_g, y, t, f13);
  const Principal<T> rankine = return_to_cut_off(lambda, two_g, e.shear, st, t);

  // Where tension and shear meet: s1 and s3 are fixed, s2 follows from both flow directions.
  const T s3_corner = y.k * st - y.sigma_c;
  const double over_both = 1.0 / (2.0 * two_g * (lambda + e.shear));
  const T xm = ((t.s1 - st) * lambda - (t.s3 - s3_corner) * (lambda + two_g)) * over_both;
  const T s2_corner = t.s2 - (t.s3 - s3_corner) - two_g * xm;
  const Principal<T> corner{st, min(st, max(s3_corner, s2_corner)), s3_corner};

  const auto elastic = f13 <= T(0.0) && t.s1 <= st;
  const auto shear_holds = shear.s1 <= st && f13 > T(0.0);
  const auto rankine_holds = t.s1 > st && y.k * st - rankine.s3 - y.sigma_c <= T(0.0);
  const auto pick = [&](T a, T b, T c, T d) {
    return select(elastic, a, select(shear_holds, b, select(rankine_holds, c, d)));
  };
  return {pick(t.s1, shear.s1, rankine.s1, corner.s1), pick(t.s2, shear.s2, rankine.s2, corner.s2),
          pick(t.s3, shear.s3, rankine.s3, corner.s3)};
}

}  // namespace flowslide
