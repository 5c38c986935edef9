#include "fem/build_model.hpp"

#include "core/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace flowslide::fem {
namespace {

Material make_material(const std::string& name, const FemMaterialConfig& c) {
  Material m;
  m.name = name;
  m.law = flowslide::make_material(c.laws, name);
  m.density = c.density;
  m.porosity = c.void_ratio / (1.0 + c.void_ratio);
  m.permeability = c.permeability;
  if (c.permeability_rise)
    m.permeability_rise = {c.permeability_rise->factor, c.permeability_rise->exponent};
  m.gravity_poisson = c.k0 / (1.0 + c.k0);
  m.drained = c.drained;
  return m;
}

const FemMaterialConfig& settings_of(const MaterialName& m, const FemConfig& config) {
  const auto at = config.materials.find(m.name);
  validate(at != config.materials.end(),
           "the mesh has a material {} (tag {}) that materials does not describe", m.name, m.tag);
  return at->second;
}

void set_materials(Model& r, const SectionMesh& section, const FemConfig& config) {
  std::map<std::int32_t, std::int32_t> index;
  for (const MaterialName& m : section.materials) {
    index[m.tag] = static_cast<std::int32_t>(r.materials.size());
    r.materials.push_back(make_material(m.name, settings_of(m, config)));
  }
  for (const auto& [name, unused] : config.materials) (void)material_tag(section, name);
  r.material.reserve(r.mesh.num_elements());
  for (const std::int32_t tag : r.mesh.element_material) r.material.push_back(index.at(tag));
}

using Edge = std::array<std::int32_t, 2>;

/// Outer edges of the mesh with the columns, soil on the left.
struct Outline {
  std::vector<Edge> base, surface;
  std::vector<double> base_thickness, surface_thickness;
};

/// Pairs of nodes that move alike.
using Ties = std::vector<Edge>;

std::int32_t element_of(const QuadMesh& mesh, const Edge& edge) {
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    for (int i = 0; i < 4; ++i)
      if (mesh.elements[e][i] == edge[0] && mesh.elements[e][(i + 1) % 4] == edge[1])
        return static_cast<std::int32_t>(e);
  throw InputError(fmt::format("the edge between nodes {} and {} belongs to no element",
                               mesh.node_tags[edge[0]], mesh.node_tags[edge[1]]));
}

/// A column of soil beside each edge of an end, one element wide; its far side moves as its near
/// side, so that it shears but does not stretch.
void add_column(Model& r, Outline& outline, Ties& ties, const std::vector<Edge>& edges,
                double shift, double thickness) {
  std::map<std::int32_t, std::int32_t> far;
  const auto far_of = [&](std::int32_t node) {
    const auto [at, is_new] = far.try_emplace(node, static_cast<std::int32_t>(r.mesh.num_nodes()));
    if (is_new) {
      r.mesh.nodes.push_back({r.mesh.nodes[node][0] + shift, r.mesh.nodes[node][1]});
      r.mesh.node_tags.push_back(
          1 + *std::max_element(r.mesh.node_tags.begin(), r.mesh.node_tags.end()));
      ties.push_back({at->second, node});
    }
    return at->second;
  };
  for (const Edge& edge : edges) {
    const std::int32_t inside = element_of(r.mesh, edge);
    // the edge has its soil on the left; the column lies on its right
    r.mesh.elements.push_back({edge[1], edge[0], far_of(edge[0]), far_of(edge[1])});
    r.mesh.element_tags.push_back(
        1 + *std::max_element(r.mesh.element_tags.begin(), r.mesh.element_tags.end()));
    r.mesh.element_material.push_back(r.mesh.element_material[inside]);
    r.material.push_back(r.material[inside]);
    r.thickness.push_back(thickness);
  }
  if (edges.empty()) return;
  const auto by_height = [&](std::int32_t a, std::int32_t b) {
    return r.mesh.nodes[a][1] < r.mesh.nodes[b][1];
  };
  std::vector<std::int32_t> nodes;
  for (const auto& [near, unused] : far) nodes.push_back(near);
  const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end(), by_height);
  const bool left = shift < 0.0;
  outline.base.push_back(left ? Edge{far[*low], *low} : Edge{*low, far[*low]});
  outline.surface.push_back(left ? Edge{*high, far[*high]} : Edge{far[*high], *high});
  outline.base_thickness.push_back(thickness);
  outline.surface_thickness.push_back(thickness);
}

/// Nodes of the right end that have a partner at the same height on the left.
Ties tie_ends(const SectionMesh& section) {
  const auto& nodes = section.mesh.nodes;
  Ties ties;
  for (const std::int32_t right : nodes_of(find_set(section, "right"))) {
    bool found = false;
    for (const std::int32_t left : nodes_of(find_set(section, "left"))) {
      if (std::abs(nodes[left][1] - nodes[right][1]) > 1e-6) continue;
      ties.push_back({right, left});
      found = true;
    }
    validate(found,
             "sides.kind is tied, but node {} on the right at y = {} m has no partner on the left "
             "(tied ends need nodes at the same heights) mesh both ends alike, or take free_field",
             section.mesh.node_tags[right], nodes[right][1]);
  }
  return ties;
}

