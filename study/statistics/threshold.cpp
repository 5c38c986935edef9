#include "study/statistics/threshold.hpp"

#include "study/statistics/least_squares.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace flowslide::study {
namespace {

constexpr int kSteps = 50;  ///< places that a threshold may have between the smallest and largest x

struct Found {
  int breach = 0, saturation = kSteps;
  double plateau = kUnset, squares = std::numeric_limits<double>::infinity();
};

struct Search {
  Pairs rows;
  double low = 0.0, high = 0.0;

  [[nodiscard]] double at(int step) const { return low + (high - low) * step / kSteps; }
  [[nodiscard]] double ramp(double x, int breach, int saturation) const {
    return std::clamp((x - at(breach)) / (at(saturation) - at(breach)), 0.0, 1.0);
  }
  /// For each pair of places the best plateau follows in closed form. The first of equals is kept,
  /// so that a threshold that nothing shows lies at the edge.
  [[nodiscard]] Found best(const std::vector<std::size_t>& drawn) const {
    // Equal x are one point with a weight: resamples repeat rows, and depths come in steps.
    struct Point {
      double x, count = 0.0, sum = 0.0;
    };
    std::vector<Point> points;
    std::vector<std::size_t> order = drawn;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return rows.x[a] < rows.x[b]; });
    double squares = 0.0;
    for (const std::size_t row : order) {
      if (points.empty() || points.back().x != rows.x[row]) points.push_back({rows.x[row]});
      points.back().count += 1.0;
      points.back().sum += rows.y[row];
      squares += rows.y[row] * rows.y[row];
    }
    Found found;
    for (int b = 0; b < kSteps; ++b)
      for (int s = kSteps; s > b; --s) {
        double tt = 0.0, ty = 0.0;
        for (const Point& p : points) {
          const double t = ramp(p.x, b, s);
          tt += p.count * t * t;
          ty += p.sum * t;
        }
        if (!(tt > 0.0)) continue;
        const double left = squares - ty * ty / tt;
        if (!(left < found.squares * (1.0 - 1e-9))) continue;
        found = {b, s, ty / tt, left};
      }
    return found;
  }
};

}  // namespace

Ramp fit_ramp(const std::vector<double>& x, const std::vector<double>& y, const Resampling& how) {
  Search search{.rows = without_gaps(x, y)};
  const std::size_t n = search.rows.x.size();
  Ramp ramp;
  ramp.breach.rows = ramp.saturation.rows = ramp.plateau.rows = n;
  if (n < kFewestForRamp) return ramp;
  search.low = *std::min_element(search.rows.x.begin(), search.rows.x.end());
  search.high = *std::max_element(search.rows.x.begin(), search.rows.x.end());
  if (!(search.high > search.low)) return ramp;

  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Found found = search.best(all);
  ramp.breach.value = search.at(found.breach);
  ramp.saturation.value = search.at(found.saturation);
  ramp.plateau.value = found.plateau;

  std::array<std::vector<double>, 3> values;
  double without_breach = 0.0, without_saturation = 0.0;
  resampled(n, without_gaps(how, x, y), [&](const std::vector<std::size_t>& drawn) {
    const Found f = search.best(drawn);
    values[0].push_back(search.at(f.breach));
    values[1].push_back(search.at(f.saturation));
    values[2].push_back(f.plateau);
    without_breach += f.breach == 0;
    without_saturation += f.saturation == kSteps;
    return 0.0;
  });
  const auto interval = [](Estimate& e, const std::vector<double>& v) {
    e.low = quantile_of(v, 0.025);
    e.high = quantile_of(v, 0.975);
  };
  interval(ramp.breach, values[0]);
  interval(ramp.saturation, values[1]);
  interval(ramp.plateau, values[2]);
  ramp.no_breach = without_breach / static_cast<double>(kResamples);
  ramp.no_saturation = without_saturation / static_cast<double>(kResamples);

  std::vector<double> fitted;
  for (const double v : search.rows.x)
    fitted.push_back(found.plateau * search.ramp(v, found.breach, found.saturation));
  ramp.r2 = share_explained(search.rows.y, fitted);
  const double r = correlation(search.rows.x, search.rows.y);
  ramp.line_r2 = r * r;
  return ramp;
}

}  // namespace flowslide::study
