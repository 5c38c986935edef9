#include "transfer/zone/zone_r_u.hpp"

#include "core/check.hpp"

#include <cmath>

namespace flowslide {

RuReference r_u_reference(const QuadMesh& mesh, const FemFrame& gravity,
                          std::span<const std::uint8_t> liquefiable, const RuConfig& config) {
  FLOWSLIDE_EXPECT(liquefiable.size() == mesh.num_elements());
  RuReference r{.sigma_v0 = std::vector<double>(mesh.num_elements()),
                .per_stress = std::vector<double>(mesh.num_nodes(), kUnset),
                .u_0 = gravity.pore_pressure,
                .notes = {}};
  // Per node: sum of weights, of weighted stress, and of weighted inverse stress.
  std::vector<double> weight(mesh.num_nodes()), stress(mesh.num_nodes()), inverse(mesh.num_nodes());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const double sigma = -gravity.stress[e][1];
    r.sigma_v0[e] = sigma;
    if (!liquefiable[e]) continue;
    validate(
        std::isfinite(sigma),
        "element {}: the vertical stress of the gravity state is {} (r_u and S_r need it) check "
        "the gravity recorder",
        mesh.element_tags[e], sigma);
    const bool own_value = config.sigma_v0 == SigmaSource::element;
    if (own_value && !(sigma > 0.0 && sigma >= config.floor)) continue;
    const double w = area(corners(mesh, mesh.nodes, e));
    for (const std::int32_t node : mesh.elements[e]) {
      const auto n = static_cast<std::size_t>(node);
      weight[n] += w;
      stress[n] += w * sigma;
      if (own_value) inverse[n] += w / sigma;
    }
  }
  std::vector<std::uint8_t> touched(mesh.num_nodes());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (!liquefiable[e]) continue;
    for (const std::int32_t node : mesh.elements[e]) touched[static_cast<std::size_t>(node)] = 1;
  }
  std::size_t below = 0;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    if (!touched[n]) continue;
    const double sigma = weight[n] > 0.0 ? stress[n] / weight[n] : 0.0;
    if (!(sigma > 0.0 && sigma >= config.floor)) {
      ++below;
      continue;
    }
    validate(
        std::isfinite(r.u_0[n]),
        "node {}: the pore pressure of the gravity state is {} (r_u needs it) check the gravity "
        "recorder",
        mesh.node_tags[n], r.u_0[n]);
    r.per_stress[n] =
        config.sigma_v0 == SigmaSource::element ? inverse[n] / weight[n] : 1.0 / sigma;
  }
  if (below > 0) {
    r.notes.push_back(
        fmt::format("{} nodes of the liquefiable soil have no r_u: initial vertical effective "
                    "stress below {:g} kPa",
                    below, config.floor * 1e-3));
  }
  return r;
}

std::vector<double> r_u_at_nodes(const QuadMesh& mesh, const RuReference& reference,
                                 std::span<const double> pore_pressure, double time) {
  std::vector<double> r_u(mesh.num_nodes(), kUnset);
  for (std::size_t n = 0; n < r_u.size(); ++n) {
    if (!is_set(reference.per_stress[n])) continue;
    validate(
        std::isfinite(pore_pressure[n]),
        "node {}: the pore pressure at {} s is {} (r_u needs it) check the recorder, or end the "
        "record before",
        mesh.node_tags[n], time, pore_pressure[n]);
    r_u[n] = (pore_pressure[n] - reference.u_0[n]) * reference.per_stress[n];
  }
  return r_u;
}

std::vector<double> element_means(const QuadMesh& mesh, std::span<const double> nodal) {
  std::vector<double> mean(mesh.num_elements(), kUnset);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    double sum = 0.0;
    int count = 0;
    for (const std::int32_t n : mesh.elements[e]) {
      const double value = nodal[static_cast<std::size_t>(n)];
      if (!is_set(value)) continue;
      sum += value;
      ++count;
    }
    if (count > 0) mean[e] = sum / count;
  }
  return mean;
}

}  // namespace flowslide
