#include "transfer/map/map_state.hpp"

#include "model/brought_state.hpp"
#include "transfer/map/map_fields.hpp"
#include "transfer/seeding/toe.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace flowslide {
namespace {

void check_lengths(const QuadMesh& mesh, const FemFrame& frame, const char* what) {
  const std::size_t n = mesh.num_nodes(), m = mesh.num_elements();
  validate(
      frame.displacement.size() == n && frame.velocity.size() == n &&
          frame.pore_pressure.size() == n && frame.stress.size() == m && frame.strain.size() == m,
      "map: the {} has arrays of another length than the mesh of {} nodes and {} elements (values "
      "would land at wrong places). Import the history again",
      what, n, m);
}

void check_zone(const QuadMesh& mesh, const LiquefactionZone& zone) {
  validate(zone.liquefied.size() == mesh.num_elements() &&
               zone.strength.size() == mesh.num_elements() &&
               zone.r_u_element.size() == mesh.num_elements() &&
               zone.r_u_node.size() == mesh.num_nodes(),
           "map: the zone was made for {} elements, the history has {} (it belongs to another "
           "mesh). Run "
           "the stage transfer.zone on this history",
           zone.liquefied.size(), mesh.num_elements());
}

Stress<2> in_plane(const std::array<double, 6>& s) { return {{s[0], s[1], s[2], s[3]}}; }

/// The state in which a law takes a point over, as the runout will.
template <class M>
typename M::State state_of(const Material<M>& m, const ParticleSet& p, std::size_t i) {
  typename M::State state = M::initial_state(m.params);
  if constexpr (M::state_names.size() > 0) {
    auto numbers = std::bit_cast<std::array<double, M::state_names.size()>>(state);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      numbers[k] = BroughtState(p, M::state_names[k]).at(i, numbers[k]);
    state = std::bit_cast<typename M::State>(numbers);
  }
  return state;
}

void return_stresses(ParticleSet& p, const std::vector<MapGroup>& groups, const MapConfig& config,
                     const Progress& progress, TransferAudit& audit) {
  for (const MapGroup& g : groups) audit.materials.push_back({g.spec.name});
  for (std::size_t i = 0; i < p.size(); ++i) {
    progress.poll();
    const auto g = static_cast<std::size_t>(p.material[i]);
    const AdmissibleStress carried = std::visit(
        [&]<class M>(const Material<M>& m) {
          return M::admissible(M::constants(m.params, 1.0), state_of(m, p, i),
                               in_plane(p.stress[i]), config.liquefied_return);
        },
        groups[g].law);
    AuditMaterial& m = audit.materials[g];
    ++m.points;
    m.volume += p.volume[i];
    m.mass += p.mass[i];
    if (carried.before > config.audit.yield) ++m.returned;
    m.violation_before = std::max(m.violation_before, carried.before);
    m.violation_after = std::max(m.violation_after, carried.after);
    for (int c = 0; c < 4; ++c) p.stress[i][c] = carried.stress[c];
  }
}

SeedSet place_points(const SeedDomain& domain, const MapConfig& config, const Progress& progress) {
  if (config.seeding == Seeding::gauss) return seed_gauss(domain, config.points_per_cell);
  return seed_lattice(
      domain, {config.cell / config.points_per_cell, config.grid_origin, config.sliver_fraction},
      progress);
}

/// Elements whose soil counts for the runout.
std::vector<std::uint8_t> counted(const MapGroups& groups) {
  std::vector<std::uint8_t> counts(groups.group.size());
  for (std::size_t e = 0; e < counts.size(); ++e) {
    const std::int32_t g = groups.group[e];
    counts[e] = g >= 0 && groups.groups[static_cast<std::size_t>(g)].spec.counts_for_runout;
  }
  return counts;
}

void copy_counts(const SeedSet& seeds, const MapCounts& counts, AuditCounts& out) {
  out = {static_cast<int>(seeds.seeds.size()),
         seeds.slivers_merged,
         seeds.slivers_kept,
         seeds.moved_inside,
         seeds.split_elements,
         counts.widened,
         counts.nearest};
}

}  // namespace

