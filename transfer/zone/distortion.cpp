#include "transfer/zone/distortion.hpp"

#include "core/check.hpp"
#include "model/shape_quad.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {

Distortion distortion(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                      const std::vector<Vec2>& positions,
                      std::span<const StrainIncrement<2>> strain, double strain_threshold) {
  FLOWSLIDE_EXPECT(positions.size() == mesh.num_nodes() && strain.size() == mesh.num_elements());
  const double point = 1.0 / std::sqrt(3.0);
  Distortion q{.gauss = 0.0, .centre = 0.0, .count = 0};
  for (const std::int32_t element : elements) {
    const auto e = static_cast<std::size_t>(element);
    if (!(deviatoric_strain(strain[e]) > strain_threshold)) continue;
    const std::array<Vec2, 4> before = corners(mesh, mesh.nodes, e);
    const std::array<Vec2, 4> now = corners(mesh, positions, e);
    double smallest = std::numeric_limits<double>::infinity();
    for (const double xi : {-point, point}) {
      for (const double eta : {-point, point}) {
        smallest = std::min(smallest, jacobian(now, xi, eta) / jacobian(before, xi, eta));
      }
    }
    q.gauss += smallest;
    q.centre += jacobian(now, 0.0, 0.0) / jacobian(before, 0.0, 0.0);
    ++q.count;
  }
  if (q.count == 0) return {};
  q.gauss /= static_cast<double>(q.count);
  q.centre /= static_cast<double>(q.count);
  return q;
}

}  // namespace flowslide
