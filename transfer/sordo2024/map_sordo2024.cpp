#include "transfer/sordo2024/map_sordo2024.hpp"

#include "core/check.hpp"
#include "transfer/seeding/toe.hpp"

#include <algorithm>

namespace flowslide {
namespace {

Vec2 base_displacement(const QuadMesh& mesh, const FemFrame& frame, int node_tag) {
  const auto found = std::find(mesh.node_tags.begin(), mesh.node_tags.end(), node_tag);
  validate(found != mesh.node_tags.end(), "base_node {} is not in the mesh", node_tag);
  // The script removes x only.
  return {frame.displacement[static_cast<std::size_t>(found - mesh.node_tags.begin())][0], 0.0};
}

}  // namespace

SordoResult map_sordo2024_audited(const FemHistory& history, const LiquefactionZone& zone,
                                  const SordoTransferConfig& config) {
  const SordoConfig sordo = for_history(config, history, zone.transfer_frame);
  SordoResult result{map_sordo2024(history, sordo), {}};
  ParticleSet& p = result.particles;
  const QuadMesh& mesh = history.mesh();
  const FemFrame frame =
      sordo.frame < 0 ? history.gravity() : history.frame(static_cast<std::size_t>(sordo.frame));

  const Vec2 base = base_displacement(mesh, frame, sordo.base_node);
  std::vector<Vec2> positions = mesh.nodes;
  for (std::size_t n = 0; n < positions.size(); ++n)
    for (int c = 0; c < 2; ++c) positions[n][c] += frame.displacement[n][c] - base[c];
  const SeedDomain domain{mesh,
                          positions,
                          element_densities(mesh, history.materials()),
                          std::vector<std::int32_t>(mesh.num_elements(), 0),
                          {sordo.keep_x[0], sordo.keep_x[1], sordo.keep_y[0], sordo.keep_y[1]}};
  std::vector<std::uint8_t> counts;
  for (const std::int32_t tag : mesh.element_material) counts.push_back(tag != sordo.foundation);
  p.toe = toe_of(mesh, counts, domain.box);

  TransferAudit& audit = result.audit;
  audit.time = frame.time;
  audit.at_rest = sordo.frame < 0;
  audit.base_displacement = base;
  audit.counts.points = static_cast<int>(p.size());
  for (const MaterialSpec& m : p.materials) audit.materials.push_back({m.name});
  for (std::size_t i = 0; i < p.size(); ++i) {
    AuditMaterial& m = audit.materials[static_cast<std::size_t>(p.material[i])];
    ++m.points;
    m.volume += p.volume[i];
    m.mass += p.mass[i];
  }
  audit.mapped = out_of_balance(p, config.cell, config.grid_origin, 0.5);
  audit.returned = audit.mapped;
  audit.notes = sordo2024_defects();
  const StateIntegrals mapped = integrate(p);
  fill_checks(audit, integrate(domain, frame.velocity, frame.pore_pressure, frame.stress, true),
              mapped, mapped, AuditLimits{});
  for (AuditCheck& c : audit.checks) c.limit = kUnset;
  return result;
}

}  // namespace flowslide
