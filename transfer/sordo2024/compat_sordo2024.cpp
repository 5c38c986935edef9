#include "transfer/sordo2024/compat_sordo2024.hpp"

#include "transfer/sordo2024/compat_sordo2024_material.hpp"
#include "transfer/sordo2024/radial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace flowslide {
namespace {

// Gauss points are cut short as in the script (S16).
constexpr double kGauss = 0.57735;
constexpr std::array<Vec2, 4> kCorner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Bilinear shape functions at point p of an element, points in the order of the nodes.
std::array<double, 4> shape(int p) {
  std::array<double, 4> n{};
  for (int a = 0; a < 4; ++a) {
    n[a] = 0.25 * (1.0 + kGauss * kCorner[p][0] * kCorner[a][0]) *
           (1.0 + kGauss * kCorner[p][1] * kCorner[a][1]);
  }
  return n;
}

/// What the script calls the state at its step: the nodal and element fields it reads.
struct State {
  std::vector<Vec2> position;      ///< nodes [m]
  std::vector<Vec2> displacement;  ///< nodes [m], zero in the gravity state (S17)
  std::vector<Vec2> velocity;      ///< nodes [m/s]
  const FemFrame* frame;
  double base_shift = 0.0;  ///< [m]
};

void check_sizes(const QuadMesh& mesh, const FemFrame& f, const char* what, bool moving) {
  const bool nodes = f.pore_pressure.size() == mesh.num_nodes() &&
                     (!moving || (f.displacement.size() == mesh.num_nodes() &&
                                  f.velocity.size() == mesh.num_nodes()));
  validate(nodes,
           "the {} of the history lacks pore pressure, displacement or velocity of the {} nodes "
           "(the script transfers them) import these recorders as well",
           what, mesh.num_nodes());
  validate(f.stress.size() == mesh.num_elements() && f.strain.size() == mesh.num_elements(),
           "the {} of the history has {} stresses and {} strains for {} elements (the script "
           "interpolates both) import the stress and the strain recorder",
           what, f.stress.size(), f.strain.size(), mesh.num_elements());
}

std::size_t find_base_node(const QuadMesh& mesh, int tag) {
  const auto it = std::find(mesh.node_tags.begin(), mesh.node_tags.end(), tag);
  validate(it != mesh.node_tags.end(),
           "base_node: the mesh has no node {} (its displacement is subtracted from all "
           "points) give the tag of the bottom left node of the dam",
           tag);
  const auto node = static_cast<std::size_t>(it - mesh.node_tags.begin());
  double bottom = std::numeric_limits<double>::infinity();
  for (const Vec2& x : mesh.nodes) bottom = std::min(bottom, x[1]);
  validate(mesh.nodes[node][1] == bottom,
           "base_node: node {} at ({:.6g}, {:.6g}) m is not on the base y = {:.6g} m (its "
           "displacement is subtracted as that of the base) give the bottom left node of the dam",
           tag, mesh.nodes[node][0], mesh.nodes[node][1], bottom);
  return node;
}

State read_state(const QuadMesh& mesh, const FemFrame& gravity, const FemFrame* shaking,
                 const SordoConfig& config) {
  check_sizes(mesh, gravity, "gravity state", false);
  State s;
  s.position = mesh.nodes;
  s.frame = shaking == nullptr ? &gravity : shaking;
  if (shaking == nullptr) {
    s.displacement.assign(mesh.num_nodes(), Vec2{0.0, 0.0});
    s.velocity = s.displacement;
    return s;
  }
  check_sizes(mesh, *shaking, "frame", true);
  s.displacement = shaking->displacement;
  s.velocity = shaking->velocity;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    for (int d = 0; d < 2; ++d) s.position[n][d] += s.displacement[n][d];
  }
  s.base_shift = s.displacement[find_base_node(mesh, config.base_node)][0];
  return s;
}

/// Six fields at the points: xx, yy, xy of effective stress [Pa] and of strain (S14).
Eigen::MatrixXd interpolate_fields(const QuadMesh& mesh, const State& s,
                                   const std::vector<Vec2>& points) {
  std::vector<Vec2> centres(mesh.num_elements());
  Eigen::MatrixXd values(static_cast<Eigen::Index>(mesh.num_elements()), 6);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    centres[e] = centroid(corners(mesh, s.position, e));
    const Stress<2>& stress = s.frame->stress[e];
    const StrainIncrement<2>& strain = s.frame->strain[e];
    values.row(static_cast<Eigen::Index>(e)) << stress[0], stress[1], stress[3], strain[0],
        strain[1], strain[3];
  }
  return interpolate_multiquadric(centres, values, points);
}

