#include "study/numbers/distribution.hpp"

#include "core/elementary.hpp"
#include "study/numbers/normal.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::study {
namespace {

double triangular(const Distribution& d, double u) {
  const double width = d.to - d.from, at_mode = (d.mode - d.from) / width;
  if (u < at_mode) return d.from + std::sqrt(u * width * (d.mode - d.from));
  return d.to - std::sqrt((1.0 - u) * width * (d.to - d.mode));
}

/// Mean and deviation of the normal number, which for the lognormal is the logarithm.
struct Scale {
  double mean, deviation;
};

Scale scale(const Distribution& d) {
  if (d.shape == Shape::normal) return {d.mean, d.deviation};
  const double ratio = d.deviation / d.mean;
  const double variance = flowslide::log(1.0 + ratio * ratio);
  return {flowslide::log(d.mean) - 0.5 * variance, std::sqrt(variance)};
}

double below(const Distribution& d, double x) {
  if (std::isinf(x)) return x > 0.0 ? 1.0 : 0.0;
  const Scale s = scale(d);
  if (d.shape == Shape::lognormal) {
    if (x <= 0.0) return 0.0;
    x = flowslide::log(x);
  }
  return normal_probability((x - s.mean) / s.deviation);
}

/// Not every pair of numbers has a logarithm's mean and deviation, or quantiles that are numbers.
void check_scale(const Distribution& d) {
  const Scale s = scale(d);
  validate(
      std::isfinite(s.mean) && std::isfinite(s.deviation),
      "mean {:g}, deviation {:g} (their ratio is so large that the logarithm of the number has "
      "no finite deviation) are both in the same unit?",
      d.mean, d.deviation);
  validate(s.deviation > 0.0,
           "mean {:g}, deviation {:g} (the deviation is lost in the digits of the mean: all rows "
           "would have one number) give a larger one",
           d.mean, d.deviation);
}

/// The ends of what is drawn: samplings take no probability nearer to 0 and 1.
void check_ends(const Distribution& d) {
  constexpr double kEnd = 0x1p-33;
  const double low = quantile(d, kEnd), high = quantile(d, 1.0 - kEnd);
  validate(std::isfinite(low) && std::isfinite(high),
           "would draw numbers from {:g} to {:g} (larger ones than the machine has) give smaller "
           "ones, or 'max' where there is one",
           low, high);
  validate(low < high,
           "would draw {:g} only (the spread is lost in the digits of the number) widen it", low);
}

}  // namespace

void check(const Distribution& d) {
  if (d.shape == Shape::uniform || d.shape == Shape::triangular) {
    validate(d.from < d.to, "from {:g} to {:g} (there is nothing between) give from < to", d.from,
             d.to);
    validate(d.shape == Shape::uniform || (d.mode >= d.from && d.mode <= d.to),
             "mode {:g} is outside {:g} to {:g} (it is the likeliest value) give one inside",
             d.mode, d.from, d.to);
    check_ends(d);
    return;
  }
  validate(
      std::isfinite(d.mean) && std::isfinite(d.deviation) && d.deviation > 0.0,
      "mean {:g}, deviation {:g} (a number without spread is no input) give a deviation above 0",
      d.mean, d.deviation);
  validate(d.shape == Shape::normal || d.mean > 0.0,
           "mean {:g} (a lognormal number is positive) give a mean above 0", d.mean);
  check_scale(d);
  validate(d.min < d.max && below(d, d.max) - below(d, d.min) > 1e-6,
           "min {:g}, max {:g} (hardly any of the distribution lies between) widen them", d.min,
           d.max);
  check_ends(d);
}

double quantile(const Distribution& d, double u) {
  if (d.shape == Shape::uniform) return d.from + u * (d.to - d.from);
  if (d.shape == Shape::triangular) return triangular(d, u);
  const double low = below(d, d.min), high = below(d, d.max);
  const Scale s = scale(d);
  // The ends of a cut distribution can round to 0 and 1, where there is no quantile.
  const double p = std::clamp(low + u * (high - low), 1e-300, 1.0 - 0x1p-53);
  const double z = s.mean + s.deviation * normal_quantile(p);
  return std::clamp(d.shape == Shape::lognormal ? flowslide::exp(z) : z, d.min, d.max);
}

}  // namespace flowslide::study
