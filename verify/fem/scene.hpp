#pragma once
#include "core/elementary.hpp"
#include "fem/build_model.hpp"
#include "fem/gravity.hpp"
#include "fem/run.hpp"
#include "fem/time_step.hpp"

#include <cmath>

/// Rectangles of one soil.
namespace flowslide::fem {

inline constexpr double kUnitWeight = 9810.0;  ///< of water [N/m3]

struct Rectangle {
  int columns = 4, rows = 4;
  double width = 4.0, height = 4.0;  ///< [m]
  double distortion = 0.0;           ///< of inner nodes, in cells
};

inline SectionMesh section(const Rectangle& r) {
  SectionMesh s;
  const int nx = r.columns + 1;
  const double dx = r.width / r.columns, dy = r.height / r.rows;
  for (int j = 0; j <= r.rows; ++j)
    for (int i = 0; i <= r.columns; ++i) {
      const bool inner = i > 0 && i < r.columns && j > 0 && j < r.rows;
      const double shift = inner ? r.distortion : 0.0;
      s.mesh.nodes.push_back(
          {(i + shift * sin(3.0 * i + 5.0 * j)) * dx, (j + shift * cos(4.0 * i + 2.0 * j)) * dy});
      s.mesh.node_tags.push_back(1 + j * nx + i);
    }
  for (int j = 0; j < r.rows; ++j)
    for (int i = 0; i < r.columns; ++i) {
      const std::int32_t a = j * nx + i;
      s.mesh.elements.push_back({a, a + 1, a + 1 + nx, a + nx});
      s.mesh.element_tags.push_back(1 + j * r.columns + i);
      s.mesh.element_material.push_back(1);
    }
  s.materials = {{"soil", 1}};
  EdgeSet base{"base", {}}, right{"right", {}}, surface{"surface", {}}, left{"left", {}};
  for (int i = 0; i < r.columns; ++i) {
    base.edges.push_back({i, i + 1});
    surface.edges.push_back({r.rows * nx + r.columns - i, r.rows * nx + r.columns - i - 1});
  }
  for (int j = 0; j < r.rows; ++j) {
    right.edges.push_back({j * nx + r.columns, (j + 1) * nx + r.columns});
    left.edges.push_back({(r.rows - j) * nx, (r.rows - j - 1) * nx});
  }
  s.sets = {base, right, surface, left};
  return s;
}

inline FemMaterialConfig soil() {
  FemMaterialConfig m;
  m.density = 1900.0;
  m.void_ratio = 0.8;
  m.permeability = {1e-5, 1e-6};
  return m;
}

inline FemMaterialConfig elastic_soil(double young = 50e6, double poisson = 0.3) {
  FemMaterialConfig m = soil();
  m.laws.of<LinearElastic>() = LinearElastic::Params{young, poisson};
  m.k0 = poisson / (1.0 - poisson);
  return m;
}

inline FemMaterialConfig sand(double Dr = 0.35, double G0 = 476.0, double hpo = 0.53) {
  FemMaterialConfig m = soil();
  PM4Sand::Params p;
  p.Dr = Dr;
  p.G0 = G0;
  p.hpo = hpo;
  m.laws.of<PM4Sand>() = p;
  return m;
}

/// Rigid base, water up to `table`, no damping.
inline FemConfig config(const FemMaterialConfig& material, double table) {
  FemConfig c;
  c.materials["soil"] = material;
  c.water = WaterConfig{};
  c.water->table = {{0.0, table}};
  c.base.motion = BaseMotionKind::within;
  c.sides.kind = SideKind::tied;
  c.damping.mass = 0.0;
  c.damping.stiffness = 0.0;
  return c;
}

/// A solver at rest, ready to move with `courant` of its stable step.
inline Solver at_rest(const Model& model, const FemConfig& c, double courant = 0.5) {
  Solver r = make_solver(model, {c.damping.mass.value(), c.damping.stiffness.value()});
  solve_gravity(r, {});
  refresh_moduli(r);
  if (c.damping.largest_ratio) limit_stiffness_damping(r, *c.damping.largest_ratio);
  for (std::size_t e = 0; e < r.layout.elements.size(); ++e)
    r.water.alpha[e] =
        c.stabilisation.pressure * r.layout.elements.area[e] / (r.lambda[e] + 2.0 * r.shear[e]);
  const double water = water_frequency(r);
  start_motion(r);
  r.dt = courant * stable_step(r, water);
  return r;
}
inline Solver at_rest(const SectionMesh& s, const FemConfig& c, double courant = 0.5) {
  return at_rest(build_model(s, c), c, courant);
}

}  // namespace flowslide::fem
