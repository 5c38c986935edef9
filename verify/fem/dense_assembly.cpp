#include "verify/fem/dense_assembly.hpp"

namespace flowslide::fem {

Operators assemble(const Solver& s) {
  const Elements& g = s.layout.elements;
  const auto n = s.model.num_dofs + 1;
  const auto nodes = static_cast<Eigen::Index>(s.model.mesh.num_nodes());
  Operators r{Matrix::Zero(n, n), Matrix::Zero(n, nodes), Matrix::Zero(nodes, nodes),
              Matrix::Zero(nodes, nodes), Vector::Zero(nodes)};
  const double unit_weight = s.model.fluid.density * s.model.gravity;
  for (std::size_t e = 0; e < g.size(); ++e) {
    const double V = g.volume[e], G = s.shear[e], M = s.lambda[e] + 2.0 * G;
    const double porosity = s.model.materials[s.layout.material[e]].porosity;
    for (int i = 0; i < 4; ++i) {
      const auto ux = s.layout.dofs[e][2 * i], uy = s.layout.dofs[e][2 * i + 1];
      const double x = g.bx[i][e], y = g.by[i][e], gi = s.hourglass_shear[e] * g.gamma[i][e];
      const auto node = s.layout.nodes[e][i];
      r.S(node, node) += 0.25 * V * porosity / s.model.fluid.bulk_modulus;
      r.gravity_flow[node] += V * y * s.water.mobility_y[e] * unit_weight;
      for (int j = 0; j < 4; ++j) {
        const auto vx = s.layout.dofs[e][2 * j], vy = s.layout.dofs[e][2 * j + 1];
        const double a = g.bx[j][e], b = g.by[j][e], gj = g.gamma[j][e];
        r.K(ux, vx) += V * (M * x * a + G * y * b) + gi * gj * g.hss[e];
        r.K(ux, vy) += V * (s.lambda[e] * x * b + G * y * a) - gi * gj * g.hst[e];
        r.K(uy, vx) += V * (s.lambda[e] * y * a + G * x * b) - gi * gj * g.hst[e];
        r.K(uy, vy) += V * (M * y * b + G * x * a) + gi * gj * g.htt[e];
        const auto other = s.layout.nodes[e][j];
        r.Q(ux, other) += 0.25 * V * x;
        r.Q(uy, other) += 0.25 * V * y;
        r.S(node, other) += V * s.water.alpha[e] * (x * a + y * b);
        r.H(node, other) += V * (s.water.mobility_x[e] * x * a + s.water.mobility_y[e] * y * b);
      }
    }
  }
  return r;
}

Trial deform(const Solver& s, const Vector& du) {
  const Elements& g = s.layout.elements;
  Trial r{s.state.stress, std::get<fem::LawStates<PM4Sand>>(s.state.laws).of,
          Vector::Zero(du.size())};
  for (std::size_t e = 0; e < g.size(); ++e) {
    StrainIncrement<2> de{};
    double hx = s.state.hourglass_x[e], hy = s.state.hourglass_y[e];
    for (int i = 0; i < 4; ++i) {
      const double ux = du[s.layout.dofs[e][2 * i]], uy = du[s.layout.dofs[e][2 * i + 1]];
      de[0] += g.bx[i][e] * ux;
      de[1] += g.by[i][e] * uy;
      de[3] += g.by[i][e] * ux + g.bx[i][e] * uy;
      hx += g.gamma[i][e] * ux;
      hy += g.gamma[i][e] * uy;
    }
    const auto update = PM4Sand::update(fem::constants_of<PM4Sand>(s, s.layout.material[e]),
                                        r.sand[e], r.stress[e], de);
    r.stress[e] = update.stress;
    r.sand[e] = update.state;
    const double G = s.hourglass_shear[e], V = g.volume[e];
    const double fx = G * (g.hss[e] * hx - g.hst[e] * hy);
    const double fy = G * (g.htt[e] * hy - g.hst[e] * hx);
    for (int i = 0; i < 4; ++i) {
      const double x = g.bx[i][e], y = g.by[i][e];
      r.force[s.layout.dofs[e][2 * i]] +=
          V * (x * r.stress[e][0] + y * r.stress[e][3]) + g.gamma[i][e] * fx;
      r.force[s.layout.dofs[e][2 * i + 1]] +=
          V * (y * r.stress[e][1] + x * r.stress[e][3]) + g.gamma[i][e] * fy;
    }
  }
  return r;
}

}  // namespace flowslide::fem
