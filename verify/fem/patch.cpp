#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>

/// F1: constant states on distorted elements.
namespace flowslide::fem {
namespace {

/// Largest force of unknowns that touch only whole rings of elements, over the largest entry.
double inner_force(Solver& s) {
  start_motion(s);
  double largest = 0.0, worst = 0.0;
  for (const double f : s.entry_force) largest = std::max(largest, std::abs(f));
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (s.layout.forces.start[u + 1] - s.layout.forces.start[u] == 4)
      worst = std::max(worst, std::abs(s.layout.forces.sum(u, s.entry_force.data())));
  return worst / largest;
}

Model distorted(double table) {
  FemConfig c = config(elastic_soil(), table);
  c.sides.kind = SideKind::fixed;
  return build_model(section({.columns = 6, .rows = 6, .distortion = 0.3}), c);
}

/// A body that nothing holds, without flow.
Model floating() {
  Model m = distorted(4.0);
  std::fill(m.known_pressure.begin(), m.known_pressure.end(), kUnset);
  m.num_dofs = 2 * static_cast<std::int32_t>(m.mesh.num_nodes());
  for (std::int32_t i = 0; i < m.num_dofs; ++i) m.dof[i / 2][i % 2] = i;
  m.load.assign(m.num_dofs + 1, 0.0);
  m.base_dofs.clear();
  m.materials[0].permeability = {0.0, 0.0};
  return m;
}

}  // namespace

std::vector<Check> verify_patch(std::string_view name) {
  CheckList checks(name);
  Solver s = make_solver(distorted(4.0), {});
  for (Stress<2>& stress : s.state.stress) stress = {{-70e3, -120e3, -50e3, 20e3}};
  std::fill(s.state.pressure.begin(), s.state.pressure.end(), 30e3);
  checks.error("force_of_constant_stress", inner_force(s), 1e-12);

  // undrained and uniform compression: p = K_f/n times the strain, also with stabilisation
  Solver u = make_solver(floating(), {});
  std::fill(u.water.alpha.begin(), u.water.alpha.end(), 1e-8);
  for (std::size_t i = 0; i < u.model.mesh.num_nodes(); ++i) {
    u.state.velocity[2 * i] = -200.0 * u.model.mesh.nodes[i][0];
    u.state.velocity[2 * i + 1] = -100.0 * u.model.mesh.nodes[i][1];
  }
  u.dt = 1e-8;
  advance(u, {});
  const double exact = 3e-6 * 2.2e9 / (0.8 / 1.8);
  double worst = 0.0;
  for (const double p : u.state.pressure) worst = std::max(worst, std::abs(p / exact - 1.0));
  checks.error("undrained_pressure", worst, 1e-8);  // gravity moves it by 1e-9

  // seepage under a linear head
  Model seepage = distorted(4.0);
  const auto head = [](Vec2 x) { return 9810.0 * (4.0 - x[1]) + 3e3 * x[0] + 500.0 * x[1]; };
  for (std::size_t i = 0; i < seepage.known_pressure.size(); ++i) {
    const auto [x, y] = seepage.mesh.nodes[i];
    const bool outer = x == 0.0 || x == 4.0 || y == 0.0 || y == 4.0;
    seepage.known_pressure[i] = outer ? head(seepage.mesh.nodes[i]) : kUnset;
  }
  const Layout l = make_layout(seepage);
  const std::vector<double> p = steady_pressure(seepage, l, make_pressure_system(seepage, l));
  worst = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    worst = std::max(worst, std::abs(p[i] - head(seepage.mesh.nodes[i])) / 39e3);
  checks.error("linear_pressure", worst, 1e-11);

  // control: a gradient taken at one corner instead of the centre is not exact
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) s.layout.elements.bx[0][e] *= 1.001;
  checks.at_least("control", inner_force(s), 1e-6);
  return checks.take();
}

}  // namespace flowslide::fem
