#include "study/statistics/ranks.hpp"

#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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

Resampling without_gaps(const Resampling& how, const std::vector<double>& x,
                        const std::vector<double>& y) {
  Resampling kept = how;
  kept.units.clear();
  kept.strata.clear();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!is_set(x[i]) || !is_set(y[i])) continue;
    if (!how.units.empty()) kept.units.push_back(how.units[i]);
    if (!how.strata.empty()) kept.strata.push_back(how.strata[i]);
  }
  return kept;
}

Estimate spearman(const std::vector<double>& x, const std::vector<double>& y,
                  const Resampling& how) {
  return spearman_within(std::vector<std::string>(x.size()), x, y, how);
}

Estimate spearman_within(const std::vector<std::string>& level, const std::vector<double>& x,
                         const std::vector<double>& y, const Resampling& how) {
  constexpr std::size_t kFewest = 4;
  const Pairs pairs = without_gaps(x, y);
  std::map<std::string, std::size_t> number;
  std::vector<std::size_t> level_of;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (is_set(x[i]) && is_set(y[i]))
      level_of.push_back(number.emplace(level[i], number.size()).first->second);
  std::vector<std::size_t> count(number.size());
  for (const std::size_t l : level_of) ++count[l];
  std::size_t rows = 0;
  for (const std::size_t n : count) rows += n >= kFewest ? n : 0;
  if (rows == 0) return {.rows = pairs.x.size()};
  Estimate e = bootstrap(pairs.x.size(), without_gaps(how, x, y),
                         [&](const std::vector<std::size_t>& drawn) {
                           std::vector<Pairs> here(number.size());
                           for (const std::size_t row : drawn) {
                             here[level_of[row]].x.push_back(pairs.x[row]);
                             here[level_of[row]].y.push_back(pairs.y[row]);
                           }
                           double sum = 0.0, weight = 0.0;
                           for (std::size_t l = 0; l < here.size(); ++l) {
                             if (count[l] < kFewest) continue;
                             const double r = correlation(ranks(here[l].x), ranks(here[l].y));
                             if (!is_set(r)) continue;
                             sum += static_cast<double>(count[l]) * r;
                             weight += static_cast<double>(count[l]);
                           }
                           return weight > 0.0 ? sum / weight : kUnset;
                         });
  e.rows = rows;
  return e;
}

}  // namespace flowslide::study
