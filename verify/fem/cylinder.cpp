#include "core/elementary.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>
#include <map>

/// F4: a cylinder of saturated soil under pressure all around, drained at its surface. The plane
/// sister of Cryer's sphere, after de Leeuw (1965).
namespace flowslide::fem {
namespace {

constexpr double kRadius = 10.0, kCylinderLoad = 100e3, kCylinderYoung = 10e6;
constexpr double kCylinderPermeability = 1e-3;
constexpr double kRamp = 0.5;  ///< time over which the load comes [s]

/// Excess pore pressure over the load for incompressible grains and water, from the transform
/// p(r, s) = q/s (I0(x) - I0(x r/a))/(I0(x) - 2 eta I1(x)/x), x = a sqrt(s/c), eta = G/M.
struct Cylinder {
  double eta;
  std::vector<double> roots;  ///< of a J0(a) = 2 eta J1(a)

  explicit Cylinder(double poisson) : eta((1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson))) {
    const auto f = [this](double a) {
      return a * std::cyl_bessel_j(0, a) - 2.0 * eta * std::cyl_bessel_j(1, a);
    };
    for (double low = 0.05; roots.size() < 60; low += 0.05) {
      double a = low, b = low + 0.05;
      if ((f(a) > 0.0) == (f(b) > 0.0)) continue;
      for (int i = 0; i < 60; ++i) {
        const double mid = 0.5 * (a + b);
        ((f(mid) > 0.0) == (f(a) > 0.0) ? a : b) = mid;
      }
      roots.push_back(0.5 * (a + b));
    }
  }
  /// At r/a and T = c t/a^2, c = k M/gamma_w.
  [[nodiscard]] double pressure(double r, double T) const {
    double sum = 0.0;
    for (const double a : roots)
      sum += 2.0 * (std::cyl_bessel_j(0, a * r) - std::cyl_bessel_j(0, a)) /
             (std::cyl_bessel_j(1, a) * (a - 4.0 * eta * (1.0 - eta) / a)) * exp(-a * a * T);
    return sum;
  }
  [[nodiscard]] double peak() const {
    double largest = 0.0;
    for (double T = 0.005; T < 0.5; T *= 1.01) largest = std::max(largest, pressure(0.0, T));
    return largest;
  }
};

/// A quarter of a disc: a square of `n` cells a side in the middle, two fans of n by n around it.
QuadMesh quarter_disc(int n) {
  QuadMesh m;
  std::map<std::pair<long, long>, std::int32_t> known;
  const auto node = [&](const Vec2& p) {
    const std::pair key{std::lround(1e6 * p[0]), std::lround(1e6 * p[1])};
    const auto [entry, is_new] = known.try_emplace(key, static_cast<std::int32_t>(known.size()));
    if (is_new) {
      m.nodes.push_back(p);
      m.node_tags.push_back(static_cast<std::int64_t>(m.nodes.size()));
    }
    return entry->second;
  };
  const auto block = [&](auto point) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int di, int dj) {
          return node(point(static_cast<double>(i + di) / n, static_cast<double>(j + dj) / n));
        };
        m.elements.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
        m.element_tags.push_back(static_cast<std::int64_t>(m.elements.size()));
        m.element_material.push_back(1);
      }
  };
  const double side = 0.5 * kRadius, corner = 0.38 * kRadius;
  block([&](double s, double t) -> Vec2 {
    return {s * (side + t * (corner - side)), t * (side + s * (corner - side))};
  });
  const auto fan = [&](const Vec2& from, const Vec2& to, double angle) {
    block([&, angle](double s, double t) -> Vec2 {
      const double w = angle + 0.25 * kPi * t;
      return {(1.0 - s) * (from[0] + t * (to[0] - from[0])) + s * kRadius * cos(w),
              (1.0 - s) * (from[1] + t * (to[1] - from[1])) + s * kRadius * sin(w)};
    });
  };
  fan({side, 0.0}, {corner, corner}, 0.0);
  fan({corner, corner}, {0.0, side}, 0.25 * kPi);
  return m;
}

bool on_rim(const Vec2& p) { return hypot(p[0], p[1]) > kRadius * (1.0 - 1e-9); }

