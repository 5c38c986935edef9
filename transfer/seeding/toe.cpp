#include "transfer/seeding/toe.hpp"

#include "core/check.hpp"

#include <algorithm>

namespace flowslide {

double toe_of(const QuadMesh& mesh, const std::vector<std::uint8_t>& counts, const Box& box) {
  FLOWSLIDE_EXPECT(counts.size() == mesh.num_elements());
  double toe = kUnset;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (!counts[e]) continue;
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    if (!box.contains(centroid(quad))) continue;
    for (const Vec2& p : quad)
      if (!(toe >= p[0])) toe = std::min(p[0], box.xmax);
  }
  return toe;
}

}  // namespace flowslide
