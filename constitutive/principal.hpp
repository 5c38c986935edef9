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
  const T scale = select(radius > T(0.0), 0.5 * (new_a - new_b) / radius, T(0.0));
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

/// The same for the lanes of a Pack: cyclic Jacobi without branches in the lanes. Three
/// sweeps reach round-off for most matrices, five for all.
template <class Map>
[[nodiscard]] Stress<3, Pack> map_principal(const Stress<3, Pack>& s, Map&& map) noexcept {
  Pack a[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  Pack v[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};  // eigenvectors in rows
  const auto turn = [&](int p, int q) __attribute__((always_inline)) {
    const int r = 3 - p - q;
    // From the double angle; the tiny numbers make it zero where all is zero.
    const Pack gap = a[q][q] - a[p][p], twice = 2.0 * a[p][q];
    const Pack inverse = inverse_sqrt(gap * gap + twice * twice + 1e-280);
    const auto negative = gap < Pack(0.0);
    const Pack cosine = (select(negative, -gap, gap) + 1e-140) * inverse;
    const Pack sine = select(negative, -twice, twice) * inverse;
    const Pack square = 0.5 + 0.5 * cosine, secant = inverse_sqrt(square);
    const Pack c = square * secant, sn = 0.5 * sine * secant, t = sn * secant;
    const Pack shift = t * a[p][q];
    a[p][p] -= shift;
    a[q][q] += shift;
    a[p][q] = a[q][p] = 0.0;
    const Pack x = a[p][r], y = a[q][r];
    a[p][r] = a[r][p] = c * x - sn * y;
    a[q][r] = a[r][q] = sn * x + c * y;
    for (int k = 0; k < 3; ++k) {
      const Pack vp = v[p][k], vq = v[q][k];
      v[p][k] = c * vp - sn * vq;
      v[q][k] = sn * vp + c * vq;
    }
  };
  const auto diagonal = [&]() __attribute__((always_inline)) {
    const Pack off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
    const Pack on = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
    return all(off <= 1e-31 * on);
  };
  for (int sweep = 0; sweep < 5; ++sweep) {
    if (sweep > 1 && diagonal()) break;
    turn(0, 1);
    turn(0, 2);
    turn(1, 2);
  }
  const auto order = [&](int i, int j) __attribute__((always_inline)) {
    const auto swap = a[i][i] < a[j][j];
    const Pack hi = select(swap, a[j][j], a[i][i]), lo = select(swap, a[i][i], a[j][j]);
    a[i][i] = hi;
    a[j][j] = lo;
    for (int k = 0; k < 3; ++k) {
      const Pack first = select(swap, v[j][k], v[i][k]), second = select(swap, v[i][k], v[j][k]);
      v[i][k] = first;
      v[j][k] = second;
    }
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  const Sorted3<Pack> r = map(Sorted3<Pack>{a[0][0], a[1][1], a[2][2]});
  const Pack mapped[3] = {r.hi, r.mid, r.lo};
  Stress<3, Pack> out;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 3; ++i) out[k] += mapped[i] * (v[i][row[k]] * v[i][column[k]]);
  return out;
}

}  // namespace flowslide
