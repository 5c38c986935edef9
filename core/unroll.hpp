#pragma once
#include <type_traits>
#include <utility>

namespace flowslide {

/// Calls f(integral_constant 0), ..., f(integral_constant N-1): a loop that is gone before the
/// compiler looks for vectorisable ones, so that a loop over points around it can be vectorised.
template <int N, class F>
[[gnu::always_inline]] inline constexpr void unroll(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, I>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

}  // namespace flowslide
