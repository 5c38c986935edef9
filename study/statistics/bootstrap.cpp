#include "study/statistics/bootstrap.hpp"

#include "study/numbers/random.hpp"
#include "study/statistics/summary.hpp"

#include <map>
#include <numeric>

namespace flowslide::study {
namespace {

using Unit = std::vector<std::size_t>;  ///< its rows

/// Units by their strata, in the order of their first rows.
std::vector<std::vector<Unit>> units_of(std::size_t rows, const Resampling& how) {
  std::vector<std::vector<Unit>> strata;
  std::map<std::size_t, std::size_t> stratum_of;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> place_of;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t unit = how.units.empty() ? row : how.units[row];
    const auto [place, is_new] = place_of.try_emplace(unit);
    if (is_new) {
      const auto [stratum, opens] =
          stratum_of.emplace(how.strata.empty() ? 0 : how.strata[row], strata.size());
      if (opens) strata.emplace_back();
      place->second = {stratum->second, strata[stratum->second].size()};
      strata[stratum->second].emplace_back();
    }
    strata[place->second.first][place->second.second].push_back(row);
  }
  return strata;
}

}  // namespace

std::vector<double> resampled(std::size_t rows, const Resampling& how, const Statistic& statistic) {
  std::vector<double> values;
  if (rows == 0) return values;
  Random random(how.seed, 0x626f6f74u);
  const std::vector<std::vector<Unit>> strata = units_of(rows, how);
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < kResamples; ++i) {
    if (how.stop && how.stop->load())
      throw Interrupted(
          "stopped; 'flowslide study report' makes tables and page of what is there.");
    drawn.clear();
    for (const std::vector<Unit>& units : strata)
      for (std::size_t k = 0; k < units.size(); ++k) {
        const Unit& unit = units[random.below(units.size())];
        drawn.insert(drawn.end(), unit.begin(), unit.end());
      }
    values.push_back(statistic(drawn));
  }
  return values;
}

Estimate bootstrap(std::size_t rows, const Resampling& how, const Statistic& statistic) {
  std::vector<std::size_t> all(rows);
  std::iota(all.begin(), all.end(), std::size_t{0});
  Estimate e{.rows = rows};
  if (rows == 0) return e;
  e.value = statistic(all);
  std::vector<double> values = resampled(rows, how, statistic);
  std::erase_if(values, [](double v) { return !is_set(v); });
  if (values.size() < kResamples / 2 || !is_set(e.value)) return e;
  e.low = quantile_of(values, 0.025);
  e.high = quantile_of(values, 0.975);
  return e;
}

}  // namespace flowslide::study
