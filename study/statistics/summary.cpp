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

Exceedance exceedance(std::vector<Weighted> values) {
  std::stable_sort(values.begin(), values.end(),
                   [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double rows = 0.0, up_to_here = 0.0;
  for (const Weighted& v : values) rows += v.weight;
  Exceedance e;
  for (const Weighted& v : values) {
    up_to_here += v.weight;
    e.value.push_back(v.value);
    e.weight.push_back(v.weight);
    e.share.push_back(1.0 - up_to_here / (rows + 1.0));
  }
  if (rows > 0.0) e.band = std::sqrt(flowslide::log(2.0 / 0.05) / (2.0 * rows));
  return e;
}

double weighted_quantile(const Exceedance& e, double share) {
  const std::size_t n = e.value.size();
  if (n == 0) return kUnset;
  double all = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) all += e.weight[i];
  double before = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double wanted = share * all - before;
    if (wanted < e.weight[i])
      return e.value[i] + wanted / e.weight[i] * (e.value[i + 1] - e.value[i]);
    before += e.weight[i];
  }
  return e.value.back();
}

}  // namespace flowslide::study
