#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

/// The front of a flow by the rule of the case study this program follows (Sordo, Rathje and Kumar
/// 2025, Soil Dyn. Earthq. Eng. 194, 109371): "fifth-farthest material point from the toe".
namespace flowslide {

/// Rank of the point that marks the front: a handful of detached points must not.
inline constexpr std::size_t kFrontRank = 5;

/// The fifth-largest of the values, or the smallest if there are fewer; at least one. Changes their
/// order.
inline double front_of(std::vector<double>& x) {
  const auto at = x.begin() + static_cast<std::ptrdiff_t>(std::min(kFrontRank, x.size()) - 1);
  std::nth_element(x.begin(), at, x.end(), std::greater<>());
  return *at;
}

}  // namespace flowslide
