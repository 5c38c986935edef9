#pragma once
#include "core/voigt.hpp"

#include <algorithm>
#include <cmath>

/// Principal stresses, and an isotropic function of stress applied in principal axes.
namespace flowslide {

/// Largest, middle and smallest of three without rounding.
template <class T>
struct Sorted3 {
  T hi, mid, lo;
};
template <class T>
[[nodiscard]] Sorted3<T> sort3(T a, T b, T c) noexcept {
  const T hi_ab = max(a, b), lo_ab = min(a, b);
  return {max(hi_ab, c), max(lo_ab, min(hi_ab, c)), min(lo_ab, c)};
}

/// Plane strain: zz is a principal stress; the in-plane pair from Mohr's circle. `map` takes and
/// returns {s1, s2, s3} sorted and must keep the order.
template <class T, class Map>
[[nodiscard]] Stress<2, T> map_principal(const Stress<2, T>& s, Map&& map) noexcept {
  const T centre = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const T radius = sqrt(half * half + s[3] * s[3]);
  const T a = centre + radius, b = centre - radius, z = s[2];
  const Sorted3<T> r = map(sort3(a, b, z));
  const auto z_high = z > a;
  const auto z_low = z < b;
  const T new_a = select(z_high, r.mid, r.hi);
  const T new_b = select(z_low, r.mid, r.lo);
  const T new_centre = 0.5 * (new_a + new_b);
  const T scale = 0.5 * (new_a - new_b) * reciprocal(max(radius, T(1e-140)));
  Stress<2, T> out;
  out[0] = new_centre + scale * half;
  out[1] = new_centre - scale * half;
  out[2] = select(z_high, r.hi, select(z_low, r.lo, r.mid));
  out[3] = scale * s[3];
  return out;
}

/// Three dimensions; Jacobi rotations, accurate also for equal principal stresses.
struct Eigen3 {
  double value[3];      ///< not sorted
  double vector[3][3];  ///< vector[i] belongs to value[i]
};
[[nodiscard]] Eigen3 eigen_symmetric(const Stress<3>& s) noexcept;

template <class Map>
[[nodiscard]] Stress<3> map_principal(const Stress<3>& s, Map&& map) noexcept {
  Eigen3 e = eigen_symmetric(s);
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return e.value[i] > e.value[j]; });
  const Sorted3<double> r =
      map(Sorted3<double>{e.value[order[0]], e.value[order[1]], e.value[order[2]]});
  const double mapped[3] = {r.hi, r.mid, r.lo};
  Stress<3> out;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 3; ++i) {
      const auto& n = e.vector[order[i]];
      out[k] += mapped[i] * n[row[k]] * n[column[k]];
    }
  }
  return out;
}

/// The same for lanes of points (T is Pack or PackPair), without iteration over rotations
/// (docs/theory/mohr-coulomb.md, principal axes): the principal stress farthest from the mean is
/// well separated from the others, so its direction n is accurate; in the plane across n the rest
/// is Mohr's circle.
template <class T, class Map>
[[nodiscard]] Stress<3, T> map_principal(const Stress<3, T>& s, Map&& map) noexcept {
  // Deviator over sqrt(J2 / 3): principal values y with y^3 - 3 y = 2 c, c = cos(3 theta).
  const T p = mean_stress(s), third = j2(s) * (1.0 / 3.0), scale = inverse_sqrt(third + 1e-280);
  const T xx = (s[0] - p) * scale, yy = (s[1] - p) * scale, zz = (s[2] - p) * scale;
  const T xy = s[3] * scale, yz = s[4] * scale, zx = s[5] * scale;
  const T c =
      0.5 * (xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx));
  const auto negative = c < T(0.0);
  const T twice = min(T(2.0), 2.0 * select(negative, -c, c));
  // A cubic within 8e-5 of the root; Newton does the rest.
  T y = 1.73212 + twice * (0.16540 + twice * (-0.02044 + 0.00236 * twice));
  for (int i = 0; i < 2; ++i) y -= (y * (y * y - 3.0) - twice) * reciprocal(3.0 * (y * y - 1.0));
  const T far = select(negative, -y, y);

  // The adjugate of deviator - far is n n^T times a number between 6 and 9.
  const T a = xx - far, b = yy - far, d = zz - far;
  const T a00 = b * d - yz * yz, a11 = a * d - zx * zx, a22 = a * b - xy * xy;
  const T a01 = zx * yz - xy * d, a02 = xy * yz - zx * b, a12 = xy * zx - yz * a;
  const auto first = a00 >= a11 && a00 >= a22, second = a11 >= a22;
  T n[3] = {select(first, a00, select(second, a01, a02)),
            select(first, a01, select(second, a11, a12)),
            select(first, a02, select(second, a12, a22))};
  const T length = inverse_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (T& x : n) x *= length;

  // Two directions across n (Duff et al. 2017), and the stress in these axes.
  const T sign = select(n[2] < T(0.0), T(-1.0), T(1.0));
  const T k = reciprocal(-sign - n[2]), m = n[0] * n[1] * k;
  const T u[3] = {1.0 + sign * n[0] * n[0] * k, sign * m, -sign * n[0]};
  const T v[3] = {m, sign + n[1] * n[1] * k, -n[1]};
  const T on_u[3] = {s[0] * u[0] + s[3] * u[1] + s[5] * u[2],
                     s[3] * u[0] + s[1] * u[1] + s[4] * u[2],
                     s[5] * u[0] + s[4] * u[1] + s[2] * u[2]};
  Stress<2, T> turned;
  turned[0] = u[0] * on_u[0] + u[1] * on_u[1] + u[2] * on_u[2];
  turned[3] = v[0] * on_u[0] + v[1] * on_u[1] + v[2] * on_u[2];
  turned[2] = p + far * (third * scale);
  turned[1] = 3.0 * p - turned[0] - turned[2];
  const Stress<2, T> mapped = map_principal(turned, map);
  // u u^T + v v^T + n n^T = I spares the term of v v^T.
  const T along_u = 0.5 * (mapped[0] - mapped[1]), along_n = mapped[2] - mapped[1];
  T w[3], o[3];
  for (int i = 0; i < 3; ++i) w[i] = along_u * u[i] + mapped[3] * v[i], o[i] = along_n * n[i];
  Stress<3, T> out;
  for (int i = 0; i < 3; ++i) out[i] = mapped[1] + 2.0 * u[i] * w[i] + o[i] * n[i];
  out[3] = u[0] * w[1] + w[0] * u[1] + o[0] * n[1];
  out[4] = u[1] * w[2] + w[1] * u[2] + o[1] * n[2];
  out[5] = u[2] * w[0] + w[2] * u[0] + o[2] * n[0];
  return out;
}

}  // namespace flowslide
