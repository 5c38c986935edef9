#pragma once
#include "core/progress.hpp"
#include "model/mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Moving least squares with a linear basis: built once, applied to many fields. It reproduces
/// linear fields exactly. Theory: docs/theory/transfer.md, "Moving least squares".
namespace flowslide {

/// Values at sources combined to values at targets: value_t = sum_k weight[k] * value[source[k]],
/// k from offset[t] to offset[t + 1].
struct PointMap {
  std::vector<std::size_t> offset{0};
  std::vector<std::int32_t> source;
  std::vector<double> weight;
  int widened = 0;  ///< targets whose radius had to grow to find enough sources
  int nearest = 0;  ///< targets that took the value of their home source: no stable fit

  [[nodiscard]] std::size_t num_targets() const { return offset.size() - 1; }
};

struct MlsSource {
  Vec2 position{};
  double size = 0.0;  ///< length scale h: the longer mid-line of the element [m]
};

struct MlsTarget {
  Vec2 position{};
  std::int32_t home = 0;  ///< source whose element holds the target
};

/// Weights w(r/R) with R = radius * h of the target's home. R grows by a quarter, at most six
/// times, until the fit is stable: at least four sources, well-conditioned moments and sum |weight|
/// <= 4; otherwise the target takes its home's value.
PointMap build_mls(std::span<const MlsSource> sources, std::span<const MlsTarget> targets,
                   double radius, const Progress& progress = {});

}  // namespace flowslide
