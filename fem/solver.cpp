#include "fem/solver.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide::fem {

double Energy::error() const {
  const double sum = std::abs(kinetic) + std::abs(deformation) + std::abs(damping) +
                     std::abs(weight) + std::abs(base);
  return sum > 0.0 ? std::abs(kinetic + deformation + damping - weight - base) / sum : 0.0;
}

Elasticity gravity_elasticity(const Material& m) {
  if (const auto* pm4 = std::get_if<PM4Sand::Params>(&m.law))
    return PM4Sand::gravity_elasticity(*pm4, m.gravity_poisson);
  if (const auto* mc = std::get_if<MohrCoulomb::Params>(&m.law))
    return Elasticity::from_young(mc->youngs_modulus, m.gravity_poisson);
  return Elasticity::from_young(std::get<LinearElastic::Params>(m.law).youngs_modulus,
                                m.gravity_poisson);
}

namespace {

LawConstants make_laws(const Model& model) {
  LawConstants r;
  r.pm4sand.resize(model.materials.size());
  r.mohr_coulomb.resize(model.materials.size());
  r.linear_elastic.resize(model.materials.size());
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const Law& law = model.materials[i].law;
    if (const auto* pm4 = std::get_if<PM4Sand::Params>(&law))
      r.pm4sand[i] = PM4Sand::constants(*pm4);
    else if (const auto* mc = std::get_if<MohrCoulomb::Params>(&law))
      r.mohr_coulomb[i] = MohrCoulomb::constants(*mc, 1.0);
    else
      r.linear_elastic[i] = LinearElastic::constants(std::get<LinearElastic::Params>(law), 1.0);
  }
  return r;
}

}  // namespace

Solver make_solver(const Model& model, const Damping& damping) {
  check(model);
  Solver s;
  s.model = model;
  s.layout = make_layout(model);
  s.water = make_pressure_system(model, s.layout);
  s.laws = make_laws(model);
  s.damping = damping;
  const std::size_t n = s.layout.elements.size(), dofs = model.num_dofs + 1;
  s.hourglass_shear.resize(n);
  for (std::size_t e = 0; e < n; ++e)
    s.hourglass_shear[e] = gravity_elasticity(model.materials[s.layout.material[e]]).shear;
  State& t = s.state;
  t.displacement.assign(dofs, 0.0);
  t.velocity.assign(dofs, 0.0);
  t.pressure.assign(model.mesh.num_nodes(), 0.0);
  t.stress.resize(n);
  t.hourglass_x.assign(n, 0.0);
  t.hourglass_y.assign(n, 0.0);
  t.pm4sand.resize(s.layout.law_begin[1]);
  t.mohr_coulomb.resize(s.layout.law_begin[2] - s.layout.law_begin[1]);
  s.lambda.assign(n, 0.0);
  s.shear.assign(n, 0.0);
  s.strain.assign(3 * n, 0.0);
  s.entry_force.assign(8 * n, 0.0);
  s.entry_flow.assign(4 * n, 0.0);
  s.pressure_rate.assign(s.water.num_equations + 1, 0.0);
  const auto chunks = [](std::size_t count) { return (count + kChunk - 1) / kChunk; };
  s.element_sums.resize(chunks(n));
  s.unknown_sums.resize(chunks(model.num_dofs));
  s.dashpot.assign(dofs, 0.0);
  s.base_drive.assign(dofs, 0.0);
  s.prescribed.assign(dofs, 0);
  for (std::size_t i = 0; i < model.base_dofs.size(); ++i) {
    const std::int32_t u = model.base_dofs[i];
    if (model.base_dashpots.empty())
      s.prescribed[u] = 1;
    else
      s.dashpot[u] = s.base_drive[u] = model.base_dashpots[i];
  }
  for (std::size_t u = 0; u < dofs; ++u) s.dashpot[u] += damping.mass * s.layout.mass[u];
  return s;
}

double hourglass_stress(const Solver& s, std::size_t e) {
  const Elements& g = s.layout.elements;
  const double qx = s.state.hourglass_x[e], qy = s.state.hourglass_y[e];
  const double energy = g.hss[e] * qx * qx - 2.0 * g.hst[e] * qx * qy + g.htt[e] * qy * qy;
  return s.hourglass_shear[e] * std::sqrt(std::max(0.0, energy) / g.volume[e]);
}

void let_hourglass_yield(Solver& s) {
  s.hourglass_strength.resize(s.model.materials.size());
  for (std::size_t m = 0; m < s.model.materials.size(); ++m) {
    const Law& law = s.model.materials[m].law;
    if (std::holds_alternative<PM4Sand::Params>(law)) {
      s.hourglass_strength[m] = {0.0, 0.5 * s.laws.pm4sand[m].M};
    } else if (const auto* mc = std::get_if<MohrCoulomb::Params>(&law)) {
      s.hourglass_strength[m] = {mc->cohesion * cos(mc->friction_angle),
                                 sin(mc->friction_angle)};
    } else {
      s.hourglass_strength[m] = {std::numeric_limits<double>::infinity(), 0.0};
    }
  }
  s.hourglass_rest.resize(s.layout.elements.size());
  for (std::size_t e = 0; e < s.hourglass_rest.size(); ++e)
    s.hourglass_rest[e] = hourglass_stress(s, e);
}

void refresh_moduli(Solver& s) {
  const Layout& l = s.layout;
  const auto set = [&](std::size_t e, const Elasticity& c) {
    s.lambda[e] = c.bulk - 2.0 / 3.0 * c.shear;
    s.shear[e] = c.shear;
  };
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < l.elements.size(); ++e) {
    const std::int32_t m = l.material[e];
    if (e < l.law_begin[1])
      set(e, PM4Sand::elasticity(s.laws.pm4sand[m], s.state.pm4sand[e], s.state.stress[e]));
    else if (e < l.law_begin[2])
      set(e, s.laws.mohr_coulomb[m].elastic);
    else
      set(e, s.laws.linear_elastic[m].elastic);
  }
}

}  // namespace flowslide::fem
