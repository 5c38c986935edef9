#include "study/statistics/effects.hpp"

#include "study/statistics/ranks.hpp"
#include "study/statistics/summary.hpp"

#include <map>
#include <set>

namespace flowslide::study {
namespace {

/// Mean of the rows at one end; NaN where a resample has none there.
double mean_at(const std::vector<double>& result, const std::vector<char>& end, char which,
               const std::vector<std::size_t>& rows) {
  double sum = 0.0, count = 0.0;
  for (const std::size_t row : rows)
    if (end[row] == which) {
      sum += result[row];
      count += 1.0;
    }
  return count > 0.0 ? sum / count : kUnset;
}

/// `end` is 'l' or 'h' for rows at an end.
Effect between(const std::vector<double>& result, const std::vector<char>& end,
               const Resampling& how) {
  Effect e;
  std::vector<std::size_t> all;
  for (std::size_t row = 0; row < result.size(); ++row) all.push_back(row);
  e.low = mean_at(result, end, 'l', all);
  e.high = mean_at(result, end, 'h', all);
  e.swing = bootstrap(result.size(), how, [&](const std::vector<std::size_t>& rows) {
    return mean_at(result, end, 'h', rows) - mean_at(result, end, 'l', rows);
  });
  return e;
}

}  // namespace

Effect effect_of_number(const std::vector<double>& input, const std::vector<double>& result,
                        const Resampling& how) {
  const Pairs rows = without_gaps(input, result);
  const std::set<double> levels(rows.x.begin(), rows.x.end());
  if (levels.size() < 2) return {};
  constexpr std::size_t kFew = 3;
  double low = quantile_of(rows.x, 1.0 / 3.0), high = quantile_of(rows.x, 2.0 / 3.0);
  // A value that most rows have would be both ends.
  const bool few = levels.size() <= kFew || !(low < high);
  if (few) {
    low = *levels.begin();
    high = *levels.rbegin();
  }
  std::vector<char> end;
  for (const double x : rows.x) end.push_back(x <= low ? 'l' : x >= high ? 'h' : '-');
  Effect e = between(rows.y, end, without_gaps(how, input, result));
  e.low_label = fmt::format("{}{:.4g}", few ? "" : "up to ", low);
  e.high_label = fmt::format("{}{:.4g}", few ? "" : "from ", high);
  return e;
}

Effect effect_of_choice(const std::vector<std::string>& input, const std::vector<double>& result,
                        const Resampling& how) {
  std::map<std::string, std::vector<double>> by_value;
  for (std::size_t row = 0; row < input.size(); ++row)
    if (is_set(result[row])) by_value[input[row]].push_back(result[row]);
  if (by_value.size() < 2) return {};
  auto least = by_value.begin(), most = by_value.begin();
  for (auto it = by_value.begin(); it != by_value.end(); ++it) {
    if (mean(it->second) < mean(least->second)) least = it;
    // Of equal ones the last, so that an input without effect has two ends, and the effect zero.
    if (mean(it->second) >= mean(most->second)) most = it;
  }
  std::vector<double> values;
  std::vector<char> end;
  for (std::size_t row = 0; row < input.size(); ++row) {
    if (!is_set(result[row])) continue;
    values.push_back(result[row]);
    end.push_back(input[row] == least->first ? 'l' : input[row] == most->first ? 'h' : '-');
  }
  Effect e = between(values, end, without_gaps(how, result, result));
  e.low_label = least->first;
  e.high_label = most->first;
  return e;
}

Estimate ratio_of_means(const std::vector<double>& over, const Resampling& of_over,
                        const std::vector<double>& under, const Resampling& of_under) {
  const auto mean_of = [](const std::vector<double>& values) {
    return [&values](const std::vector<std::size_t>& rows) {
      double sum = 0.0;
      for (const std::size_t row : rows) sum += values[row];
      return sum / static_cast<double>(rows.size());
    };
  };
  const auto ratio = [](double above, double below) {
    return below != 0.0 ? above / below : kUnset;
  };
  Estimate e{.value = ratio(mean(over), mean(under)), .rows = over.size() + under.size()};
  if (!is_set(e.value)) return e;
  Resampling apart = of_under;  // its draws are not those of the other side
  apart.seed = ~of_under.seed;
  const std::vector<double> above = resampled(over.size(), of_over, mean_of(over)),
                            below = resampled(under.size(), apart, mean_of(under));
  std::vector<double> ratios;
  for (std::size_t i = 0; i < above.size(); ++i)
    if (const double r = ratio(above[i], below[i]); is_set(r)) ratios.push_back(r);
  if (ratios.size() < kResamples / 2) return e;
  e.low = quantile_of(ratios, 0.025);
  e.high = quantile_of(ratios, 0.975);
  return e;
}

}  // namespace flowslide::study
