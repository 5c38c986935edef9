#include "fem/run_states.hpp"

#include "core/elementary.hpp"
#include "fem/build_model.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::fem {

void fill(FemFrame& frame, const Solver& s, std::size_t nodes, std::size_t elements) {
  frame.time = s.state.time;
  frame.displacement.resize(nodes);
  frame.velocity.resize(nodes);
  frame.pore_pressure.assign(s.state.pressure.begin(), s.state.pressure.begin() + nodes);
  frame.stress.resize(elements);
  frame.strain.resize(elements);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int d = 0; d < 2; ++d) {
      frame.displacement[i][d] = s.state.displacement[s.model.dof[i][d]];
      frame.velocity[i][d] = s.state.velocity[s.model.dof[i][d]];
    }
  const Elements& g = s.layout.elements;
  for (std::size_t k = 0; k < g.size(); ++k) {
    const auto e = static_cast<std::size_t>(s.layout.order[k]);
    if (e >= elements) continue;
    frame.stress[e] = s.state.stress[k];
    StrainIncrement<2>& strain = frame.strain[e];
    strain = {};
    for (int i = 0; i < 4; ++i) {
      const Vec2& u = frame.displacement[s.layout.nodes[k][i]];
      strain[0] += g.bx[i][k] * u[0];
      strain[1] += g.by[i][k] * u[1];
      strain[3] += g.by[i][k] * u[0] + g.bx[i][k] * u[1];
    }
  }
}

std::optional<std::string> drained_note(const SectionMesh& section, const FemConfig& config,
                                        const Solver& s) {
  if (!config.water) return std::nullopt;
  const double unit_weight = s.model.fluid.density * s.model.gravity;
  double missing = 0.0, standing = 0.0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < section.mesh.num_nodes(); ++i) {
    const auto [x, y] = section.mesh.nodes[i];
    const double p = unit_weight * std::max(0.0, water_level(*config.water, x) - y);
    if (p - s.state.pressure[i] <= missing || is_set(s.model.known_pressure[i])) continue;
    missing = p - s.state.pressure[i];
    standing = p;
    worst = i;
  }
  if (!(missing > 0.5 * standing)) return std::nullopt;
  return fmt::format(
      "pore pressure at rest lies up to {:.0f} kPa below that of standing water ({:.0f} kPa at "
      "({:.1f}, {:.1f}) m): steady flow by the permeabilities given drains the ground; "
      "gravity.permeability, one for all soil, leaves the water standing",
      1e-3 * missing, 1e-3 * standing, section.mesh.nodes[worst][0], section.mesh.nodes[worst][1]);
}

double largest_displacement(const FemFrame& frame, const std::vector<std::int32_t>& base) {
  Vec2 ground{};
  for (const std::int32_t i : base)
    for (int d = 0; d < 2; ++d)
      ground[d] += frame.displacement[i][d] / static_cast<double>(base.size());
  double largest = 0.0;
  for (const Vec2& u : frame.displacement)
    largest = std::max(largest, hypot(u[0] - ground[0], u[1] - ground[1]));
  return largest;
}

}  // namespace flowslide::fem
