#include "bench/mpm/bandwidth.hpp"

#include "core/benchmark.hpp"

#include <algorithm>
#include <vector>

namespace flowslide::mpm {

double triad_bandwidth(std::size_t bytes) {
  const std::size_t n = std::max<std::size_t>(bytes / (3 * sizeof(double)), 1024);
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 1e300;
  // Enough passes that each timing lasts a few milliseconds.
  const std::size_t passes = std::max<std::size_t>(1, 4'000'000 / n);
  for (int repeat = 0; repeat < 6; ++repeat) {
    const double start = thread_seconds();
    for (std::size_t pass = 0; pass < passes; ++pass) {
      const double s = a[pass];  // keeps the passes apart
      for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + (0.5 + 1e-9 * s) * c[i];
    }
    best = std::min(best, (thread_seconds() - start) / double(passes));
  }
  return 3.0 * sizeof(double) * double(n) / best;
}

}  // namespace flowslide::mpm
