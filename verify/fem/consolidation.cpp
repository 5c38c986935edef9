#include "core/elementary.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>
#include <functional>

/// F2, F3: consolidation in one and two dimensions, computed as motion that dies out.
namespace flowslide::fem {
namespace {

constexpr double kLayerHeight = 10.0, kLayerLoad = 100e3;
constexpr double kLayerYoung = 10e6, kPoisson = 0.25;
constexpr double kModulus = kLayerYoung * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson));
constexpr double kLayerPermeability = 1e-3;

/// Top drained, load on the surface in place of weight.
Solver layer(int elements, double stabilisation) {
  FemConfig c = config(elastic_soil(kLayerYoung, kPoisson), kLayerHeight);
  c.materials["soil"].permeability = {kLayerPermeability, kLayerPermeability};
  c.damping.mass = 0.0;
  c.damping.stiffness = 1e-4;
  c.stabilisation.pressure = stabilisation;
  const double h = kLayerHeight / elements;
  return at_rest(section({.columns = 1, .rows = elements, .width = h, .height = kLayerHeight}), c,
                 0.9);
}

void press_layer(Solver& s, double load) {
  // two nodes of a surface as wide as an element
  const double width = s.model.mesh.nodes[1][0];
  std::fill(s.model.load.begin(), s.model.load.end(), 0.0);
  for (std::size_t i = 0; i < s.model.mesh.num_nodes(); ++i)
    if (s.model.mesh.nodes[i][1] > kLayerHeight - 1e-9)
      s.model.load[s.model.dof[i][1]] -= 0.5 * width * load;
}

struct Consolidation {
  double degree, base;  ///< U, excess pore pressure at the base over the load
};

/// Share of the load that soil as stiff as `kModulus` leaves to water of finite stiffness.
constexpr double kShare = 1.0 / (1.0 + kModulus * (0.8 / 1.8) / 2.2e9);

/// Terzaghi's series for T = c t/H^2, c = k M/gamma_w times kShare.
Consolidation terzaghi(double T) {
  double U = 0.0, p = 0.0;
  for (int m = 0; m < 400; ++m) {
    const double M = 0.5 * kPi * (2 * m + 1), decay = exp(-M * M * T);
    U += 2.0 / (M * M) * decay;
    p += 2.0 / M * sin(M) * decay;
  }
  return {1.0 - kShare + kShare * (1.0 - U), kShare * p};
}

constexpr std::array<double, 4> kTimes{0.05, 0.1, 0.2, 0.5};

/// Load over 0.2 s, some thousandths of the time of consolidation, counted from the middle.
std::array<Consolidation, 4> consolidate(int elements) {
  Solver s = layer(elements, 0.25);
  const double ramp = 0.2;
  const double per_time =
      kLayerHeight * kLayerHeight * kUnitWeight / (kLayerPermeability * kModulus * kShare);
  const double settled = kLayerLoad * kLayerHeight / kModulus;
  std::array<Consolidation, 4> r;
  const std::int32_t top = s.model.dof.back()[1];
  std::size_t at = 0;
  while (at < kTimes.size()) {
    press_layer(s, kLayerLoad * std::min(1.0, s.state.time / ramp));
    advance(s, {});
    if (s.state.time < kTimes[at] * per_time + 0.5 * ramp) continue;
    r[at++] = {-s.state.displacement[top] / settled,
               (s.state.pressure[0] - kUnitWeight * kLayerHeight) / kLayerLoad};
  }
  return r;
}

}  // namespace

std::vector<Check> verify_terzaghi(std::string_view name) {
  CheckList checks(name);
  std::array<double, 3> error{};
  const std::array<int, 3> sizes{4, 8, 16};
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const auto result = consolidate(sizes[k]);
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
      const Consolidation exact = terzaghi(kTimes[i]);
      error[k] = std::max(error[k], std::abs(result[i].base - exact.base));
      if (sizes[k] < 16) continue;
      checks.near(fmt::format("degree_at_{:g}", kTimes[i]), result[i].degree, exact.degree, 0.005);
      checks.near(fmt::format("base_at_{:g}", kTimes[i]), result[i].base, exact.base, 0.005);
    }
  }
  checks.at_least("order", std::log2(error[0] / error[2]) / 2.0, 1.6);
  return checks.take();
}

