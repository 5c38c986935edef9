#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

/// Doubles that go through the same arithmetic, as many as one register of the target holds, on
/// GCC's and Clang's vector extension. Formulas written as templates over a number type T run on
/// double and on Pack; `select` takes the place of branches.
namespace flowslide {

#if defined(__AVX512F__)
inline constexpr int kPackLanes = 8;
#elif defined(__AVX__)
inline constexpr int kPackLanes = 4;
#else
inline constexpr int kPackLanes = 2;
#endif

struct Pack {
  static constexpr int lanes = kPackLanes;
  using Vector = double __attribute__((vector_size(sizeof(double) * kPackLanes)));
  Vector v;

  Pack() = default;
  Pack(double x) : v(x - Vector{}) {}
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
  using Vector = std::int64_t __attribute__((vector_size(sizeof(double) * kPackLanes)));
  Vector m;
  friend PackMask operator&&(PackMask a, PackMask b) { return {a.m & b.m}; }
  friend PackMask operator||(PackMask a, PackMask b) { return {a.m | b.m}; }
};

inline PackMask operator<(Pack a, Pack b) { return {a.v < b.v}; }
inline PackMask operator>(Pack a, Pack b) { return {a.v > b.v}; }
inline PackMask operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
inline PackMask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }

/// True in every lane.
inline bool all(PackMask c) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(__m512i(c.m)) == 0xff;
#else
  bool r = true;
  for (int i = 0; i < kPackLanes; ++i) r = r && c.m[i] != 0;
  return r;
#endif
}
inline bool all(bool c) { return c; }

inline Pack select(PackMask c, Pack a, Pack b) { return Pack(c.m ? a.v : b.v); }
inline double select(bool c, double a, double b) { return c ? a : b; }

inline Pack min(Pack a, Pack b) { return select(b < a, b, a); }
inline Pack max(Pack a, Pack b) { return select(a < b, b, a); }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }

// The vector extension has no square root, and a loop over lanes goes through memory.
inline Pack sqrt(Pack a) {
#if defined(__AVX512F__)
  return Pack(Pack::Vector(_mm512_mask_sqrt_pd(_mm512_setzero_pd(), 0xff, __m512d(a.v))));
#elif defined(__AVX__)
  return Pack(Pack::Vector(_mm256_sqrt_pd(__m256d(a.v))));
#else
  Pack r;
  for (int i = 0; i < Pack::lanes; ++i) r.v[i] = std::sqrt(a.v[i]);
  return r;
#endif
}
inline Pack floor(Pack a) {
#if defined(__AVX512F__)
  return Pack(
      Pack::Vector(_mm512_mask_roundscale_pd(_mm512_setzero_pd(), 0xff, __m512d(a.v), 0x01)));
#elif defined(__AVX__)
  return Pack(Pack::Vector(_mm256_floor_pd(__m256d(a.v))));
#else
  Pack r;
  for (int i = 0; i < Pack::lanes; ++i) r.v[i] = std::floor(a.v[i]);
  return r;
#endif
}
// The processor's estimates with Newton's steps would be cheaper, but estimates differ between
// processors; roots and divisions are exact on all.
inline Pack inverse_sqrt(Pack a) { return 1.0 / sqrt(a); }
inline double inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }
inline Pack reciprocal(Pack a) { return 1.0 / a; }
inline double reciprocal(double a) { return 1.0 / a; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double floor(double a) { return std::floor(a); }

/// Access to `count` (1 to `lanes`) neighbouring numbers; lanes beyond repeat the last one on
/// loading and are dropped on storing, so that the end of an array needs no padding.
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

/// from[index[0]], ..., from[index[lanes - 1]].
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

inline double max_lanes(double x) { return x; }
inline double max_lanes(Pack x) {
  double s = x.v[0];
  for (int i = 1; i < Pack::lanes; ++i) s = max(s, x.v[i]);
  return s;
}

/// Points that go through one operation on a T, and access to them as above.
template <class T>
inline constexpr int kLanes = 1;
template <>
inline constexpr int kLanes<Pack> = Pack::lanes;
template <class T>
T load_lanes(const double* from, int) {
  return *from;
}
template <>
inline Pack load_lanes<Pack>(const double* from, int count) {
  return load_pack(from, count);
}
inline void store_lanes(double* to, double x, int) { *to = x; }
inline void store_lanes(double* to, Pack x, int count) { store_pack(to, x, count); }
/// True in the first n lanes.
template <class T>
auto first_lanes(int n) {
  return n > 0;
}
template <>
inline auto first_lanes<Pack>(int n) {
  Pack lane;
  for (int i = 0; i < Pack::lanes; ++i) lane.v[i] = i;
  return lane < Pack(double(n));
}

}  // namespace flowslide
