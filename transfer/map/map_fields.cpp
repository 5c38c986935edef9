#include "transfer/map/map_fields.hpp"

#include "core/elementary.hpp"
#include "transfer/map/point_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flowslide {
namespace {

std::span<const SeedPiece> pieces_of(const SeedSet& set, const Seed& seed) {
  return {set.pieces.data() + seed.first_piece, static_cast<std::size_t>(seed.num_pieces)};
}

/// Elements that serve as sources, and the targets that read them.
struct SourceSet {
  std::vector<MlsSource> sources;
  std::vector<std::int32_t> element;  ///< of each source
  std::vector<MlsTarget> targets;
  std::vector<std::size_t> seed;  ///< of each target
};

template <class UseElement, class UseSeed>
SourceSet gather(const MappedState& state, const SeedSet& seeds, UseElement use_element,
                 UseSeed use_seed) {
  SourceSet s;
  std::vector<std::int32_t> source_of(state.mesh.num_elements(), -1);
  for (std::size_t e = 0; e < state.mesh.num_elements(); ++e) {
    if (!use_element(e)) continue;
    const std::array<Vec2, 4> q = corners(state.mesh, state.positions, e);
    const auto mid_line = [&q](int a, int b, int c, int d) {
      return 0.5 *
             hypot(q[a][0] + q[b][0] - q[c][0] - q[d][0], q[a][1] + q[b][1] - q[c][1] - q[d][1]);
    };
    source_of[e] = static_cast<std::int32_t>(s.sources.size());
    s.sources.push_back({centroid(q), std::max(mid_line(1, 2, 0, 3), mid_line(2, 3, 0, 1))});
    s.element.push_back(static_cast<std::int32_t>(e));
  }
  for (std::size_t i = 0; i < seeds.seeds.size(); ++i) {
    const Seed& seed = seeds.seeds[i];
    if (!use_seed(seed)) continue;
    const std::int32_t home = seeds.pieces[static_cast<std::size_t>(seed.first_piece)].element;
    s.targets.push_back({seed.position, source_of[static_cast<std::size_t>(home)]});
    s.seed.push_back(i);
  }
  return s;
}

void map_motion(const MappedState& state, const SeedSet& seeds, ParticleSet& p) {
  for (std::size_t i = 0; i < seeds.seeds.size(); ++i) {
    const Seed& seed = seeds.seeds[i];
    p.position[i] = {seed.position[0], seed.position[1], 0.0};
    p.volume[i] = seed.volume;
    p.mass[i] = seed.mass;
    p.material[i] = seed.group;
    p.velocity[i] = {-state.base.velocity[0], -state.base.velocity[1], 0.0};
    p.displacement[i] = {-state.base.displacement[0], -state.base.displacement[1], 0.0};
    p.pore_pressure[i] = 0.0;
    for (const SeedPiece& piece : pieces_of(seeds, seed)) {
      const auto& nodes = state.mesh.elements[static_cast<std::size_t>(piece.element)];
      for (int k = 0; k < 4; ++k) {
        const auto n = static_cast<std::size_t>(nodes[k]);
        const double by_volume = piece.shape[k] * piece.volume / seed.volume;
        const double by_mass = piece.shape[k] * piece.mass / seed.mass;
        for (int c = 0; c < 2; ++c) {
          p.velocity[i][c] += by_mass * state.frame.velocity[n][c];
          p.displacement[i][c] += by_volume * state.frame.displacement[n][c];
        }
        p.pore_pressure[i] += by_volume * state.frame.pore_pressure[n];
      }
    }
  }
}

void map_stress(const MappedState& state, const SeedSet& seeds, const MapGroups& groups,
                const MapConfig& config, const Progress& progress, ParticleSet& p,
                MapCounts& counts) {
  const bool total = config.mapped_stress == MappedStress::total;
  for (std::int32_t family = 0; family < static_cast<std::int32_t>(config.materials.size());
       ++family) {
    const SourceSet s = gather(
        state, seeds, [&](std::size_t e) { return groups.family[e] == family; },
        [&](const Seed& seed) {
          return groups.groups[static_cast<std::size_t>(seed.group)].family == family;
        });
    const PointMap map = build_mls(s.sources, s.targets, config.mls_radius, progress);
    counts.widened += map.widened;
    counts.nearest += map.nearest;
    std::vector<Stress<2>> value(s.sources.size());
    for (std::size_t k = 0; k < value.size(); ++k) {
      const auto e = static_cast<std::size_t>(s.element[k]);
      value[k] = state.frame.stress[e];
      if (!total) continue;
      double u = 0.0;
      for (const std::int32_t n : state.mesh.elements[e])
        u += 0.25 * state.frame.pore_pressure[static_cast<std::size_t>(n)];
      for (int c = 0; c < 3; ++c) value[k][c] -= u;
    }
    for (std::size_t t = 0; t < map.num_targets(); ++t) {
      std::array<double, 6>& sigma = p.stress[s.seed[t]];
      sigma = {};
      for (std::size_t k = map.offset[t]; k < map.offset[t + 1]; ++k)
        for (int c = 0; c < 4; ++c)
          sigma[c] += map.weight[k] * value[static_cast<std::size_t>(map.source[k])][c];
      if (total) continue;
      for (int c = 0; c < 3; ++c) sigma[c] -= p.pore_pressure[s.seed[t]];
    }
  }
}

/// eps_q of the strain since the state at rest, less the elastic part q / (3 G) of the change of
/// deviatoric stress.
double initial_strain(const MappedState& state, std::size_t e, double shear_modulus,
                      InitialStrain rule) {
  if (state.at_rest || rule == InitialStrain::zero) return 0.0;
  StrainIncrement<2> strain;
  Stress<2> change;
  for (int c = 0; c < 4; ++c) {
    strain[c] = state.frame.strain[e][c] - state.gravity.strain[e][c];
    change[c] = state.frame.stress[e][c] - state.gravity.stress[e][c];
  }
  const double total = deviatoric_strain(strain);
  if (rule == InitialStrain::total) return total;
  return std::max(0.0, total - equivalent_shear(change) / (3.0 * shear_modulus));
}

void map_strain(const MappedState& state, const SeedSet& seeds, const MapGroups& groups,
                const MapConfig& config, std::vector<double>& plastic_strain) {
  for (std::size_t i = 0; i < seeds.seeds.size(); ++i) {
    const Seed& seed = seeds.seeds[i];
    const double shear =
        std::visit([]<class M>(const Material<M>& m) { return M::elasticity(m.params).shear; },
                   groups.groups[static_cast<std::size_t>(seed.group)].law);
    for (const SeedPiece& piece : pieces_of(seeds, seed))
      plastic_strain[i] += piece.volume / seed.volume *
                           initial_strain(state, static_cast<std::size_t>(piece.element), shear,
                                          config.initial_strain);
  }
}

/// Nodal r_u where it is known; the element's value where no corner has one; 0 where neither does.
double pore_pressure_ratio(const MappedState& state, const SeedPiece& piece) {
  const auto e = static_cast<std::size_t>(piece.element);
  double sum = 0.0, weight = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double r = state.zone.r_u_node[static_cast<std::size_t>(state.mesh.elements[e][k])];
    if (!is_set(r)) continue;
    sum += piece.shape[k] * r;
    weight += piece.shape[k];
  }
  if (weight > 1e-9) return sum / weight;
  return is_set(state.zone.r_u_element[e]) ? state.zone.r_u_element[e] : 0.0;
}

