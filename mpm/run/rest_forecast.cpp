#include "mpm/run/rest_forecast.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {

void RestForecast::look(double time, double kinetic) {
  seen_.push_back({time, std::sqrt(std::max(kinetic, 0.0))});
}

std::optional<double> RestForecast::rest(double peak, double share) const {
  constexpr double kFitted = 0.2;   // of the time so far
  constexpr double kFallen = 0.95;  // of the peak: before, the flow may still be gathering speed
  if (seen_.empty() || seen_.back().root > kFallen * std::sqrt(peak)) return std::nullopt;
  const double now = seen_.back().time, begin = (1.0 - kFitted) * now;
  double n = 0.0, t = 0.0, r = 0.0, tt = 0.0, tr = 0.0;
  for (auto s = seen_.rbegin(); s != seen_.rend() && s->time >= begin; ++s) {
    const double since = s->time - now;
    n += 1.0, t += since, r += s->root, tt += since * since, tr += since * s->root;
  }
  const double spread = n * tt - t * t, slope = n * tr - t * r;
  if (n < 3.0 || !(slope < 0.0 && spread > 0.0)) return std::nullopt;
  const double level = (r - slope / spread * t) / n, goal = std::sqrt(peak * share);
  return now + std::max(0.0, (level - goal) * spread / -slope);
}

}  // namespace flowslide
