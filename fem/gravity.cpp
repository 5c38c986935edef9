#include "fem/gravity.hpp"

#include "fem/stiffness.hpp"

#include <cmath>

#include <Eigen/SparseCholesky>

namespace flowslide::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Unknowns that gravity moves: all but those at the base. Others get `count`.
std::vector<std::int32_t> free_unknowns(const Model& model, std::int32_t& count) {
  std::vector<std::int32_t> number(model.num_dofs + 1, 0);
  number[model.num_dofs] = -1;
  for (const std::int32_t u : model.base_dofs) number[u] = -1;
  count = 0;
  for (std::int32_t& n : number)
    if (n == 0) n = count++;
  return number;
}

Eigen::VectorXd elastic_displacements(const Solver& s) {
  std::int32_t count = 0;
  const std::vector<std::int32_t> number = free_unknowns(s.model, count);
  std::vector<Eigen::Triplet<double>> terms;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(count);
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (number[u] >= 0) rhs[number[u]] = s.layout.weight[u] + s.model.load[u];
  const Elements& g = s.layout.elements;
  for (std::size_t e = 0; e < g.size(); ++e) {
    const auto K = stiffness(s, e, gravity_elasticity(s.model.materials[s.layout.material[e]]));
    const double push = g.volume[e] * (s.layout.saturated[e] ? mean_pressure(s, e) : 0.0);
    for (int i = 0; i < 8; ++i) {
      const std::int32_t row = number[s.layout.dofs[e][i]];
      if (row < 0) continue;
      rhs[row] += push * (i % 2 == 0 ? g.bx[i / 2][e] : g.by[i / 2][e]);
      for (int j = 0; j < 8; ++j) {
        const std::int32_t column = number[s.layout.dofs[e][j]];
        if (column >= 0) terms.emplace_back(row, column, K(i, j));
      }
    }
  }
  Sparse K(count, count);
  K.setFromTriplets(terms.begin(), terms.end());
  const Eigen::SimplicialLDLT<Sparse> factor(K);
  Eigen::VectorXd x;
  if (factor.info() == Eigen::Success) x = factor.solve(rhs);
  if (factor.info() != Eigen::Success || !x.allFinite() || !(factor.vectorD().minCoeff() > 0.0))
    throw NumericsError(
        "the section under its own weight has no state of rest (its stiffness matrix is singular) "
        "a part of the mesh is not connected to the base, or its sides are free to slide");
  Eigen::VectorXd all = Eigen::VectorXd::Zero(s.model.num_dofs + 1);
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (number[u] >= 0) all[u] = x[number[u]];
  return all;
}

double out_of_plane(const Material& m, double sxx, double syy) {
  return std::visit(
      [&]<class M>(const flowslide::Material<M>&) {
        return rest_out_of_plane<M>(m.gravity_poisson, sxx, syy);
      },
      m.law);
}

/// The state of the law of element `e` at its stress at rest.
void set_rest_state(Solver& s, std::size_t e, double volumetric_strain) {
  const std::int32_t material = s.layout.material[e];
  std::visit(
      [&]<class M>(const flowslide::Material<M>& law) {
        state_of<M>(s, e) = rest_state<M>(law.params, constants_of<M>(s, material),
                                          s.state.stress[e], volumetric_strain);
      },
      s.model.materials[material].law);
}

}  // namespace

void solve_gravity(Solver& s, const GravitySettings& settings) {
  PressureSystem settling = s.water;
  if (is_set(settings.permeability)) {
    const double mobility = settings.permeability / (s.model.fluid.density * s.model.gravity);
    for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
      settling.mobility_x[e] = settling.mobility_y[e] = s.layout.saturated[e] ? mobility : 0.0;
  }
  s.state.pressure = steady_pressure(s.model, s.layout, settling);
  const Eigen::VectorXd u = elastic_displacements(s);
  const Elements& g = s.layout.elements;
  for (std::size_t e = 0; e < g.size(); ++e) {
    const Material& material = s.model.materials[s.layout.material[e]];
    Eigen::Matrix<double, 8, 1> local;
    for (int i = 0; i < 8; ++i) local[i] = u[s.layout.dofs[e][i]];
    const Eigen::Vector3d strain = strain_matrix(g, e) * local;
    const Eigen::Vector3d stress = plane_strain(gravity_elasticity(material)) * strain;
    s.state.stress[e] = {
        {stress[0], stress[1], out_of_plane(material, stress[0], stress[1]), stress[2]}};
    double hx = 0.0, hy = 0.0;
    for (int i = 0; i < 4; ++i) {
      hx += g.gamma[i][e] * local[2 * i];
      hy += g.gamma[i][e] * local[2 * i + 1];
    }
    s.state.hourglass_x[e] = hx;
    s.state.hourglass_y[e] = hy;
    set_rest_state(s, e, settings.compacts ? -(strain[0] + strain[1]) : 0.0);
  }
}

void spread_softening(Solver& s, double length) {
  each_law(s.layout, 0, s.layout.elements.size(),
           [&]<class M>(std::size_t first, std::size_t last) {
             for (std::size_t e = first; e < last; ++e)
               set_band<M>(state_of<M>(s, e), length / std::sqrt(s.layout.elements.area[e]));
           });
}

double out_of_balance(Solver& s) {
  start_motion(s);
  double worst = 0.0, heaviest = 0.0;
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
    const double force = s.layout.forces.sum(u, s.entry_force.data());
    const double weight = s.layout.weight[u] + s.model.load[u];
    bool base = false;
    for (const std::int32_t b : s.model.base_dofs) base = base || b == u;
    if (!base) worst = std::max(worst, std::abs(weight - force));
    heaviest = std::max(heaviest, std::abs(s.layout.weight[u]));
  }
  return worst / heaviest;
}

}  // namespace flowslide::fem