std::vector<Check> verify_first_step(std::string_view name) {
  CheckList checks(name);
  // a hundredth of the time in which pressure crosses the first of 20 elements
  for (const double stabilisation : {0.25, 0.0}) {
    Solver s = layer(20, stabilisation);
    for (double& m : s.water.mobility_y) m *= 1e-3;
    const double ramp = 0.5;
    while (s.state.time < 0.6) {
      press_layer(s, kLayerLoad * std::min(1.0, s.state.time / ramp));
      advance(s, {});
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < s.state.pressure.size(); ++i)
      largest = std::max(
          largest, (s.state.pressure[i] - kUnitWeight * (kLayerHeight - s.model.mesh.nodes[i][1])) /
                       kLayerLoad);
    if (stabilisation > 0.0)
      checks.at_most("overshoot", largest, 1.02);
    else
      checks.at_least("overshoot_control", largest, 1.2);
  }
  return checks.take();
}

namespace {

/// F3. Half a slab between rigid smooth plates, width `a` from the middle to the drained side.
struct Mandel {
  double nu = kPoisson, undrained = 0.5;
  [[nodiscard]] double root(int i) const {
    const double k = (1.0 - nu) / (undrained - nu);
    double low = (i + 1e-9) * kPi, high = (i + 0.5) * kPi - 1e-12;
    for (int step = 0; step < 200; ++step) {
      const double mid = 0.5 * (low + high);
      (tan(mid) < k * mid ? low : high) = mid;
    }
    return 0.5 * (low + high);
  }
  /// p/p_0 at x/a and T = c t/a^2.
  [[nodiscard]] double pressure(double x, double T) const {
    double sum = 0.0;
    for (int i = 0; i < 100; ++i) {
      const double r = root(i);
      sum += sin(r) / (r - sin(r) * cos(r)) * (cos(r * x) - cos(r)) * exp(-r * r * T);
    }
    return 2.0 * sum;
  }
};

/// Left edge: symmetry. Right edge: drained, free. Top: a plate.
Solver slab(int elements) {
  constexpr double a = 10.0;
  FemConfig c = config(elastic_soil(kLayerYoung, kPoisson), a);
  c.materials["soil"].permeability = {kLayerPermeability, kLayerPermeability};
  c.materials["soil"].density = 100.0;  // inertia only matters while the load comes
  Model m = build_model(
      section({.columns = elements, .rows = 2, .width = a, .height = 2.0 * a / elements}), c);
  const double top = 2.0 * a / elements;
  m.num_dofs = 1;  // the plate is the first unknown
  const auto held = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < m.mesh.num_nodes(); ++i) {
    const auto [x, y] = m.mesh.nodes[i];
    m.dof[i][0] = x == 0.0 ? held : m.num_dofs++;
    m.dof[i][1] = y == 0.0 ? held : y == top ? 0 : m.num_dofs++;
    m.known_pressure[i] = x == a ? 0.0 : kUnset;
  }
  for (auto& dof : m.dof)
    for (std::int32_t& u : dof) u = std::min(u, m.num_dofs);
  m.base_dofs.clear();
  m.load.assign(m.num_dofs + 1, 0.0);
  m.gravity = 9.81;
  Solver s = make_solver(m, {5.0, 1e-5});
  std::fill(s.layout.weight.begin(), s.layout.weight.end(), 0.0);
  refresh_moduli(s);
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
    s.water.alpha[e] = 0.25 * s.layout.elements.area[e] / (s.lambda[e] + 2.0 * s.shear[e]);
  // hydrostatic pressure is kept out: heads are measured from the level of each node
  s.model.fluid.density = 1e-12;
  s.dt = 0.9 * stable_step({soil_frequency(s), water_frequency(s)}, 1e-5);
  start_motion(s);
  return s;
}

}  // namespace

std::vector<Check> verify_mandel(std::string_view name) {
  CheckList checks(name);
  constexpr double a = 10.0;
  Solver s = slab(20);
  const double c = kLayerPermeability * kModulus / kUnitWeight, force = kLayerLoad * a, ramp = 0.5;
  const Mandel exact;
  double peak = 0.0;
  constexpr std::array<double, 3> kAt{0.02, 0.1, 0.3};
  std::size_t at = 0;
  while (at < kAt.size()) {
    s.model.load[0] = -force * std::min(1.0, s.state.time / ramp);
    advance(s, {});
    peak = std::max(peak, s.state.pressure[0] / (0.5 * kLayerLoad));
    if (c * (s.state.time - 0.5 * ramp) / (a * a) < kAt[at]) continue;
    checks.near(fmt::format("middle_at_{:g}", kAt[at]), s.state.pressure[0] / (0.5 * kLayerLoad),
                exact.pressure(0.0, kAt[at]), 0.01);
    checks.near(fmt::format("half_at_{:g}", kAt[at]), s.state.pressure[10] / (0.5 * kLayerLoad),
                exact.pressure(0.5, kAt[at]), 0.01);
    ++at;
  }
  checks.at_least("overshoot", peak, 1.05);
  return checks.take();
}

}  // namespace flowslide::fem
