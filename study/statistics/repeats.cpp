#include "study/statistics/repeats.hpp"

#include "study/statistics/summary.hpp"

#include <cmath>
#include <map>

namespace flowslide::study {
namespace {

/// Values that differ by rounding alone have no scatter.
double scatter_of(const std::vector<double>& values, double mean) {
  const double s = deviation(values);
  return s < 1e-12 * std::abs(mean) ? 0.0 : s;
}

}  // namespace

Repeats group_rows(const std::vector<std::size_t>& group) {
  Repeats repeats;
  std::map<std::size_t, std::size_t> place;
  for (std::size_t row = 0; row < group.size(); ++row) {
    const auto [it, is_new] = place.emplace(group[row], repeats.groups.size());
    if (is_new) repeats.groups.emplace_back();
    repeats.groups[it->second].push_back(row);
  }
  return repeats;
}

Scatter scatter(const Repeats& repeats, const std::vector<double>& values) {
  Scatter s;
  double squares = 0.0, freedom = 0.0;
  std::vector<double> means;
  for (const auto& rows : repeats.groups) {
    std::vector<double> here;
    for (const std::size_t row : rows)
      if (is_set(values[row])) here.push_back(values[row]);
    s.mean.push_back(mean(here));
    s.deviation.push_back(scatter_of(here, s.mean.back()));
    if (!here.empty()) means.push_back(s.mean.back());
    if (here.size() < 2) continue;
    ++s.repeated;
    const auto free = static_cast<double>(here.size() - 1);
    squares += free * s.deviation.back() * s.deviation.back();
    freedom += free;
  }
  if (freedom > 0.0) s.numerical = std::sqrt(squares / freedom);
  s.of_inputs = deviation(means);
  return s;
}

}  // namespace flowslide::study
