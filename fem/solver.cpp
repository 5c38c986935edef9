#include "fem/solver.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::fem {

double Energy::error() const {
  const double sum = std::abs(kinetic) + std::abs(deformation) + std::abs(damping) +
                     std::abs(weight) + std::abs(base);
  return sum > 0.0 ? std::abs(kinetic + deformation + damping - weight - base) / sum : 0.0;
}

Elasticity gravity_elasticity(const Material& m) {
  return std::visit(
      [&]<class M>(const flowslide::Material<M>& law) {
        return rest_elasticity<M>(law.params, m.gravity_poisson);
      },
      m.law);
}

namespace {

void set_constants(Solver& s) {
  const std::vector<Material>& materials = s.model.materials;
  ShakingLaws::each(
      [&]<class M>() { std::get<LawConstants<M>>(s.laws).of.resize(materials.size()); });
  for (std::size_t i = 0; i < materials.size(); ++i)
    std::visit(
        [&]<class M>(const flowslide::Material<M>& law) {
          std::get<LawConstants<M>>(s.laws).of[i] = shaking_constants<M>(law.params);
        },
        materials[i].law);
}

}  // namespace

Solver make_solver(const Model& model, const Damping& damping) {
  check(model);
  Solver s;
  s.model = model;
  s.layout = make_layout(model);
  s.water = make_pressure_system(model, s.layout);
  set_constants(s);
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
  each_law(s.layout, 0, n, [&]<class M>(std::size_t first, std::size_t last) {
    std::get<LawStates<M>>(t.laws).of.resize(last - first);
  });
  s.stiffness_damping.assign(n, damping.stiffness);
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
  for (std::size_t m = 0; m < s.model.materials.size(); ++m)
    s.hourglass_strength[m] = std::visit(
        []<class M>(const flowslide::Material<M>& law) { return M::shear_strength(law.params); },
        s.model.materials[m].law);
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
  each_law(l, 0, l.elements.size(), [&]<class M>(std::size_t first, std::size_t last) {
#pragma omp parallel for schedule(static)
    for (std::size_t e = first; e < last; ++e)
      set(e, present_elasticity<M>(constants_of<M>(s, l.material[e]), state_of<M>(s, e),
                                   s.state.stress[e]));
  });
}

}  // namespace flowslide::fem
