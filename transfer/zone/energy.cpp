#include "transfer/zone/energy.hpp"

#include "core/check.hpp"
#include "transfer/zone/columns.hpp"

#include <algorithm>
#include <limits>

namespace flowslide {

std::vector<double> element_masses(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                                   std::span<const double> density) {
  FLOWSLIDE_EXPECT(density.size() == mesh.num_elements());
  std::vector<double> mass;
  mass.reserve(elements.size());
  for (const std::int32_t e : elements) {
    const auto index = static_cast<std::size_t>(e);
    mass.push_back(density[index] * area(corners(mesh, mesh.nodes, index)));
  }
  return mass;
}

std::vector<std::int32_t> lowest_nodes(const QuadMesh& mesh,
                                       std::span<const std::int32_t> elements) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::vector<std::int32_t> nodes = nodes_of(mesh, elements);
  for (const std::int32_t n : nodes) {
    low = std::min(low, mesh.nodes[static_cast<std::size_t>(n)][1]);
    high = std::max(high, mesh.nodes[static_cast<std::size_t>(n)][1]);
  }
  // Coordinates often pass through text with six digits.
  const double tolerance = 1e-5 * (high - low);
  std::erase_if(nodes, [&mesh, low, tolerance](std::int32_t n) {
    return mesh.nodes[static_cast<std::size_t>(n)][1] > low + tolerance;
  });
  return nodes;
}

KineticEnergy kinetic_energy(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                             std::span<const double> mass, std::span<const Vec2> velocity,
                             std::span<const std::int32_t> base_nodes) {
  FLOWSLIDE_EXPECT(mass.size() == elements.size() && velocity.size() == mesh.num_nodes());
  FLOWSLIDE_EXPECT(!base_nodes.empty());
  Vec2 base{0.0, 0.0};
  for (const std::int32_t n : base_nodes) {
    for (std::size_t k = 0; k < 2; ++k) base[k] += velocity[static_cast<std::size_t>(n)][k];
  }
  for (double& component : base) component /= static_cast<double>(base_nodes.size());

  KineticEnergy energy;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Vec2 mean{0.0, 0.0};
    for (const std::int32_t n : mesh.elements[static_cast<std::size_t>(elements[i])]) {
      for (std::size_t k = 0; k < 2; ++k)
        mean[k] += 0.25 * velocity[static_cast<std::size_t>(n)][k];
    }
    const Vec2 relative{mean[0] - base[0], mean[1] - base[1]};
    energy.absolute += 0.5 * mass[i] * (mean[0] * mean[0] + mean[1] * mean[1]);
    energy.relative += 0.5 * mass[i] * (relative[0] * relative[0] + relative[1] * relative[1]);
    energy.base += 0.5 * mass[i] * (base[0] * base[0] + base[1] * base[1]);
  }
  return energy;
}

}  // namespace flowslide
