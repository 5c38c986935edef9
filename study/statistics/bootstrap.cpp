#include "study/statistics/bootstrap.hpp"

#include "study/numbers/random.hpp"
#include "study/statistics/summary.hpp"

#include <numeric>

namespace flowslide::study {

std::vector<double> resampled(std::size_t rows, const Resampling& how, const Statistic& statistic) {
  std::vector<double> values;
  if (rows == 0) return values;
  Random random(how.seed, 0x626f6f74u);
  std::vector<std::size_t> drawn(rows);
  for (std::size_t i = 0; i < kResamples; ++i) {
    if (how.stop && how.stop->load())
      throw Interrupted(
          "stopped; 'flowslide study report' makes tables and page of what is there.");
    for (std::size_t& row : drawn) row = random.below(rows);
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
