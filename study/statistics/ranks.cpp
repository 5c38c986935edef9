#include "study/statistics/ranks.hpp"

#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flowslide::study {

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double shared = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t i = begin; i < end; ++i) result[order[i]] = shared;
    begin = end;
  }
  return result;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean(x), my = mean(y);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xx > 0.0 && yy > 0.0 ? xy / (std::sqrt(xx) * std::sqrt(yy)) : kUnset;
}

Pairs without_gaps(const std::vector<double>& x, const std::vector<double>& y) {
  Pairs pairs;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (is_set(x[i]) && is_set(y[i])) {
      pairs.x.push_back(x[i]);
      pairs.y.push_back(y[i]);
    }
  return pairs;
}

Estimate spearman(const std::vector<double>& x, const std::vector<double>& y,
                  const Resampling& how) {
  const Pairs pairs = without_gaps(x, y);
  constexpr std::size_t kFewest = 4;
  if (pairs.x.size() < kFewest) return {.rows = pairs.x.size()};
  return bootstrap(pairs.x.size(), how, [&](const std::vector<std::size_t>& rows) {
    Pairs drawn;
    for (const std::size_t row : rows) {
      drawn.x.push_back(pairs.x[row]);
      drawn.y.push_back(pairs.y[row]);
    }
    return correlation(ranks(drawn.x), ranks(drawn.y));
  });
}

}  // namespace flowslide::study