double element_density(const QuadMesh& mesh, const SordoConfig& c, std::size_t e) {
  const int tag = mesh.element_material[e];
  const std::vector<double>* row = find_row(c.densities, tag);
  validate(row != nullptr,
           "densities has no row for material {} of element {} (its points would have no "
           "mass) add [{}, <density> kg/m3]",
           tag, mesh.element_tags[e], tag);
  return (*row)[1];
}

bool is_kept(const SordoConfig& c, const Vec2& x) {
  return !(x[0] < c.keep_x[0] || x[0] > c.keep_x[1] || x[1] < c.keep_y[0] || x[1] > c.keep_y[1]);
}

double interpolate(const std::array<double, 4>& n, const std::array<double, 4>& nodal) {
  return n[0] * nodal[0] + n[1] * nodal[1] + n[2] * nodal[2] + n[3] * nodal[3];
}

/// Nodal values of an element.
template <class F>
std::array<double, 4> gather(const QuadMesh& mesh, std::size_t e, F&& value) {
  std::array<double, 4> r{};
  for (int a = 0; a < 4; ++a) r[a] = value(static_cast<std::size_t>(mesh.elements[e][a]));
  return r;
}

std::array<double, 3> interpolate(const QuadMesh& mesh, std::size_t e,
                                  const std::array<double, 4>& n, const std::vector<Vec2>& field) {
  std::array<double, 3> r{};
  for (int d = 0; d < 2; ++d)
    r[d] = interpolate(n, gather(mesh, e, [&](std::size_t a) { return field[a][d]; }));
  return r;
}

/// sqrt(2/3 e:e) with the volume change of the element taken from the interpolated strain, and
/// without e_33 (S05, S07).
double script_deviatoric_strain(double xx, double yy, double gamma, double epsilon_v) {
  const double e11 = xx - epsilon_v / 3.0;
  const double e22 = yy - epsilon_v / 3.0;
  return std::sqrt(2.0 / 3.0) * std::sqrt(e11 * e11 + e22 * e22 + gamma * gamma / 2.0);
}

/// Replaces tags by indices into `materials`, which come in the order of their tags.
void index_materials(ParticleSet& set, const SordoConfig& config) {
  std::map<int, std::int32_t> index;
  for (const std::int32_t tag : set.material) index.emplace(tag, 0);
  for (auto& [tag, i] : index) {
    i = static_cast<std::int32_t>(set.materials.size());
    set.materials.push_back(sordo_material(config, tag));
  }
  for (std::int32_t& m : set.material) m = index.at(m);
}

/// What the four points of an element share.
struct Element {
  std::size_t index;
  int material;                  ///< tag
  double density;                ///< [kg/m3]
  double area_0, area_t;         ///< [m2]
  double epsilon_v;              ///< of the element (S07)
  double sigma_v;                ///< after gravity, tension positive [Pa]
  std::array<double, 4> u, r_u;  ///< at the nodes; r_u by the element's sigma_v (S08)
};

Element read_element(const QuadMesh& mesh, const FemFrame& gravity, const State& state,
                     const SordoConfig& config, std::size_t e) {
  Element r;
  r.index = e;
  r.material = mesh.element_material[e];
  r.density = element_density(mesh, config, e);
  r.area_0 = area(corners(mesh, mesh.nodes, e));
  r.area_t = area(corners(mesh, state.position, e));
  validate(r.area_t > 0.0,
           "element {} has the deformed area {:.4g} m2 (its points would have no volume) transfer "
           "an earlier frame",
           mesh.element_tags[e], r.area_t);
  r.epsilon_v = (r.area_t - r.area_0) / r.area_0;
  r.sigma_v = gravity.stress[e][1];
  const std::vector<double>& u = state.frame->pore_pressure;
  const bool moving = state.frame != &gravity;
  r.u = gather(mesh, e, [&](std::size_t n) { return u[n]; });
  r.r_u = gather(mesh, e, [&](std::size_t n) {
    return moving ? (u[n] - gravity.pore_pressure[n]) / -r.sigma_v : 0.0;
  });
  return r;
}

