#pragma once
#include "core/check.hpp"

#include <array>
#include <bit>
#include <string_view>

namespace flowslide {

/// Name of the first value of a state that nothing gives: what parameters leave to the points of a
/// run, which may bring one each. Empty if there is none.
template <class M>
std::string_view left_to_points(const typename M::State& state) {
  if constexpr (!M::state_names.empty()) {
    const auto values = std::bit_cast<std::array<double, M::state_names.size()>>(state);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!is_set(values[i])) return M::state_names[i];
  }
  return {};
}

}  // namespace flowslide
