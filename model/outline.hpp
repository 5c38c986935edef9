#pragma once
#include "model/mesh.hpp"

namespace flowslide {

/// Whether the point lies inside a closed outline (even-odd rule), a list of things with [0] and
/// [1]; on the outline either answer is possible.
template <class Outline>
bool inside_outline(const Outline& outline, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& a = outline[i];
    const auto& b = outline[(i + 1) % outline.size()];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

}  // namespace flowslide
