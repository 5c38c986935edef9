#include "model/mirror.hpp"

#include <algorithm>

namespace flowslide {
namespace {

/// Nought has no sign.
void negate(double& x) { x = 0.0 - x; }

}  // namespace

void mirror(QuadMesh& mesh) {
  for (Vec2& p : mesh.nodes) negate(p[0]);
  for (auto& e : mesh.elements) e = {e[1], e[0], e[3], e[2]};
}

void mirror(SectionMesh& section) {
  mirror(section.mesh);
  for (EdgeSet& set : section.sets) {
    std::reverse(set.edges.begin(), set.edges.end());
    for (auto& edge : set.edges) std::swap(edge[0], edge[1]);
    if (set.name == "left")
      set.name = "right";
    else if (set.name == "right")
      set.name = "left";
  }
}

void mirror(FemFrame& frame) {
  constexpr int kShear = 3;
  for (Vec2& u : frame.displacement) negate(u[0]);
  for (Vec2& v : frame.velocity) negate(v[0]);
  for (auto& s : frame.stress) negate(s[kShear]);
  for (auto& e : frame.strain) negate(e[kShear]);
}

}  // namespace flowslide
