#pragma once
#include "core/voigt.hpp"

#include <algorithm>
#include <cmath>

/// Principal stresses, and an isotropic function of stress applied in principal axes.
namespace flowslide {

/// Largest, middle and smallest of three without rounding.
struct Sorted3 {
  double hi, mid, lo;
};
[[nodiscard]] inline Sorted3 sort3(double a, double b, double c) noexcept {
  const double hi_ab = std::max(a, b), lo_ab = std::min(a, b);
  return {std::max(hi_ab, c), std::max(lo_ab, std::min(hi_ab, c)), std::min(lo_ab, c)};
}

/// Plane strain: zz is a principal stress; the in-plane pair from Mohr's circle. `map` takes and
/// returns {s1, s2, s3} sorted and must keep the order.
template <class Map>
[[nodiscard]] Stress<2> map_principal(const Stress<2>& s, Map&& map) noexcept {
  const double centre = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const double radius = std::sqrt(half * half + s[3] * s[3]);
  const double a = centre + radius, b = centre - radius, z = s[2];
  const Sorted3 t = sort3(a, b, z);
  const Sorted3 r = map(t);
  const bool z_high = z > a, z_low = z < b;
  const double new_a = z_high ? r.mid : r.hi;
  const double new_b = z_low ? r.mid : r.lo;
  const double new_z = z_high ? r.hi : (z_low ? r.lo : r.mid);
  const double new_centre = 0.5 * (new_a + new_b);
  const double scale = radius > 0.0 ? 0.5 * (new_a - new_b) / radius : 0.0;
  Stress<2> out;
  out[0] = new_centre + scale * half;
  out[1] = new_centre - scale * half;
  out[2] = new_z;
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
  const Sorted3 r = map(Sorted3{e.value[order[0]], e.value[order[1]], e.value[order[2]]});
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

}  // namespace flowslide
