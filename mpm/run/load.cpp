#include "mpm/run/load.hpp"

#include "core/elementary.hpp"
#include "model/brought_state.hpp"
#include "mpm/run/stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {
namespace {

/// F-bar pays where pressure would lock: K/G at nu = 0.4 and above.
constexpr double kAverageRatio = 4.6;

/// Depth over which a traction is handed to the points [cells]: whole rows of any lattice.
constexpr double kTractionDepth = 2.0;

/// Whether pressure carries shear. Such soil keeps the pressure of its points: its deviator is
/// bounded by that, and with the mean over a span as acting pressure it would flow where it can
/// stand.
template <class M>
bool frictional(const typename M::Params& p) {
  if constexpr (requires { p.mu_static; })
    return true;
  else if constexpr (requires { p.friction_angle; })
    return p.friction_angle > 0.0;
  else
    return false;
}

template <int Dim>
SolverMaterial solver_material(const MaterialSpec& spec, const FlowConfig& config) {
  const double scale = config.softening.scale(config.cell);
  return std::visit(
      [&]<class M>(const Material<M>& m) {
        const Elasticity e = M::elasticity(m.params);
        const bool locks = e.bulk > kAverageRatio * e.shear && !frictional<M>(m.params);
        const bool averages = locks && config.volume_average == VolumeAverage::automatic;
        return SolverMaterial{Typed<M>{M::constants(m.params, scale)}, e, locks,
                              wave_modulus<Dim>(e, averages, config.basis)};
      },
      from_parameters(spec.law, spec.parameters));
}

/// Start values of a material's state variables and, by name, those the particles bring.
struct StateSource {
  std::vector<double> of_material;
  std::vector<BroughtState> brought;
  std::vector<std::string_view> names;
};

StateSource state_source(const MaterialSpec& spec, const ParticleSet& particles) {
  return std::visit(
      [&]<class M>(const Material<M>& m) {
        StateSource s;
        constexpr std::size_t n = M::state_names.size();
        static_assert(n <= kMaxState);
        std::array<double, n> initial{};
        if constexpr (n > 0)
          initial = std::bit_cast<std::array<double, n>>(M::initial_state(m.params));
        for (std::size_t i = 0; i < n; ++i) {
          s.names.push_back(M::state_names[i]);
          s.of_material.push_back(initial[i]);
          s.brought.emplace_back(particles, M::state_names[i]);
        }
        return s;
      },
      from_parameters(spec.law, spec.parameters));
}

/// Height of the ground under a point [m].
template <int Dim>
double ground_level(const Simulation<Dim>& s, std::int64_t id, std::size_t q) {
  const auto& x = s.points.x;
  if constexpr (Dim == 3) {
    if (s.ground.field) {
      const double level = s.ground.field->at(x[0][q], x[1][q]);
      validate(!std::isnan(level),
               "particle {} at ({:.2f}, {:.2f}) stands where the terrain has no height, see {} (it "
               "would fall for ever) fill the gap in the file, or check terrain.origin and "
               "terrain.heading",
               id, x[0][q], x[1][q], s.ground.field->name_place(x[0][q], x[1][q]));
      return level;
    }
  }
  return s.ground.level(x[0][q]);
}

template <int Dim>
Ground make_ground(const GroundSettings& settings) {
  Ground ground;
  for (const auto& point : settings.surface) {
    ground.x.push_back(point[0]);
    ground.height.push_back(point[1]);
  }
  ground.friction = settings.friction;
  if (settings.terrain) {
    validate(Dim == 3,
             "ground.terrain is a surface in three dimensions (this run has {}) give "
             "ground.surface",
             Dim);
    const TerrainSettings& t = *settings.terrain;
    ground.field = read_height_field(t.file.path, {t.origin, t.heading, t.level});
  }
  return ground;
}

Rollers make_rollers(const FlowConfig& config) {
  Rollers r;
  if (config.left_roller) r.left = *config.left_roller;
  if (config.right_roller) r.right = *config.right_roller;
  if (config.side_rollers) {
    r.near = (*config.side_rollers)[0];
    r.far = (*config.side_rollers)[1];
    if (config.extrude && config.extrude->sides == Sides::rough)
      r.side_friction = config.ground.friction;
  }
  return r;
}

/// What does not depend on the points: settings, grid, and what stands around the soil.
template <int Dim>
Simulation<Dim> make_scene(const FlowConfig& config) {
  Simulation<Dim> s;
  s.settings = config;
  s.gravity[Dim - 1] = -config.gravity;
  s.grid.h = config.cell;
  s.grid.origin.front() = config.grid_origin[0];
  s.grid.origin.back() = config.grid_origin[1];
  s.ground = make_ground<Dim>(config.ground);
  s.rollers = make_rollers(config);
  s.outlet.low.front() = config.outlet.left.value_or(s.outlet.low.front());
  s.outlet.high.front() = config.outlet.right.value_or(s.outlet.high.front());
  s.outlet.low.back() = config.outlet.bottom.value_or(s.outlet.low.back());
  s.outlet.high.back() = config.outlet.top.value_or(s.outlet.high.back());
  Absorbing<Dim>& absorbing = s.contact.absorbing;
  absorbing.low.front() = config.absorbing.left.value_or(absorbing.low.front());
  absorbing.high.front() = config.absorbing.right.value_or(absorbing.high.front());
  absorbing.low.back() = config.absorbing.bottom.value_or(absorbing.low.back());
  if (config.sleep) {
    s.sleep.speed = config.sleep->speed;
    s.sleep.after = config.sleep->after;
  }
  return s;
}

template <int Dim>
void load_points(const ParticleSet& particles, Points<Dim>& p) {
  visit_arrays(p, [&](auto& array) { array.assign(particles.size(), {}); });
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (int d = 0; d < Dim; ++d) {
      p.x[d][i] = particles.position[i][d];
      p.v[d][i] = particles.velocity[i][d];
    }
    for (int k = 0; k < kVoigt<Dim>; ++k) p.sigma[k][i] = particles.stress[i][k];
    p.mass[i] = particles.mass[i];
    p.volume[i] = particles.volume[i];
    p.material[i] = particles.material[i];
    p.index[i] = static_cast<std::int32_t>(i);
  }
}

