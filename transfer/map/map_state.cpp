#include "transfer/map/map_state.hpp"

#include "transfer/map/map_fields.hpp"
#include "transfer/map/map_sordo2024.hpp"
#include "transfer/map/yield_return.hpp"

#include <algorithm>
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

Box box_of(const MapConfig& config) {
  if (config.box.size() == 4) return {config.box[0], config.box[1], config.box[2], config.box[3]};
  const double big = 1e300;
  return {-big, big, -big, big};
}

Stress<2> in_plane(const std::array<double, 6>& s) { return {{s[0], s[1], s[2], s[3]}}; }

/// What one material's law says about the stress of its points.
struct LawReturn {
  const MapConfig& config;
  double before = 0.0, after = 0.0;

  /// Laws whose stress is what their first step makes of it.
  template <class M>
  Stress<2> operator()(const Material<M>&, const ParticleSet& p, std::size_t i) {
    return in_plane(p.stress[i]);
  }
  Stress<2> operator()(const Material<MohrCoulomb>& m, const ParticleSet& p, std::size_t i) {
    const MohrCoulomb::Constants constants = MohrCoulomb::constants(m.params, 1.0);
    MohrCoulomb::State state = MohrCoulomb::initial_state(m.params);
    state.plastic_strain = p.history.at("plastic_strain")[i];
    state.pore_pressure = p.pore_pressure[i];
    const Stress<2> total = in_plane(p.stress[i]);
    const Stress<2> returned = return_mohr_coulomb(constants, state, total);
    const auto violation = [&](Stress<2> s) {
      for (int c = 0; c < 3; ++c) s[c] += state.pore_pressure;
      return relative_violation(MohrCoulomb::surface(constants, state), s);
    };
    before = violation(total);
    after = violation(returned);
    return returned;
  }
  Stress<2> operator()(const Material<ResidualStrength>& m, const ParticleSet& p, std::size_t i) {
    const ResidualStrength::Constants constants = ResidualStrength::constants(m.params, 1.0);
    ResidualStrength::State state = ResidualStrength::initial_state(m.params);
    state.plastic_strain = p.history.at("plastic_strain")[i];
    if (p.history.at("strength")[i] > 0.0) {
      state.strength = p.history.at("strength")[i];
      state.soft_strength = p.history.at("soft_strength")[i];
    }
    const double strength = ResidualStrength::present_strength(constants, state);
    const Stress<2> total = in_plane(p.stress[i]);
    const Stress<2> returned =
        return_liquefied(config.liquefied_return, strength, constants.tension_cutoff, total);
    before = relative_violation(strength, constants.tension_cutoff, total);
    after = relative_violation(strength, constants.tension_cutoff, returned);
    return returned;
  }
};

void return_stresses(ParticleSet& p, const std::vector<MapGroup>& groups, const MapConfig& config,
                     const Progress& progress, TransferAudit& audit) {
  for (const MapGroup& g : groups) audit.materials.push_back({g.spec.name});
  for (std::size_t i = 0; i < p.size(); ++i) {
    progress.poll();
    const auto g = static_cast<std::size_t>(p.material[i]);
    LawReturn law{config};
    const Stress<2> returned =
        std::visit([&](const auto& m) { return law(m, p, i); }, groups[g].law);
    AuditMaterial& m = audit.materials[g];
    ++m.points;
    m.volume += p.volume[i];
    m.mass += p.mass[i];
    if (law.before > config.audit.yield) ++m.returned;
    m.violation_before = std::max(m.violation_before, law.before);
    m.violation_after = std::max(m.violation_after, law.after);
    for (int c = 0; c < 4; ++c) p.stress[i][c] = returned[c];
  }
}

SeedSet place_points(const SeedDomain& domain, const MapConfig& config, const Progress& progress) {
  if (config.seeding == Seeding::gauss) return seed_gauss(domain, config.points_per_cell);
  return seed_lattice(
      domain, {config.cell / config.points_per_cell, config.grid_origin, config.sliver_fraction},
      progress);
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

MapResult map_state(const QuadMesh& mesh, const FemFrame& gravity, const FemFrame* shaking,
                    const LiquefactionZone& zone, const MapConfig& config,
                    const Progress& progress) {
  check(config);
  check_zone(mesh, zone);
  check_lengths(mesh, gravity, "state at rest");
  if (shaking) check_lengths(mesh, *shaking, "frame of transfer");
  const FemFrame& frame = shaking ? *shaking : gravity;
  const Box box = box_of(config);

  MappedState state{
      mesh, gravity, frame, zone, mesh.nodes, base_motion(mesh, frame, box, config), !shaking};
  std::vector<Vec2> velocity = frame.velocity;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    for (int c = 0; c < 2; ++c) {
      state.positions[n][c] += frame.displacement[n][c] - state.base.displacement[c];
      velocity[n][c] -= state.base.velocity[c];
    }
  }

  const MapGroups groups = group_elements(mesh, state.positions, box, zone, config);
  const SeedDomain domain{mesh, state.positions, groups.density, groups.group, box};
  const SeedSet seeds = place_points(domain, config, progress);
  validate(
      !seeds.seeds.empty(),
      "map: no element lies inside the box (there is nothing to transfer). Check box and tags");

  MapResult result;
  ParticleSet& p = result.particles;
  MapCounts counts;
  p = map_fields(state, seeds, groups, config, progress, counts);
  std::iota(p.id.begin(), p.id.end(), std::int64_t{0});
  for (const MapGroup& g : groups.groups) p.materials.push_back(g.spec);

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
  if (config.compat == Compat::sordo2024) {
    check(config);
    return map_sordo2024_audited(history, config);
  }
  const FemFrame& gravity = history.gravity();
  if (zone.transfer_frame < 0) 
    return map_state(history.mesh(), gravity, nullptr, zone, config, progress);
  validate(static_cast<std::size_t>(zone.transfer_frame) < history.times().size(),
           "map: the zone names frame {} but the history has {} (it belongs to another history). "
           "Run the "
           "stage transfer.zone on this history",
           zone.transfer_frame, history.times().size());
  const FemFrame frame = history.frame(static_cast<std::size_t>(zone.transfer_frame));
  return map_state(history.mesh(), gravity, &frame, zone, config, progress);
}

}  // namespace flowslide
