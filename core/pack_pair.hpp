#pragma once
#include "core/pack.hpp"

#include <algorithm>
#include <array>

/// Two Packs that go through the same arithmetic side by side. A long chain of operations that
/// depend on each other leaves the processor waiting for each; two chains fill the gaps.
namespace flowslide {

struct PackPair {
  static constexpr int lanes = 2 * Pack::lanes;
  Pack a, b;

  PackPair() = default;
  PackPair(double x) : a(x), b(x) {}
  PackPair(Pack first, Pack second) : a(first), b(second) {}

  friend PackPair operator+(PackPair x, PackPair y) { return {x.a + y.a, x.b + y.b}; }
  friend PackPair operator-(PackPair x, PackPair y) { return {x.a - y.a, x.b - y.b}; }
  friend PackPair operator*(PackPair x, PackPair y) { return {x.a * y.a, x.b * y.b}; }
  friend PackPair operator/(PackPair x, PackPair y) { return {x.a / y.a, x.b / y.b}; }
  friend PackPair operator-(PackPair x) { return {-x.a, -x.b}; }
  PackPair& operator+=(PackPair y) { return *this = *this + y; }
  PackPair& operator-=(PackPair y) { return *this = *this - y; }
  PackPair& operator*=(PackPair y) { return *this = *this * y; }
};

struct PackPairMask {
  PackMask a, b;
  friend PackPairMask operator&&(PackPairMask x, PackPairMask y) {
    return {x.a && y.a, x.b && y.b};
  }
  friend PackPairMask operator||(PackPairMask x, PackPairMask y) {
    return {x.a || y.a, x.b || y.b};
  }
};

inline PackPairMask operator<(PackPair x, PackPair y) { return {x.a < y.a, x.b < y.b}; }
inline PackPairMask operator>(PackPair x, PackPair y) { return {x.a > y.a, x.b > y.b}; }
inline PackPairMask operator<=(PackPair x, PackPair y) { return {x.a <= y.a, x.b <= y.b}; }
inline PackPairMask operator>=(PackPair x, PackPair y) { return {x.a >= y.a, x.b >= y.b}; }
inline bool all(PackPairMask c) { return all(c.a) && all(c.b); }
inline PackPair select(PackPairMask c, PackPair x, PackPair y) {
  return {select(c.a, x.a, y.a), select(c.b, x.b, y.b)};
}
inline PackPair min(PackPair x, PackPair y) { return {min(x.a, y.a), min(x.b, y.b)}; }
inline PackPair max(PackPair x, PackPair y) { return {max(x.a, y.a), max(x.b, y.b)}; }
inline PackPair sqrt(PackPair x) { return {sqrt(x.a), sqrt(x.b)}; }
inline PackPair floor(PackPair x) { return {floor(x.a), floor(x.b)}; }
inline PackPair inverse_sqrt(PackPair x) { return {inverse_sqrt(x.a), inverse_sqrt(x.b)}; }
inline PackPair reciprocal(PackPair x) { return {reciprocal(x.a), reciprocal(x.b)}; }

template <>
inline constexpr int kLanes<PackPair> = PackPair::lanes;
template <>
inline PackPair load_lanes<PackPair>(const double* from, int count) {
  const int rest = count - Pack::lanes;
  const Pack first = load_pack(from, std::min(count, Pack::lanes));
  return {first, rest > 0 ? load_pack(from + Pack::lanes, rest) : load_pack(from + count - 1, 1)};
}
inline void store_lanes(double* to, PackPair x, int count) {
  store_pack(to, x.a, std::min(count, Pack::lanes));
  if (count > Pack::lanes) store_pack(to + Pack::lanes, x.b, count - Pack::lanes);
}
template <>
inline auto first_lanes<PackPair>(int n) {
  return PackPairMask{first_lanes<Pack>(n), first_lanes<Pack>(n - Pack::lanes)};
}
inline double max_lanes(PackPair x) { return max(max_lanes(x.a), max_lanes(x.b)); }

/// A sum over neighbouring points, kLanes<T> at a time, whose order of additions is the same for
/// every width of registers: as many partial sums as the widest has lanes.
template <class T>
class OrderedSum {
 public:
  void add(T x) {
    part_[next_] += x;
    next_ = (next_ + 1) % kParts;
  }
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const T& x : part_) {
      double lane[kLanes<T>];
      store_lanes(lane, x, kLanes<T>);
      for (const double value : lane) sum += value;
    }
    return sum;
  }

 private:
  static constexpr int kWidest = kLanes<T> == 1 ? 1 : 8 * kLanes<T> / Pack::lanes;
  static constexpr int kParts = kWidest / kLanes<T>;
  std::array<T, kParts> part_ = [] {
    std::array<T, kParts> zero;
    zero.fill(T(0.0));
    return zero;
  }();
  int next_ = 0;
};

}  // namespace flowslide
