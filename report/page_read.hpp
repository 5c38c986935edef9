#pragma once
#include "core/check.hpp"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flowslide {

/// What a page of a run holds, read back, for a page of many runs. Lengths in m.
struct PageRun {
  double toe = kUnset, front = kUnset;
  double transfer_time = kUnset;                   ///< [s] from the start of the motion
  std::vector<std::pair<int, std::string>> soils;  ///< tag of an element, its name
  std::vector<std::array<double, 2>> ground;       ///< beneath the flow; empty: not told
  std::vector<std::array<double, 3>> water;  ///< x, surface of water at rest, level of the ground
  std::vector<std::string> windows;          ///< of zone.depth0, zone.depth1, ...
  std::map<std::string, std::vector<double>, std::less<>> arrays;  ///< as page_data.cpp names them
  /// Empty if there is none.
  [[nodiscard]] const std::vector<double>& array(std::string_view name) const;
};

/// The arrays that `wanted` takes by name, and all else. None if the page is none of this
/// program's; InputError if it is damaged.
std::optional<PageRun> read_page(std::string_view html,
                                 const std::function<bool(std::string_view)>& wanted);

}  // namespace flowslide