Solver disc(int n, double poisson) {
  const FemMaterialConfig c = elastic_soil(kCylinderYoung, poisson);
  Model m;
  m.mesh = quarter_disc(n);
  m.materials = {{"soil",
                  flowslide::Material<LinearElastic>{*c.laws.of<LinearElastic>()},
                  100.0,  // inertia only matters while the load comes
                  c.void_ratio / (1.0 + c.void_ratio),
                  {kCylinderPermeability, kCylinderPermeability},
                  poisson}};
  m.material.assign(m.mesh.num_elements(), 0);
  m.thickness.assign(m.mesh.num_elements(), 1.0);
  m.gravity = 9.81;
  const auto held = std::numeric_limits<std::int32_t>::max();
  for (const auto& [x, y] : m.mesh.nodes) {
    m.dof.push_back({held, held});
    if (x > 1e-6) m.dof.back()[0] = m.num_dofs++;
    if (y > 1e-6) m.dof.back()[1] = m.num_dofs++;
    m.known_pressure.push_back(on_rim({x, y}) ? 0.0 : kUnset);
  }
  for (auto& dof : m.dof)
    for (std::int32_t& u : dof) u = std::min(u, m.num_dofs);
  m.load.assign(m.num_dofs + 1, 0.0);
  Solver s = make_solver(m, {5.0, 1e-5});
  std::fill(s.layout.weight.begin(), s.layout.weight.end(), 0.0);
  refresh_moduli(s);
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
    s.water.alpha[e] = 0.25 * s.layout.elements.area[e] / (s.lambda[e] + 2.0 * s.shear[e]);
  s.model.fluid.density = 1e-12;  // pressures are measured against water at rest
  s.dt = 0.9 * stable_step({soil_frequency(s), water_frequency(s)}, 1e-5);
  start_motion(s);
  return s;
}

void press_cylinder(Solver& s, double load) {
  std::fill(s.model.load.begin(), s.model.load.end(), 0.0);
  const auto& x = s.model.mesh.nodes;
  for (const auto& element : s.model.mesh.elements)
    for (int i = 0; i < 4; ++i) {
      const std::int32_t a = element[i], b = element[(i + 1) % 4];
      if (!on_rim(x[a]) || !on_rim(x[b])) continue;
      for (const std::int32_t node : {a, b}) {
        s.model.load[s.model.dof[node][0]] -= 0.5 * load * (x[b][1] - x[a][1]);
        s.model.load[s.model.dof[node][1]] += 0.5 * load * (x[b][0] - x[a][0]);
      }
    }
}

}  // namespace

std::vector<Check> verify_cylinder(std::string_view name) {
  CheckList checks(name);
  double lowest = 1e300, highest = 0.0;
  for (const double poisson : {0.0, 0.4}) {
    const Cylinder exact(poisson);
    Solver s = disc(8, poisson);
    const double modulus = s.lambda[0] + 2.0 * s.shear[0];
    const double c = kCylinderPermeability * modulus / kUnitWeight;
    const std::string nu = fmt::format("nu_{:g}", poisson);
    constexpr std::array<double, 3> kAt{0.02, 0.1, 0.3};
    std::size_t at = 0;
    double peak = 0.0;
    while (at < kAt.size()) {
      press_cylinder(s, kCylinderLoad * std::min(1.0, s.state.time / kRamp));
      advance(s, {});
      const double middle = s.state.pressure[0] / kCylinderLoad;
      const double T = c * (s.state.time - 0.5 * kRamp) / (kRadius * kRadius);
      if (s.state.time > 2.0 * kRamp) peak = std::max(peak, middle);
      if (T < kAt[at]) continue;
      checks.near(fmt::format("{}/middle_at_{:g}", nu, kAt[at]), middle,
                  exact.pressure(0.0, kAt[at]), 0.01);
      ++at;
    }
    checks.near(nu + "/peak", peak, exact.peak(), 0.01 * exact.peak());
    lowest = std::min(lowest, peak);
    highest = std::max(highest, peak);
  }
  checks.at_least("overshoot", highest, 1.2);
  // What the skeleton's Poisson's ratio does to the peak; diffusion alone knows nothing of it.
  checks.at_least("peaks_differ", highest - lowest, 0.1);
  return checks.take();
}

}  // namespace flowslide::fem