template <int Dim>
void load_states(const ParticleSet& particles, Points<Dim>& p) {
  std::vector<StateSource> sources;
  for (const MaterialSpec& spec : particles.materials)
    sources.push_back(state_source(spec, particles));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const StateSource& source = sources[p.material[i]];
    for (std::size_t k = 0; k < source.names.size(); ++k) {
      const double value = source.brought[k].at(i, source.of_material[k]);
      p.state[k][i] = value;
      validate(std::isfinite(value),
               "particle {} of material '{}' has no '{}' (its law needs it) give it in the "
               "material or per particle",
               particles.id[i], particles.materials[p.material[i]].name, source.names[k]);
    }
  }
}

/// Points that the first step would throw out, or lose.
template <int Dim>
void check_places(const Simulation<Dim>& s, const std::vector<std::int64_t>& id) {
  const Points<Dim>& p = s.points;
  const Absorbing<Dim>& absorbing = s.contact.absorbing;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double depth = ground_level(s, id[i], i) - p.x[Dim - 1][i];
    validate(!(depth > 0.5 * s.grid.h),
             "particle {} at ({:.2f}, {:.2f}) lies {:.2f} m inside the ground (it would be thrown "
             "out) lower ground.surface or raise the transfer box",
             id[i], p.x[0][i], p.x[Dim - 1][i], depth);
    for (int d = 0; d < Dim; ++d)
      validate(p.x[d][i] >= absorbing.low[d] && p.x[d][i] <= absorbing.high[d],
               "particle {} at ({:.2f}, {:.2f}) lies beyond an absorbing plane (nothing would hold "
               "it there) move the plane or the transfer box",
               id[i], p.x[0][i], p.x[Dim - 1][i]);
    for (int d = 0; d < Dim; ++d)
      validate(p.x[d][i] >= s.outlet.low[d] && p.x[d][i] <= s.outlet.high[d],
               "particle {} at ({:.2f}, {:.2f}) lies beyond the outlet (it would leave before the "
               "run begins) move the outlet or the transfer box",
               id[i], p.x[0][i], p.x[Dim - 1][i]);
  }
}

/// What the points are at the start: the densest, the fastest, and the fastest wave.
template <int Dim>
void measure_points(Simulation<Dim>& s) {
  const Points<Dim>& p = s.points;
  s.largest_density.assign(s.materials.size(), 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    double& largest = s.largest_density[p.material[i]];
    largest = std::max(largest, p.mass[i] / p.volume[i]);
    const double modulus = s.materials[p.material[i]].wave_modulus;
    s.last.max_wave2 = std::max(s.last.max_wave2, modulus * p.volume[i] / p.mass[i]);
    double speed2 = 0.0;
    for (const auto& v : p.v) speed2 += v[i] * v[i];
    s.last.max_speed2 = std::max(s.last.max_speed2, speed2);
  }
  const double density = *std::max_element(s.largest_density.begin(), s.largest_density.end());
  s.full_mass = density * pow(s.grid.h, Dim);
}

template <int Dim>
void add_tractions(const FlowConfig& config, Simulation<Dim>& s) {
  if constexpr (Dim == 2) {
    for (std::size_t i = 0; i < config.tractions.size(); ++i) {
      const TractionSettings& t = config.tractions[i];
      const std::size_t carriers =
          add_traction({t.from, t.to, t.pressure, t.shear, t.begin, t.ramp},
                       kTractionDepth * config.cell, s.points, s.loads);
      validate(carriers > 0,
               "tractions: no particle lies within {} cells to the right of stretch {} (nothing "
               "carries it) put it on the surface of the soil, which lies on the right of the way "
               "from `from` to `to`",
               kTractionDepth, i + 1);
    }
  } else {
    validate(config.tractions.empty(), "tractions act in plane strain (this run has 3 dimensions)");
  }
}

}  // namespace

template <int Dim>
Simulation<Dim> make_simulation(const ParticleSet& particles, const FlowConfig& config) {
  check(particles);
  check(config);
  validate(particles.dim == Dim, "the particles have {} dimensions (this run has {})",
           particles.dim, Dim);
  validate(particles.size() > 0, "there are no particles to run");
  expect_reference_length(particles, config);
  Simulation<Dim> s = make_scene<Dim>(config);
  for (const MaterialSpec& spec : particles.materials)
    s.materials.push_back(solver_material<Dim>(spec, config));
  load_points(particles, s.points);
  load_states(particles, s.points);
  check_places(s, particles.id);
  measure_points(s);
  add_tractions(config, s);
  return s;
}

template Simulation<2> make_simulation<2>(const ParticleSet&, const FlowConfig&);
template Simulation<3> make_simulation<3>(const ParticleSet&, const FlowConfig&);

}  // namespace flowslide::mpm
