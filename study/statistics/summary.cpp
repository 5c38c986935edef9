#include "study/statistics/summary.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::study {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? kUnset : sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kUnset;
  const double middle = mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - middle) * (v - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return kUnset;
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), values.size() - 1);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

Exceedance exceedance(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  Exceedance e;
  for (std::size_t i = 0; i < values.size(); ++i)
    e.share.push_back(1.0 - static_cast<double>(i + 1) / (n + 1.0));
  e.value = std::move(values);
  if (n > 0.0) e.band = std::sqrt(flowslide::log(2.0 / 0.05) / (2.0 * n));
  return e;
}

}  // namespace flowslide::study
