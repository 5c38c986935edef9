#include "fem/pressure.hpp"

#include <algorithm>

namespace flowslide::fem {

using Sparse = Eigen::SparseMatrix<double>;

namespace {

/// sum over elements of V (cx b_x b_x + cy b_y b_y) between unknown pressures.
Sparse gradient_matrix(const PressureSystem& s, const Layout& l, const auto& coefficient) {
  std::vector<Eigen::Triplet<double>> terms;
  for (std::size_t e = 0; e < l.elements.size(); ++e) {
    if (!l.saturated[e]) continue;
    const auto [cx, cy] = coefficient(e);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const std::int32_t row = s.equation[l.nodes[e][i]], column = s.equation[l.nodes[e][j]];
        if (row == s.num_equations || column == s.num_equations) continue;
        terms.emplace_back(row, column,
                           l.elements.volume[e] * (cx * l.elements.bx[i][e] * l.elements.bx[j][e] +
                                                   cy * l.elements.by[i][e] * l.elements.by[j][e]));
      }
    }
  }
  Sparse m(s.num_equations, s.num_equations);
  m.setFromTriplets(terms.begin(), terms.end());
  return m;
}

}  // namespace

PressureSystem make_pressure_system(const Model& model, const Layout& l) {
  const std::size_t n = l.elements.size();
  PressureSystem s;
  std::vector<std::uint8_t> wet(model.mesh.num_nodes(), 0);
  for (std::size_t e = 0; e < n; ++e)
    if (l.saturated[e])
      for (const std::int32_t node : l.nodes[e]) wet[node] = 1;
  s.equation.resize(model.mesh.num_nodes());
  for (std::size_t i = 0; i < s.equation.size(); ++i)
    if (wet[i] && !is_set(model.known_pressure[i]))
      s.equation[i] = s.num_equations++;
    else
      s.equation[i] = -1;
  std::replace(s.equation.begin(), s.equation.end(), -1, s.num_equations);

  s.mobility_x.assign(n, 0.0);
  s.mobility_y.assign(n, 0.0);
  s.alpha.assign(n, 0.0);
  s.storage.assign(s.num_equations + 1, 0.0);
  std::vector<std::int32_t> unknown(4 * n, s.num_equations);
  const double unit_weight = model.fluid.density * model.gravity;
  for (std::size_t e = 0; e < n; ++e) {
    if (!l.saturated[e]) continue;
    const Material& m = model.materials[l.material[e]];
    s.mobility_x[e] = m.permeability[0] / unit_weight;
    s.mobility_y[e] = m.permeability[1] / unit_weight;
    for (int i = 0; i < 4; ++i) {
      unknown[4 * e + i] = s.equation[l.nodes[e][i]];
      s.storage[unknown[4 * e + i]] +=
          0.25 * m.porosity / model.fluid.bulk_modulus * l.elements.volume[e];
    }
  }
  s.flow = make_gather(unknown, s.num_equations);
  s.factor = BandFactor(gradient_matrix(s, l, [](std::size_t) { return std::pair(1.0, 1.0); }));
  return s;
}

std::vector<double> steady_pressure(const Model& model, const Layout& l, const PressureSystem& s) {
  const double unit_weight = model.fluid.density * model.gravity;
  std::vector<double> u(model.mesh.num_nodes());
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = is_set(model.known_pressure[i]) ? model.known_pressure[i] : 0.0;
  if (s.num_equations == 0) return u;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(s.num_equations + 1);
  for (std::size_t e = 0; e < l.elements.size(); ++e) {
    if (!l.saturated[e]) continue;
    double gx = 0.0, gy = unit_weight;
    for (int i = 0; i < 4; ++i) {
      gx += l.elements.bx[i][e] * u[l.nodes[e][i]];
      gy += l.elements.by[i][e] * u[l.nodes[e][i]];
    }
    for (int i = 0; i < 4; ++i)
      rhs[s.equation[l.nodes[e][i]]] -=
          l.elements.volume[e] *
          (s.mobility_x[e] * l.elements.bx[i][e] * gx + s.mobility_y[e] * l.elements.by[i][e] * gy);
  }
  BandFactor factor = s.factor;
  factor.factorise(gradient_matrix(
      s, l, [&](std::size_t e) { return std::pair(s.mobility_x[e], s.mobility_y[e]); }));
  factor.solve(rhs.data());
  for (std::size_t i = 0; i < u.size(); ++i)
    if (s.equation[i] < s.num_equations) u[i] = rhs[s.equation[i]];
  return u;
}

Sparse storage_matrix(const PressureSystem& s, const Layout& l) {
  Sparse m =
      gradient_matrix(s, l, [&](std::size_t e) { return std::pair(s.alpha[e], s.alpha[e]); });
  for (std::int32_t i = 0; i < s.num_equations; ++i) m.coeffRef(i, i) += s.storage[i];
  return m;
}

void factorise(PressureSystem& s, const Layout& l, double dt) {
  s.factor_dt = dt;
  if (s.num_equations == 0) return;
  Sparse m = gradient_matrix(s, l, [&](std::size_t e) {
    return std::pair(s.alpha[e] + dt * s.mobility_x[e], s.alpha[e] + dt * s.mobility_y[e]);
  });
  for (std::int32_t i = 0; i < s.num_equations; ++i) m.coeffRef(i, i) += s.storage[i];
  s.factor.factorise(m);
}

}  // namespace flowslide::fem
