#pragma once
#include "core/voigt.hpp"

#include <array>

/// Corotational part of the stress update: sigma -> R sigma R^T with R from the spin W = (L -
/// L^T)/2 by the mid-point rule (Hughes & Winget 1980, IJNME 15), exactly orthogonal, second order
/// in dt.
namespace flowslide::mpm {

/// `spin_dt` is W_yx dt, the in-plane rotation angle of the step, counter-clockwise [rad].
template <class T>
Stress<2, T> rotate(const Stress<2, T>& s, const T& spin_dt) noexcept {
  const T t = 0.5 * spin_dt, denominator = reciprocal(1.0 + t * t);
  const T c = (1.0 - t * t) * denominator, n = 2.0 * t * denominator;
  const T cc = c * c, nn = n * n, cn = c * n;
  Stress<2, T> r;
  r[0] = cc * s[0] + nn * s[1] - 2.0 * cn * s[3];
  r[1] = nn * s[0] + cc * s[1] + 2.0 * cn * s[3];
  r[2] = s[2];
  r[3] = cn * (s[0] - s[1]) + (cc - nn) * s[3];
  return r;
}

/// `w` is the rotation vector of the step (x, y, z components) [rad].
template <class T>
Stress<3, T> rotate(const Stress<3, T>& s, const std::array<T, 3>& w) noexcept {
  // Cayley transform of the skew matrix of w, written for a vector a = w / 2.
  const T ax = 0.5 * w[0], ay = 0.5 * w[1], az = 0.5 * w[2];
  const T k = 2.0 * reciprocal(1.0 + (ax * ax + ay * ay + az * az));
  const T r[3][3] = {{1.0 - k * (ay * ay + az * az), k * (ax * ay - az), k * (ax * az + ay)},
                     {k * (ax * ay + az), 1.0 - k * (ax * ax + az * az), k * (ay * az - ax)},
                     {k * (ax * az - ay), k * (ay * az + ax), 1.0 - k * (ax * ax + ay * ay)}};
  const T m[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  T t[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t[i][j] = r[i][0] * m[0][j] + r[i][1] * m[1][j] + r[i][2] * m[2][j];
  const auto out = [&](int i, int j) {
    return t[i][0] * r[j][0] + t[i][1] * r[j][1] + t[i][2] * r[j][2];
  };
  Stress<3, T> rotated;
  rotated.v = {out(0, 0), out(1, 1), out(2, 2), out(0, 1), out(1, 2), out(0, 2)};
  return rotated;
}

/// Rotation of the step that belongs to a velocity gradient (row-major).
template <int Dim, class T>
Stress<Dim, T> rotate_by_spin(const Stress<Dim, T>& s, const std::array<T, Dim * Dim>& l,
                              double dt) noexcept {
  if constexpr (Dim == 2) {
    return rotate(s, T((l[2] - l[1]) * (0.5 * dt)));
  } else {
    return rotate(s, std::array<T, 3>{0.5 * dt * (l[7] - l[5]), 0.5 * dt * (l[2] - l[6]),
                                      0.5 * dt * (l[3] - l[1])});
  }
}

/// Strain of the step; `volumetric_shift` is added to each normal component, zz included.
template <int Dim, class T>
StrainIncrement<Dim, T> strain_increment(const std::array<T, Dim * Dim>& l, T volumetric_shift,
                                         double dt) noexcept {
  StrainIncrement<Dim, T> de;
  if constexpr (Dim == 2) {
    de[0] = l[0] * dt + volumetric_shift;
    de[1] = l[3] * dt + volumetric_shift;
    de[2] = volumetric_shift;
    de[3] = (l[1] + l[2]) * dt;
  } else {
    de[0] = l[0] * dt + volumetric_shift;
    de[1] = l[4] * dt + volumetric_shift;
    de[2] = l[8] * dt + volumetric_shift;
    de[3] = (l[1] + l[3]) * dt;
    de[4] = (l[5] + l[7]) * dt;
    de[5] = (l[2] + l[6]) * dt;
  }
  return de;
}

}  // namespace flowslide::mpm