void append_history(ParticleSet& set, const SordoConfig& config, const Element& e, int tag,
                    double strain_xx, double strain_yy, double gamma_xy) {
  const auto put = [&set](const char* name, double value) { set.history[name].push_back(value); };
  const bool softens = e.material != config.foundation;
  const double eps_q =
      softens ? script_deviatoric_strain(strain_xx, strain_yy, gamma_xy, e.epsilon_v) : 0.0;
  const std::array<double, 2> strength =
      softens ? sordo_softened(config, tag, eps_q) : std::array{0.0, 0.0};
  put("strain_xx", strain_xx);
  put("strain_yy", strain_yy);
  put("gamma_xy", gamma_xy);
  put("epsilon_v", e.epsilon_v);
  put("material_id", tag);
  put("nstate_vars", softens ? 7.0 : 0.0);
  put("svars_0", strength[0]);
  put("svars_2", strength[1]);
  put("svars_6", eps_q);
  for (const char* zero : {"svars_1", "svars_3", "svars_4", "svars_5"}) put(zero, 0.0);
  put("plastic_strain", eps_q);
}

}  // namespace

ParticleSet map_sordo2024(const QuadMesh& mesh, const FemFrame& gravity, const FemFrame* shaking,
                          const SordoConfig& config) {
  check(config);
  const State state = read_state(mesh, gravity, shaking, config);
  const std::array<std::array<double, 4>, 4> shapes{shape(0), shape(1), shape(2), shape(3)};
  std::vector<Vec2> points;
  points.reserve(4 * mesh.num_elements());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    for (const std::array<double, 4>& n : shapes) {
      const std::array<double, 3> x = interpolate(mesh, e, n, state.position);
      points.push_back({x[0], x[1]});
    }
  }
  const Eigen::MatrixXd fields = interpolate_fields(mesh, state, points);

  ParticleSet set;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Element element = read_element(mesh, gravity, state, config, e);
    for (std::size_t p = 0; p < 4; ++p) {
      const Vec2& x = points[4 * e + p];
      if (!is_kept(config, {x[0] - state.base_shift, x[1]})) continue;
      const std::array<double, 4>& n = shapes[p];
      const Eigen::RowVectorXd f = fields.row(static_cast<Eigen::Index>(4 * e + p));
      const double u = interpolate(n, element.u);
      const double r_u = interpolate(n, element.r_u);
      const std::optional<int> tag =
          sordo_runout_tag(config, {x, r_u, element.sigma_v, element.material});
      validate(tag.has_value(),
               "element {} has an initial vertical effective stress of exactly {:.6g} Pa (the "
               "script gives its points no material there) shift the last row of layers",
               mesh.element_tags[e], -element.sigma_v);
      std::array<double, 3> displacement = interpolate(mesh, e, n, state.displacement);
      displacement[0] -= state.base_shift;
      set.position.push_back({x[0] - state.base_shift, x[1], 0.0});
      set.velocity.push_back(interpolate(mesh, e, n, state.velocity));
      set.displacement.push_back(displacement);
      set.mass.push_back(element.area_0 / 4.0 * element.density);
      set.volume.push_back(element.area_t / 4.0);
      set.stress.push_back({f[0] - u, f[1] - u, 0.0, f[2], 0.0, 0.0});
      set.pore_pressure.push_back(0.0);
      set.material.push_back(*tag);
      set.id.push_back(static_cast<std::int64_t>(set.id.size()));
      set.history["r_u"].push_back(std::isfinite(r_u) ? r_u : kUnset);
      set.history["pore_pressure_transfer"].push_back(u);
      append_history(set, config, element, *tag, f[3], f[4], f[5]);
    }
  }
  validate(set.size() > 0,
           "no point of the {} elements lies inside keep_x and keep_y (nothing is left to "
           "run out) check their units and signs",
           mesh.num_elements());
  index_materials(set, config);
  set.notes = sordo2024_defects();
  return set;
}

ParticleSet map_sordo2024(const FemHistory& history, const SordoConfig& config) {
  if (config.frame < 0) return map_sordo2024(history.mesh(), history.gravity(), nullptr, config);
  const std::size_t count = history.times().size();
  validate(static_cast<std::size_t>(config.frame) < count,
           "frame is {} but the history has {} frames (rows count from 0) give one of 0 to "
           "{}, or -1 for gravity",
           config.frame, count, static_cast<long>(count) - 1);
  const FemFrame frame = history.frame(static_cast<std::size_t>(config.frame));
  return map_sordo2024(history.mesh(), history.gravity(), &frame, config);
}

}  // namespace flowslide
