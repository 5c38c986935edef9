#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

/// Random numbers that are the same bits on every machine. docs/theory/study-statistics.md
namespace flowslide::study {

/// SplitMix64 (Steele, Lea and Flood 2014): 2^64 numbers before it repeats.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Numbers of one purpose do not hang on how many another one has drawn.
  Random(std::uint64_t seed, std::uint64_t stream);

  std::uint64_t next();
  /// Inside (0, 1), a multiple of 2^-53 less half of it.
  double uniform();
  /// 0 to n - 1, all equally likely; n > 0.
  std::size_t below(std::size_t n);
  /// 0 to n - 1 in random order.
  std::vector<std::size_t> permutation(std::size_t n);

 private:
  std::uint64_t state_;
};

}  // namespace flowslide::study