void number_unknowns(Model& r, const Outline& outline, const Ties& ties, const SectionMesh& section,
                     const FemConfig& config) {
  const std::size_t n = r.mesh.num_nodes();
  std::vector<std::array<std::int32_t, 2>> master(n);
  for (std::size_t i = 0; i < n; ++i) master[i].fill(static_cast<std::int32_t>(i));
  for (const Edge& t : ties) master[t[0]].fill(t[1]);
  std::vector<std::array<bool, 2>> fixed(n, {false, false});
  std::vector<std::uint8_t> at_base(n, 0);
  for (const Edge& edge : outline.base)
    for (const std::int32_t node : edge) {
      fixed[node][1] = true;
      at_base[node] = 1;
    }
  if (config.sides.kind == SideKind::fixed)
    for (const char* side : {"left", "right"})
      for (const std::int32_t node : nodes_of(find_set(section, side)))
        fixed[node][0] = !at_base[node];
  const std::int32_t first_base = outline.base.front()[0];
  const auto rigid = [&](std::size_t i) {
    return at_base[i] && (config.base.rigid_plane || !config.base.shear_wave_velocity);
  };
  const auto owner = [&](std::size_t i, int d) -> std::int32_t {
    if (d == 0 && rigid(i)) return first_base;
    return master[i][d];
  };
  std::vector<std::array<std::int32_t, 2>> number(n, {-1, -1});
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 2; ++d)
      if (owner(i, d) == static_cast<std::int32_t>(i) && !fixed[i][d]) number[i][d] = r.num_dofs++;
  r.dof.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 2; ++d) {
      const std::int32_t u = number[owner(i, d)][d];
      r.dof[i][d] = u < 0 || fixed[i][d] ? r.num_dofs : u;
    }
}

void set_base(Model& r, const Outline& outline, const FemBaseConfig& config) {
  std::vector<double> area(r.num_dofs + 1, 0.0);
  for (std::size_t k = 0; k < outline.base.size(); ++k) {
    const auto [a, b] = outline.base[k];
    const double half = 0.5 * std::abs(r.mesh.nodes[b][0] - r.mesh.nodes[a][0]);
    for (const std::int32_t node : outline.base[k])
      area[r.dof[node][0]] += half * outline.base_thickness[k];
  }
  for (std::int32_t u = 0; u < r.num_dofs; ++u) {
    if (area[u] == 0.0) continue;
    r.base_dofs.push_back(u);
    if (config.shear_wave_velocity)
      r.base_dashpots.push_back(*config.density * *config.shear_wave_velocity * area[u]);
  }
}

/// Known pressures, and the weight of water above the surface.
void set_water(Model& r, const Outline& outline, const SectionMesh& section,
               const FemConfig& config) {
  if (!config.water) {
    std::fill(r.known_pressure.begin(), r.known_pressure.end(), 0.0);
    return;
  }
  r.fluid = {config.water->bulk_modulus, config.water->density};
  const double unit_weight = r.fluid.density * r.gravity;
  const auto head = [&](std::int32_t node) {
    const auto [x, y] = r.mesh.nodes[node];
    return unit_weight * std::max(0.0, water_level(*config.water, x) - y);
  };
  for (std::size_t i = 0; i < r.mesh.num_nodes(); ++i)
    if (!(head(static_cast<std::int32_t>(i)) > 0.0)) r.known_pressure[i] = 0.0;
  for (const Edge& edge : outline.surface)
    for (const std::int32_t node : edge) r.known_pressure[node] = head(node);
  for (const std::string& drain : config.water->drains)
    for (const std::int32_t node : nodes_of(find_set(section, drain))) r.known_pressure[node] = 0.0;
  for (std::size_t k = 0; k < outline.surface.size(); ++k) {
    const auto [a, b] = outline.surface[k];
    const double pa = head(a), pb = head(b), t = outline.surface_thickness[k];
    // the outward normal times the length of the edge
    const double nx = r.mesh.nodes[b][1] - r.mesh.nodes[a][1];
    const double ny = r.mesh.nodes[a][0] - r.mesh.nodes[b][0];
    const std::array<double, 2> share{t * (2.0 * pa + pb) / 6.0, t * (pa + 2.0 * pb) / 6.0};
    for (int i = 0; i < 2; ++i) {
      r.load[r.dof[outline.surface[k][i]][0]] -= share[i] * nx;
      r.load[r.dof[outline.surface[k][i]][1]] -= share[i] * ny;
    }
  }
}