void map_strength(const MappedState& state, const SeedSet& seeds, const MapGroups& groups,
                  const MapConfig& config, const Progress& progress,
                  std::vector<double>& strength) {
  for (std::size_t e = 0; e < state.mesh.num_elements(); ++e)
    validate(!state.zone.liquefied[e] || groups.group[e] < 0 || state.zone.strength[e] > 0.0,
             "map: liquefied element {} has strength {} Pa in the zone (a positive S_r is needed). "
             "Repair the strength table of the zone",
             state.mesh.element_tags[e], state.zone.strength[e]);
  for (std::size_t g = 0; g < groups.groups.size(); ++g) {
    if (!groups.groups[g].liquefied) continue;
    const auto group = static_cast<std::int32_t>(g);
    if (config.strength == StrengthPerPoint::element) {
      for (std::size_t i = 0; i < seeds.seeds.size(); ++i) {
        const Seed& seed = seeds.seeds[i];
        if (seed.group != group) continue;
        const auto home = static_cast<std::size_t>(
            seeds.pieces[static_cast<std::size_t>(seed.first_piece)].element);
        strength[i] = state.zone.strength[home];
      }
      continue;
    }
    const SourceSet s = gather(
        state, seeds, [&](std::size_t e) { return groups.group[e] == group; },
        [&](const Seed& seed) { return seed.group == group; });
    const PointMap map = build_mls(s.sources, s.targets, config.mls_radius, progress);
    for (std::size_t t = 0; t < map.num_targets(); ++t) {
      double value = 0.0, low = std::numeric_limits<double>::infinity(), high = 0.0;
      for (std::size_t k = map.offset[t]; k < map.offset[t + 1]; ++k) {
        const double s_r = state.zone.strength[static_cast<std::size_t>(
            s.element[static_cast<std::size_t>(map.source[k])])];
        value += map.weight[k] * s_r;
        low = std::min(low, s_r);
        high = std::max(high, s_r);
      }
      strength[s.seed[t]] = std::clamp(value, low, high);
    }
  }
}

}  // namespace

