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

/// Whether the point lies on a side of the closed outline, to the last bit of their products.
template <class Outline>
bool on_outline(const Outline& outline, Vec2 p) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& a = outline[i];
    const auto& b = outline[(i + 1) % outline.size()];
    const double cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    const double along = (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]);
    if (cross == 0.0 && along <= 0.0) return true;
  }
  return false;
}

}  // namespace flowslide
