#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Eight doubles that go through the same arithmetic, on GCC's and Clang's vector extension.
/// Formulas written as templates over a number type T run on double and on Pack; `select` takes the
/// place of branches. One AVX-512 register, two AVX registers or four SSE ones, as the target has
/// them.
namespace flowslide {

struct Pack {
  static constexpr int lanes = 8;
  using Vector = double __attribute__((vector_size(64)));
  Vector v;

  Pack() = default;
  Pack(double x) : v{x, x, x, x, x, x, x, x} {}
  explicit Pack(Vector x) : v(x) {}
  double operator[](int i) const { return v[i]; }

  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
};

/// Truth values of the lanes of a Pack.
struct PackMask {
  using Vector = std::int64_t __attribute__((vector_size(64)));
  Vector m;
  friend PackMask operator&&(PackMask a, PackMask b) { return {a.m & b.m}; }
  friend PackMask operator||(PackMask a, PackMask b) { return {a.m | b.m}; }
};

inline PackMask operator<(Pack a, Pack b) { return {a.v < b.v}; }
inline PackMask operator>(Pack a, Pack b) { return {a.v > b.v}; }
inline PackMask operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
inline PackMask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }

inline Pack select(PackMask c, Pack a, Pack b) { return Pack(c.m ? a.v : b.v); }
inline double select(bool c, double a, double b) { return c ? a : b; }

inline Pack min(Pack a, Pack b) { return select(b < a, b, a); }
inline Pack max(Pack a, Pack b) { return select(a < b, b, a); }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }

inline Pack sqrt(Pack a) {
  Pack r;
  for (int i = 0; i < Pack::lanes; ++i) r.v[i] = std::sqrt(a.v[i]);
  return r;
}
inline Pack floor(Pack a) {
  Pack r;
  for (int i = 0; i < Pack::lanes; ++i) r.v[i] = std::floor(a.v[i]);
  return r;
}
inline double sqrt(double a) { return std::sqrt(a); }
inline double floor(double a) { return std::floor(a); }

/// Access to `count` (1 to 8) neighbouring numbers; lanes beyond repeat the last one on loading and
/// are dropped on storing, so that the end of an array needs no padding.
inline Pack load_pack(const double* from, int count) {
  Pack r;
  if (count == Pack::lanes) {
    std::memcpy(&r.v, from, sizeof r.v);
  } else {
    for (int i = 0; i < Pack::lanes; ++i) r.v[i] = from[i < count ? i : count - 1];
  }
  return r;
}
inline void store_pack(double* to, Pack x, int count) {
  if (count == Pack::lanes) {
    std::memcpy(to, &x.v, sizeof x.v);
  } else {
    for (int i = 0; i < count; ++i) to[i] = x.v[i];
  }
}

/// from[index[0]], ..., from[index[7]].
inline Pack gather_pack(const double* from, const std::int32_t* index) {
#if defined(__AVX512F__)
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  return Pack(Pack::Vector(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, at, from, 8)));
#else
  Pack r;
  for (int i = 0; i < Pack::lanes; ++i) r.v[i] = from[index[i]];
  return r;
#endif
}

/// Sum of the first `count` lanes, in lane order.
inline double sum_lanes(Pack x, int count) {
  double s = 0.0;
  for (int i = 0; i < count; ++i) s += x.v[i];
  return s;
}
inline double sum_lanes(double x, int) { return x; }
inline double max_lanes(double x) { return x; }
inline double max_lanes(Pack x) {
  double s = x.v[0];
  for (int i = 1; i < Pack::lanes; ++i) s = max(s, x.v[i]);
  return s;
}

}  // namespace flowslide
