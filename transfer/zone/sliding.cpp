#include "transfer/zone/sliding.hpp"

#include "core/check.hpp"

#include <algorithm>

namespace flowslide {

SlidingEnergy::Values SlidingEnergy::append(double time, const QuadMesh& mesh,
                                            std::span<const std::int32_t> elements,
                                            std::span<const double> mass,
                                            std::span<const Vec2> displacement,
                                            std::span<const std::int32_t> base_nodes) {
  FLOWSLIDE_EXPECT(mass.size() == elements.size() && displacement.size() == mesh.num_nodes());
  FLOWSLIDE_EXPECT(!base_nodes.empty() && (past_.empty() || time > past_.back().time));
  Instant now{.time = time, .base = {0.0, 0.0}, .relative = {}};
  for (const std::int32_t n : base_nodes)
    for (std::size_t k = 0; k < 2; ++k)
      now.base[k] +=
          displacement[static_cast<std::size_t>(n)][k] / static_cast<double>(base_nodes.size());
  now.relative.reserve(elements.size());
  for (const std::int32_t e : elements) {
    Vec2 mean{-now.base[0], -now.base[1]};
    for (const std::int32_t n : mesh.elements[static_cast<std::size_t>(e)])
      for (std::size_t k = 0; k < 2; ++k)
        mean[k] += 0.25 * displacement[static_cast<std::size_t>(n)][k];
    now.relative.push_back(mean);
  }
  past_.push_back(std::move(now));
  // recorded times are rounded
  const double begin = time - length_ * (1.0 - 1e-6);
  while (past_.size() > 2 && past_[1].time <= begin) past_.pop_front();

  const Instant& from = past_.front();
  const Instant& to = past_.back();
  // younger than `length_`, the record has stood still before it began
  const double duration = std::max({to.time - from.time, length_, 1e-12});
  const auto half_square = [duration](Vec2 a, Vec2 b) {
    const double x = (b[0] - a[0]) / duration, y = (b[1] - a[1]) / duration;
    return 0.5 * (x * x + y * y);
  };
  Values energy;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    energy.section += mass[i] * half_square(from.relative[i], to.relative[i]);
    energy.base += mass[i] * half_square(from.base, to.base);
  }
  return energy;
}

}  // namespace flowslide
