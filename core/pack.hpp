#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

/// Doubles that go through the same arithmetic, `Pack` as many as one register of the target holds,
/// on GCC's and Clang's vector extension. Formulas written as templates over a number type T run on
/// double and on Pack; `select` takes the place of branches.
namespace flowslide {

#if defined(__AVX512F__)
inline constexpr int kPackLanes = 8;
#elif defined(__AVX__)
inline constexpr int kPackLanes = 4;
#else
inline constexpr int kPackLanes = 2;
#endif

/// Vectors of N doubles, and of whole numbers of their size. One by one, since g++ forgets a size
/// that hangs on a template parameter.
template <int N>
struct VectorOf;
template <>
struct VectorOf<2> {
  using Real = double __attribute__((vector_size(16)));
  using Whole = std::int64_t __attribute__((vector_size(16)));
  using Bits = std::uint64_t __attribute__((vector_size(16)));
};
template <>
struct VectorOf<4> {
  using Real = double __attribute__((vector_size(32)));
  using Whole = std::int64_t __attribute__((vector_size(32)));
  using Bits = std::uint64_t __attribute__((vector_size(32)));
};
template <>
struct VectorOf<8> {
  using Real = double __attribute__((vector_size(64)));
  using Whole = std::int64_t __attribute__((vector_size(64)));
  using Bits = std::uint64_t __attribute__((vector_size(64)));
};

template <int N>
struct PackOf;

/// Truth values of the lanes of a PackOf<N>.
template <int N>
struct MaskOf {
  using Vector = typename VectorOf<N>::Whole;
  Vector m;
  friend MaskOf operator&&(MaskOf a, MaskOf b) { return {a.m & b.m}; }
  friend MaskOf operator||(MaskOf a, MaskOf b) { return {a.m | b.m}; }
  friend MaskOf operator!(MaskOf a) { return {~a.m}; }
  friend PackOf<N> select(MaskOf c, PackOf<N> a, PackOf<N> b) { return PackOf<N>(c.m ? a.v : b.v); }
};

/// N doubles. Results do not hang on N: solvers take `Pack`, tests compare widths.
template <int N>
struct PackOf {
  static constexpr int lanes = N;
  using Vector = typename VectorOf<N>::Real;
  Vector v;

  PackOf() = default;
  PackOf(double x) : v(x - Vector{}) {}
  explicit PackOf(Vector x) : v(x) {}
  double operator[](int i) const { return v[i]; }

  friend PackOf operator+(PackOf a, PackOf b) { return PackOf(a.v + b.v); }
  friend PackOf operator-(PackOf a, PackOf b) { return PackOf(a.v - b.v); }
  friend PackOf operator*(PackOf a, PackOf b) { return PackOf(a.v * b.v); }
  friend PackOf operator/(PackOf a, PackOf b) { return PackOf(a.v / b.v); }
  friend PackOf operator-(PackOf a) { return PackOf(-a.v); }
  PackOf& operator+=(PackOf b) { return *this = *this + b; }
  PackOf& operator-=(PackOf b) { return *this = *this - b; }
  PackOf& operator*=(PackOf b) { return *this = *this * b; }

  friend MaskOf<N> operator<(PackOf a, PackOf b) { return {a.v < b.v}; }
  friend MaskOf<N> operator>(PackOf a, PackOf b) { return {a.v > b.v}; }
  friend MaskOf<N> operator<=(PackOf a, PackOf b) { return {a.v <= b.v}; }
  friend MaskOf<N> operator>=(PackOf a, PackOf b) { return {a.v >= b.v}; }

  friend PackOf min(PackOf a, PackOf b) { return select(b < a, b, a); }
  friend PackOf max(PackOf a, PackOf b) { return select(a < b, b, a); }
  friend PackOf abs(PackOf a) {
    using Whole = typename VectorOf<N>::Whole;
    return PackOf(Vector(Whole(a.v) & (INT64_MAX - Whole{})));
  }
  // The vector extension has no square root, and a loop over lanes goes through memory.
  friend PackOf sqrt(PackOf a) {
#if defined(__AVX512F__)
    if constexpr (N == 8)
      return PackOf(Vector(_mm512_mask_sqrt_pd(_mm512_setzero_pd(), 0xff, __m512d(a.v))));
#endif
#if defined(__AVX__)
    if constexpr (N == 4) return PackOf(Vector(_mm256_sqrt_pd(__m256d(a.v))));
#endif
    for (int i = 0; i < N; ++i) a.v[i] = std::sqrt(a.v[i]);
    return a;
  }
  friend PackOf floor(PackOf a) {
#if defined(__AVX512F__)
    if constexpr (N == 8)
      return PackOf(
          Vector(_mm512_mask_roundscale_pd(_mm512_setzero_pd(), 0xff, __m512d(a.v), 0x01)));
#endif
#if defined(__AVX__)
    if constexpr (N == 4) return PackOf(Vector(_mm256_floor_pd(__m256d(a.v))));
#endif
    for (int i = 0; i < N; ++i) a.v[i] = std::floor(a.v[i]);
    return a;
  }
  // The processor's estimates with Newton's steps would be cheaper, but estimates differ between
  // processors; roots and divisions are exact on all.
  friend PackOf inverse_sqrt(PackOf a) { return 1.0 / sqrt(a); }
  friend PackOf reciprocal(PackOf a) { return 1.0 / a; }
};
using Pack = PackOf<kPackLanes>;
using PackMask = MaskOf<kPackLanes>;

/// The lanes where the mask is true, lane 0 as the lowest bit.
template <int N>
unsigned bits(MaskOf<N> c) {
#if defined(__AVX512DQ__)
  if constexpr (N == 8) return _mm512_movepi64_mask(__m512i(c.m));
#endif
#if defined(__AVX__)
  if constexpr (N == 4) return _mm256_movemask_pd(__m256d(c.m));
#endif
  unsigned r = 0;
  for (int i = 0; i < N; ++i) r |= (c.m[i] != 0 ? 1u : 0u) << i;
  return r;
}
inline unsigned bits(bool c) { return c ? 1u : 0u; }

/// True in every lane, or in any.
template <int N>
bool all(MaskOf<N> c) {
  return bits(c) == (1u << N) - 1u;
}
inline bool all(bool c) { return c; }
template <int N>
bool any(MaskOf<N> c) {
  return bits(c) != 0;
}
inline bool any(bool c) { return c; }

inline double select(bool c, double a, double b) { return c ? a : b; }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline double abs(double a) { return std::abs(a); }
inline double inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }
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

/// The same for `count` indices; lanes beyond are 0, and no index beyond is read: another thread
/// may be writing it.
inline Pack gather_pack(const double* from, const std::int32_t* index, int count) {
  if (count == Pack::lanes) return gather_pack(from, index);
  Pack r = 0.0;
  for (int i = 0; i < count; ++i) r.v[i] = from[index[i]];
  return r;
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
template <int N>
inline constexpr int kLanes<PackOf<N>> = N;
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
