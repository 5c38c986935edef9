#pragma once
#include "core/check.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace flowslide::study {

/// A number with the interval that holds it in 95 % of the resamples.
struct Estimate {
  double value = kUnset, low = kUnset, high = kUnset;
  std::size_t rows = 0;
};

/// How resamples are drawn: equal seeds give equal ones.
struct Resampling {
  std::uint64_t seed = 1;
  const std::atomic<bool>* stop = nullptr;  ///< polled for each resample
  /// Unit of each row: rows of a unit come and go together. Empty: each row is one.
  std::vector<std::size_t> units;
  /// Stratum of each row, that of its unit's first row: units are drawn within theirs. Empty: one.
  std::vector<std::size_t> strata;
  // Most have nothing but a seed.
  Resampling(std::uint64_t s, const std::atomic<bool>* stop_requested = nullptr)  // NOLINT
      : seed(s), stop(stop_requested) {}
};

inline constexpr std::size_t kResamples = 1000;

/// A statistic of rows, given as the list of their numbers, of which some may occur several times.
using Statistic = std::function<double(const std::vector<std::size_t>& rows)>;

/// Percentile bootstrap (Efron 1979): rows, or what units of them there are, are drawn with
/// repetition as often as there are any.
/// Resamples in which the statistic is NaN are left out; without half of them there is no interval.
Estimate bootstrap(std::size_t rows, const Resampling& how, const Statistic& statistic);

/// The statistic in each resample. Throws Interrupted once how.stop is set.
std::vector<double> resampled(std::size_t rows, const Resampling& how, const Statistic& statistic);

}  // namespace flowslide::study
