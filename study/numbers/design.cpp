#include "study/numbers/design.hpp"

#include "study/numbers/normal.hpp"
#include "study/numbers/random.hpp"
#include "study/numbers/sobol.hpp"

#include <algorithm>
#include <numeric>

namespace flowslide::study {
namespace {

using Points = std::vector<std::vector<double>>;

Points hypercube(std::size_t count, std::size_t inputs, std::uint64_t seed) {
  Points points(count, std::vector<double>(inputs));
  for (std::size_t d = 0; d < inputs; ++d) {
    Random random(seed, d);
    const std::vector<std::size_t> stratum = random.permutation(count);
    for (std::size_t i = 0; i < count; ++i)
      points[i][d] = (static_cast<double>(stratum[i]) + random.uniform()) /
                     static_cast<double>(count);
  }
  return points;
}

/// Shifted digit by digit, which keeps what makes the sequence even.
Points sobol(std::size_t count, std::size_t inputs, std::uint64_t seed) {
  std::vector<std::uint32_t> shift;
  for (std::size_t d = 0; d < inputs; ++d)
    shift.push_back(static_cast<std::uint32_t>(Random(seed, d).next() >> 32u));
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<std::uint32_t> integers = sobol_point(i, inputs);
    std::vector<double>& point = points.emplace_back();
    for (std::size_t d = 0; d < inputs; ++d)
      point.push_back((static_cast<double>(integers[d] ^ shift[d]) + 0.5) * 0x1p-32);
  }
  return points;
}

Points random_points(std::size_t count, std::size_t inputs, std::uint64_t seed) {
  Points points(count, std::vector<double>(inputs));
  for (std::size_t d = 0; d < inputs; ++d) {
    Random random(seed, d);
    for (auto& point : points) point[d] = random.uniform();
  }
  return points;
}

/// Correlated normal scores, and from them probabilities.
Points correlated(const Points& points, const std::vector<std::vector<double>>& factor) {
  Points result = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t d = 0; d < factor.size(); ++d) {
      double z = 0.0;
      for (std::size_t k = 0; k <= d; ++k) z += factor[d][k] * normal_quantile(points[i][k]);
      // Without partners the number stays as it was, to the bit.
      if (factor[d][d] != 1.0) result[i][d] = normal_probability(z);
    }
  return result;
}

/// The values of `values` in the order of the ranks of `like`, input by input.
Points reordered(const Points& values, const Points& like) {
  Points result = values;
  const std::size_t count = values.size();
  for (std::size_t d = 0; d < (count > 0 ? values[0].size() : 0); ++d) {
    std::vector<double> sorted;
    for (const auto& point : values) sorted.push_back(point[d]);
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return like[a][d] < like[b][d]; });
    for (std::size_t rank = 0; rank < count; ++rank) result[order[rank]][d] = sorted[rank];
  }
  return result;
}

}  // namespace

Points sample_points(Sampling method, std::size_t count, std::size_t inputs, std::uint64_t seed,
                     const std::vector<Correlated>& pairs) {
  const Points points = method == Sampling::latin_hypercube ? hypercube(count, inputs, seed)
                        : method == Sampling::sobol         ? sobol(count, inputs, seed)
                                                            : random_points(count, inputs, seed);
  if (pairs.empty()) return points;
  const Points moved = correlated(points, correlation_factor(inputs, pairs));
  // Every stratum of a hypercube keeps its one value.
  return method == Sampling::latin_hypercube ? reordered(points, moved) : moved;
}

}  // namespace flowslide::study
