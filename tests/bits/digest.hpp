#pragma once
#include "core/hash.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace flowslide {

/// Digest of numbers. Every NaN counts as the same, since processors and compilers choose its bits.
class Digest {
 public:
  void add(double x) {
    if (std::isnan(x)) x = std::numeric_limits<double>::quiet_NaN();
    hash_.add(&x, sizeof x);
  }
  template <class T>
  void add(std::span<const T> numbers) {
    for (const T& x : numbers) add(x);
  }
  template <class T>
  void add(const std::vector<T>& numbers) {
    add(std::span<const T>(numbers));
  }
  template <std::size_t N>
  void add(const std::array<double, N>& numbers) {
    for (const double x : numbers) add(x);
  }
  template <class V>
  requires requires(V x) { x.v.size(); }
  void add(const V& components) { add(components.v); }
  void add(std::int64_t x) { hash_.add(&x, sizeof x); }
  void add(std::int32_t x) { add(std::int64_t{x}); }
  /// 16 hexadecimal digits; once.
  std::string text() { return hash_.hex().substr(0, 16); }

 private:
  Sha256 hash_;
};

}  // namespace flowslide