/// What lies beyond a column presses on it with the total horizontal stress of level ground, water
/// above it included: K_0 sigma'_v + u. Left out, the end of the section, which presses as much
/// from within, would shear the column outwards.
void hold_column(Model& r, const SectionMesh& section, const char* side, const FemConfig& config) {
  const QuadMesh& mesh = r.mesh;
  std::vector<Edge> edges = find_set(section, side).edges;
  const auto middle = [&mesh](const Edge& e) {
    return 0.5 * (mesh.nodes[e[0]][1] + mesh.nodes[e[1]][1]);
  };
  std::ranges::sort(edges, [&](const Edge& a, const Edge& b) { return middle(a) > middle(b); });
  const auto water_above = [&](double y) {
    if (!config.water) return 0.0;
    const double level = water_level(*config.water, mesh.nodes[edges.front()[0]][0]);
    return config.water->density * r.gravity * std::max(0.0, level - y);
  };
  double vertical = 0.0;  // total stress above the edge [Pa]
  for (const Edge& edge : edges) {
    const double rise = mesh.nodes[edge[1]][1] - mesh.nodes[edge[0]][1];  // outwards positive
    const double half = 0.5 * std::abs(rise);
    if (vertical == 0.0) vertical = water_above(middle(edge) + half);
    const Material& m = r.materials[r.material[element_of(mesh, edge)]];
    vertical += m.density * r.gravity * half;
    const double u = m.drained ? 0.0 : water_above(middle(edge));
    const double k0 = m.gravity_poisson / (1.0 - m.gravity_poisson);
    const double horizontal = u + k0 * std::max(0.0, vertical - u);
    vertical += m.density * r.gravity * half;
    for (const std::int32_t node : edge) {
      const std::int32_t d = r.dof[node][0];
      // the base is held while the section comes to rest
      if (std::ranges::find(r.base_dofs, d) == r.base_dofs.end())
        r.load[d] -= 0.5 * horizontal * rise;
    }
  }
}

}  // namespace

std::vector<HistoryMaterial> history_materials(const SectionMesh& section,
                                               const FemConfig& config) {
  std::vector<HistoryMaterial> materials;
  for (const MaterialName& m : section.materials) {
    const FemMaterialConfig& c = settings_of(m, config);
    std::string law;
    ShakingLaws::each([&]<class M>() {
      if (c.laws.of<M>()) law = M::name;
    });
    materials.push_back(
        {m.name, m.tag, c.density, c.void_ratio / (1.0 + c.void_ratio), std::move(law)});
  }
  return materials;
}

double water_level(const WaterConfig& water, double x) {
  const auto& table = water.table;
  if (x <= table.front()[0]) return table.front()[1];
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double x0 = table[i - 1][0], x1 = table[i][0];
    if (x <= x1 && x1 > x0)
      return table[i - 1][1] + (table[i][1] - table[i - 1][1]) * (x - x0) / (x1 - x0);
  }
  return table.back()[1];
}

Model build_model(const SectionMesh& section, const FemConfig& config) {
  flowslide::check(config);
  flowslide::check(section);
  Model r;
  r.mesh = section.mesh;
  r.gravity = config.gravity.acceleration;
  r.thickness.assign(r.mesh.num_elements(), 1.0);
  set_materials(r, section, config);
  Outline outline{find_set(section, "base").edges, find_set(section, "surface").edges, {}, {}};
  outline.base_thickness.assign(outline.base.size(), 1.0);
  outline.surface_thickness.assign(outline.surface.size(), 1.0);
  Ties ties;
  if (config.sides.kind == SideKind::free_field) {
    const double t = config.sides.thickness, w = config.sides.width;
    add_column(r, outline, ties, find_set(section, "left").edges, -w, t);
    add_column(r, outline, ties, find_set(section, "right").edges, w, t);
  } else if (config.sides.kind == SideKind::tied) {
    ties = tie_ends(section);
  }
  number_unknowns(r, outline, ties, section, config);
  r.load.assign(r.num_dofs + 1, 0.0);
  set_base(r, outline, config.base);
  r.known_pressure.assign(r.mesh.num_nodes(), kUnset);
  set_water(r, outline, section, config);
  if (config.sides.kind == SideKind::free_field)
    for (const char* side : {"left", "right"}) hold_column(r, section, side, config);
  return r;
}

Damping rayleigh(const FemDampingConfig& c) {
  const double w1 = 2.0 * kPi * c.frequencies[0], w2 = 2.0 * kPi * c.frequencies[1];
  Damping d{2.0 * c.ratio * w1 * w2 / (w1 + w2), 2.0 * c.ratio / (w1 + w2)};
  if (c.mass) d = {*c.mass, *c.stiffness};
  if (c.like_newmark) d.stiffness += (c.like_newmark->gamma - 0.5) * c.like_newmark->step;
  return d;
}

}  // namespace flowslide::fem
