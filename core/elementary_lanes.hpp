#pragma once
#include "core/elementary.hpp"
#include "core/pack.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

/// exp and log of a T, double or lanes of them. The functions of core/elementary.hpp are these, so
/// that a lane has the bits of a double.
namespace flowslide {

/// A number as the sum of two, the second at most half a unit in the last place of the first.
struct TwoParts {
  double high, low;
};

namespace elementary {

// ln 2 in two parts; the first has 32 bits, so that its products with exponents are exact.
inline constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Added to a number below 2^51 it leaves the nearest integer in the lowest bits.
inline constexpr double kRound = 0x1.8p52;

/// Parts of a power of two into which exp divides its argument.
inline constexpr int kSteps = 64;
extern const std::array<TwoParts, kSteps> kRoots;  ///< 2^(i/kSteps)

/// The bits of a T as whole numbers.
inline std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
inline double from_bits(std::uint64_t x) { return std::bit_cast<double>(x); }
template <int N>
typename VectorOf<N>::Bits bits_of(PackOf<N> x) {
  return typename VectorOf<N>::Bits(x.v);
}
template <class Bits>
auto from_bits(Bits x) {
  constexpr int n = sizeof(Bits) / sizeof(double);
  return PackOf<n>(typename PackOf<n>::Vector(x));
}

template <class T>
struct Root {
  T high, low;
};
inline Root<double> root_at(std::uint64_t i) { return {kRoots[i].high, kRoots[i].low}; }
template <class Bits>
auto root_at(Bits index) {
  constexpr int n = sizeof(Bits) / sizeof(double);
  Root<PackOf<n>> r;
#if defined(__AVX512F__)
  if constexpr (n == 8) {
    const double* from = &kRoots[0].high;
    const __m512i at = __m512i(index + index);
    const __m512d zero = _mm512_setzero_pd();
    r.high.v = _mm512_mask_i64gather_pd(zero, 0xff, at, from, 8);
    r.low.v = _mm512_mask_i64gather_pd(zero, 0xff, at, from + 1, 8);
    return r;
  }
#endif
  for (int k = 0; k < n; ++k) {
    r.high.v[k] = kRoots[index[k]].high;
    r.low.v[k] = kRoots[index[k]].low;
  }
  return r;
}

/// e^(x + c) = m 2^(n/kSteps), n a multiple of kSteps, 1 <= m < 2, for a c that is small against x.
template <class T>
struct Scaled {
  T m;
  decltype(bits_of(T())) n;  ///< in the lowest bits
};
template <class T>
Scaled<T> scaled_exp(T x, T c) noexcept {
  constexpr double kStepsOverLn2 = kSteps * 0x1.71547652b82fep+0;
  // x = n ln 2/kSteps + r, |r| < 0.0055
  const T shifted = x * T(kStepsOverLn2) + T(kRound), n = shifted - T(kRound);
  const T high = x - n * T(kLn2High / kSteps), low = n * T(kLn2Low / kSteps) - c;
  const T r = high - low, r2 = r * r;
  const T series =
      r + r2 * ((0.5 + r * T(1.0 / 6)) + r2 * ((1.0 / 24 + r * T(1.0 / 120)) + r2 * T(1.0 / 720)));
  const auto whole = bits_of(shifted), step = whole & (kSteps - 1);
  const Root<T> root = root_at(step);
  return {root.high + (root.low + root.high * series), whole - step};
}

/// The same where powers of two overflow or are subnormal.
double exp_far(double x, double c) noexcept;
template <int N>
[[gnu::noinline]] PackOf<N> exp_far(PackOf<N> x, PackOf<N> c) noexcept;

/// e^(x + c) for a c that is small against x.
template <class T>
T exp_of_sum(T x, T c) noexcept {
  constexpr double kPlain = 708.0;
  if (!all(x < T(kPlain) && x > T(-kPlain))) return exp_far(x, c);
  const Scaled<T> s = scaled_exp(x, c);
  constexpr int kToExponent = 52 - 6;  // the last 6 bits of n count kSteps
  return s.m * from_bits((s.n << kToExponent) + (std::uint64_t{1023} << 52));
}

/// x = 2^exponent m with m between sqrt(1/2) and sqrt(2), for x > 0.
template <class T>
struct Parts {
  T m, exponent;
};
template <class T>
Parts<T> parts(T x) {
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // bits of sqrt(1/2)
  constexpr std::uint64_t kAbove = 1100;                   // makes every exponent positive
  const auto subnormal = x < T(0x1p-1022);
  const T scaled = select(subnormal, x * T(0x1p54), x), shift = select(subnormal, T(-54.0), T(0.0));
  const auto bits = bits_of(scaled);
  const auto n = (bits - kRootHalf + (kAbove << 52)) >> 52;
  const T exponent = from_bits(n + (std::uint64_t{0x433} << 52)) - T(0x1p52 + kAbove);
  return {from_bits(bits - ((n - kAbove) << 52)), exponent + shift};
}

/// log(x) for 0 < x < infinity; without meaning elsewhere.
template <class T>
T log_inside(T x) noexcept {
  const auto [m, n] = parts(x);
  // log m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1)/(m + 1), |s| < 0.172; the first term is
  // f - f^2/2 + ..., whose f = m - 1 is exact
  const T f = m - 1.0, s = f / (2.0 + f);
  const T z = s * s, z2 = z * z, z4 = z2 * z2;
  const T a = (2.0 / 3 + z * T(2.0 / 5)) + z2 * (2.0 / 7 + z * T(2.0 / 9));
  const T b = (2.0 / 11 + z * T(2.0 / 13)) + z2 * (2.0 / 15 + z * T(2.0 / 17));
  const T c = (2.0 / 19 + z * T(2.0 / 21)) + z2 * T(2.0 / 23);
  const T series = z * (a + z4 * (b + z4 * c)), half_square = 0.5 * f * f;
  return n * T(kLn2High) - ((half_square - (s * (half_square + series) + n * T(kLn2Low))) - f);
}

}  // namespace elementary

template <int N>
PackOf<N> exp(PackOf<N> x) noexcept {
  return elementary::exp_of_sum(x, PackOf<N>(0.0));
}
template <int N>
PackOf<N> log(PackOf<N> x) noexcept {
  using elementary::kInfinity, elementary::kNan;
  const PackOf<N> r = elementary::log_inside(x);
  const auto inside = x > PackOf<N>(0.0) && x < PackOf<N>(kInfinity);
  if (all(inside)) return r;
  const auto zero = x >= PackOf<N>(0.0) && x <= PackOf<N>(0.0);
  const PackOf<N> beyond = select(x > PackOf<N>(0.0), x, PackOf<N>(kNan));
  return select(inside, r, select(zero, PackOf<N>(-kInfinity), beyond));
}

namespace elementary {
template <int N>
PackOf<N> exp_far(PackOf<N> x, PackOf<N> c) noexcept {
  for (int i = 0; i < N; ++i) x.v[i] = exp_of_sum(x.v[i], c.v[i]);
  return x;
}
}  // namespace elementary

}  // namespace flowslide