MapResult map_state(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                    const FemFrame& gravity, const FemFrame* shaking, const LiquefactionZone& zone,
                    const MapConfig& config, const Progress& progress) {
  check(config);
  check(mesh, materials);
  check_zone(mesh, zone);
  check_lengths(mesh, gravity, "state at rest");
  if (shaking) check_lengths(mesh, *shaking, "frame of transfer");
  const FemFrame& frame = shaking ? *shaking : gravity;
  const Box box = box_of(config.box);

  MappedState state{
      mesh, gravity, frame, zone, mesh.nodes, base_motion(mesh, frame, box, config), !shaking};
  std::vector<Vec2> velocity = frame.velocity;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    for (int c = 0; c < 2; ++c) {
      state.positions[n][c] += frame.displacement[n][c] - state.base.displacement[c];
      velocity[n][c] -= state.base.velocity[c];
    }
  }

  const MapGroups groups = group_elements(mesh, materials, state.positions, box, zone, config);
  const SeedDomain domain{mesh, state.positions, groups.density, groups.group, box};
  const SeedSet seeds = place_points(domain, config, progress);
  validate(!seeds.seeds.empty(),
           "map: no element lies inside the box (there is nothing to transfer). Check box and "
           "materials");

  MapResult result;
  ParticleSet& p = result.particles;
  MapCounts counts;
  p = map_fields(state, seeds, groups, config, progress, counts);
  std::iota(p.id.begin(), p.id.end(), std::int64_t{0});
  for (const MapGroup& g : groups.groups) p.materials.push_back(g.spec);
  p.toe = toe_of(mesh, counted(groups), box);

  const double full_cell = config.seeding == Seeding::gauss ? 0.5 : 0.95;
  TransferAudit& audit = result.audit;
  audit.time = frame.time;
  audit.at_rest = state.at_rest;
  audit.base_displacement = state.base.displacement;
  audit.base_velocity = state.base.velocity;
  copy_counts(seeds, counts, audit.counts);
  const StateIntegrals fem = integrate(domain, velocity, frame.pore_pressure, frame.stress,
                                       config.seeding == Seeding::gauss);
  const StateIntegrals mapped = integrate(p);
  progress.poll();
  audit.mapped = out_of_balance(p, config.cell, config.grid_origin, full_cell);
  if (config.friction_acts_on == FrictionStress::total)
    std::fill(p.pore_pressure.begin(), p.pore_pressure.end(), 0.0);
  return_stresses(p, groups.groups, config, progress, audit);
  audit.returned = out_of_balance(p, config.cell, config.grid_origin, full_cell);
  fill_checks(audit, fem, mapped, integrate(p), config.audit);
  for (const AuditMaterial& m : audit.materials)
    if (m.points == 0) audit.notes.push_back(fmt::format("material '{}' has no points", m.name));
  check(p);
  if (config.audit.enforce) enforce(audit);
  return result;
}

MapResult map_state(const FemHistory& history, const LiquefactionZone& zone,
                    const MapConfig& config, const Progress& progress) {
  const FemFrame& gravity = history.gravity();
  if (zone.transfer_frame < 0)
    return map_state(history.mesh(), history.materials(), gravity, nullptr, zone, config, progress);
  validate(static_cast<std::size_t>(zone.transfer_frame) < history.times().size(),
           "map: the zone names frame {} but the history has {} (it belongs to another history). "
           "Run the "
           "stage transfer.zone on this history",
           zone.transfer_frame, history.times().size());
  const FemFrame frame = history.frame(static_cast<std::size_t>(zone.transfer_frame));
  return map_state(history.mesh(), history.materials(), gravity, &frame, zone, config, progress);
}

}  // namespace flowslide
