#pragma once
#include "core/pack.hpp"

#include <array>
#include <cmath>

/// Stress and strain in Voigt form; order and signs in core/conventions.hpp.
/// `Stress` and `StrainIncrement` are different types so that the factor 2 of engineering shear
/// cannot cross from one to the other.
namespace flowslide {

template <int Dim>
inline constexpr int kVoigt = Dim == 2 ? 4 : 6;

/// `T` is double, or Pack for eight points at once.
template <int Dim, class T = double>
struct Stress {
  std::array<T, kVoigt<Dim>> v{};
  T& operator[](int i) { return v[i]; }
  const T& operator[](int i) const { return v[i]; }
  bool operator==(const Stress&) const = default;
};

template <int Dim, class T = double>
struct StrainIncrement {
  std::array<T, kVoigt<Dim>> v{};
  T& operator[](int i) { return v[i]; }
  const T& operator[](int i) const { return v[i]; }
};

/// Mean stress p = tr(sigma)/3, tension positive [Pa].
template <int Dim, class T>
constexpr T mean_stress(const Stress<Dim, T>& s) {
  return (s[0] + s[1] + s[2]) / 3.0;
}

/// Second deviatoric invariant J2 = 1/2 s:s [Pa2].
template <int Dim, class T>
constexpr T j2(const Stress<Dim, T>& s) {
  const T p = mean_stress(s);
  T sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += 0.5 * (s[i] - p) * (s[i] - p);
  for (int i = 3; i < kVoigt<Dim>; ++i) sum += s[i] * s[i];
  return sum;
}

/// Third deviatoric invariant J3 = det s [Pa3].
template <int Dim, class T>
constexpr T j3(const Stress<Dim, T>& sigma) {
  const T m = mean_stress(sigma), x = sigma[0] - m, y = sigma[1] - m, z = sigma[2] - m;
  if constexpr (Dim == 2) {
    return z * (x * y - sigma[3] * sigma[3]);
  } else {
    const T xy = sigma[3], yz = sigma[4], zx = sigma[5];
    return x * y * z + 2.0 * xy * yz * zx - x * yz * yz - y * zx * zx - z * xy * xy;
  }
}

/// Equivalent shear stress q = sqrt(3 J2) [Pa].
template <int Dim>
double equivalent_shear(const Stress<Dim>& s) {
  return std::sqrt(3.0 * j2(s));
}

/// eps_q = sqrt(2/3 e:e) of a strain with engineering shear; zz is taken as given.
template <int Dim>
double deviatoric_strain(const StrainIncrement<Dim>& e) {
  const double m = (e[0] + e[1] + e[2]) / 3.0;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += (e[i] - m) * (e[i] - m);
  for (int i = 3; i < kVoigt<Dim>; ++i) sum += 0.5 * e[i] * e[i];
  return std::sqrt(2.0 / 3.0 * sum);
}

}  // namespace flowslide