BaseMotion base_motion(const QuadMesh& mesh, const FemFrame& frame, const Box& box,
                       const MapConfig& config) {
  if (!config.remove_base_motion) return {};
  std::vector<std::size_t> candidates;
  double height_low = std::numeric_limits<double>::infinity(), height_high = -height_low;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n)
    if (box.contains(mesh.nodes[n])) candidates.push_back(n);
  if (candidates.empty()) {
    candidates.resize(mesh.num_nodes());
    std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  }
  for (const std::size_t n : candidates) {
    height_low = std::min(height_low, mesh.nodes[n][1]);
    height_high = std::max(height_high, mesh.nodes[n][1]);
  }
  const double level = height_low + 1e-6 * (height_high - height_low);
  std::erase_if(candidates, [&](std::size_t n) { return mesh.nodes[n][1] > level; });
  if (config.base == BaseReference::bottom_left) {
    candidates = {*std::min_element(
        candidates.begin(), candidates.end(),
        [&](std::size_t a, std::size_t b) { return mesh.nodes[a][0] < mesh.nodes[b][0]; })};
  }
  BaseMotion base;
  const double share = 1.0 / static_cast<double>(candidates.size());
  for (const std::size_t n : candidates) {
    for (int c = 0; c < 2; ++c) {
      base.displacement[c] += share * frame.displacement[n][c];
      base.velocity[c] += share * frame.velocity[n][c];
    }
  }
  return base;
}

ParticleSet map_fields(const MappedState& state, const SeedSet& seeds, const MapGroups& groups,
                       const MapConfig& config, const Progress& progress, MapCounts& counts) {
  ParticleSet p;
  p.dim = 2;
  for (const char* name : {"plastic_strain", "strength", "soft_strength", "r_u"})
    p.history[name].assign(seeds.seeds.size(), 0.0);
  resize(p, seeds.seeds.size());
  map_motion(state, seeds, p);
  progress.poll();
  map_stress(state, seeds, groups, config, progress, p, counts);
  map_strain(state, seeds, groups, config, p.history["plastic_strain"]);
  std::vector<double>& strength = p.history["strength"];
  map_strength(state, seeds, groups, config, progress, strength);
  for (std::size_t i = 0; i < seeds.seeds.size(); ++i) {
    progress.poll();
    p.history["soft_strength"][i] = config.c_soft_ratio.value_or(1.0) * strength[i];
    for (const SeedPiece& piece : pieces_of(seeds, seeds.seeds[i]))
      p.history["r_u"][i] +=
          piece.volume / seeds.seeds[i].volume * pore_pressure_ratio(state, piece);
  }
  return p;
}

}  // namespace flowslide
