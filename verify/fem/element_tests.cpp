#include "constitutive/point_config.hpp"
#include "verify/fem/list.hpp"

#include <array>
#include <cmath>
#include <limits>

/// F8: PM4Sand in direct simple shear at constant volume, K_0 = 0.5.
namespace flowslide::fem {
namespace {

PointConfig test_of(double Dr, double G0, double hpo, double vertical) {
  PointConfig c;
  c.material.laws.of<PM4Sand>() = PM4Sand::Params{};
  c.material.laws.of<PM4Sand>()->Dr = Dr;
  c.material.laws.of<PM4Sand>()->G0 = G0;
  c.material.laws.of<PM4Sand>()->hpo = hpo;
  c.stress.vertical = vertical;
  c.stress.compacts = true;
  c.simple_shear.emplace();
  return c;
}

/// Cycles to a shear strain of 3 %, from the test's table; infinite where it is not reached.
double cycles_to_3_percent(PointConfig c, double csr) {
  c.simple_shear->csr = csr;
  c.simple_shear->stop_strain = 0.031;
  c.simple_shear->strain_step = 2e-5;
  const PointReport r = run_point(c);
  for (const PointRow& row : r.rows)
    if (std::abs(row.gamma) >= 0.03) return 0.5 * row.half_cycles;
  return std::numeric_limits<double>::infinity();
}

/// The cyclic stress ratio that takes 15 cycles, by bisection between 0.7 and 1.4 of `near`.
double strength_at_15_cycles(const PointConfig& c, double near) {
  double low = 0.7 * near, high = 1.4 * near;
  for (int i = 0; i < 8; ++i) {
    const double middle = 0.5 * (low + high);
    (cycles_to_3_percent(c, middle) > 15.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double stress_at_10_percent(PointConfig c) {
  c.simple_shear->stop_strain = 0.1;
  c.simple_shear->strain_step = 2e-5;
  return run_point(c).rows.back().tau;
}

}  // namespace

std::vector<Check> verify_cyclic_strength(std::string_view name) {
  CheckList checks(name);
  // generic calibration of the manual: D_R, G_0, h_po and the stress ratio at 15 cycles
  constexpr std::array<std::array<double, 4>, 3> sets{
      {{0.35, 476.0, 0.53, 0.0899}, {0.55, 677.0, 0.40, 0.1472}, {0.75, 890.0, 0.63, 0.3123}}};
  for (const auto& [Dr, G0, hpo, crr] : sets) {
    const double strength = strength_at_15_cycles(test_of(Dr, G0, hpo, kAtmosphere), crr);
    checks.near(fmt::format("crr_15_dr_{:.0f}", 100.0 * Dr), strength, crr, 0.1 * crr);
  }
  return checks.take();
}

std::vector<Check> verify_undrained_strength(std::string_view name) {
  CheckList checks(name);
  // tailings of Sordo, Rathje & Kumar (2025); OpenSees at 10 % of shear strain
  constexpr std::array<std::array<double, 2>, 3> tests{
      {{50e3, 4.38e3}, {100e3, 6.30e3}, {250e3, 11.64e3}}};
  for (const auto& [vertical, strength] : tests) {
    PointConfig c = test_of(0.35, 476.0, 2.70, vertical);
    c.material.laws.of<PM4Sand>()->Q = 11.998;
    c.material.laws.of<PM4Sand>()->R = 3.75;
    checks.near(fmt::format("tau_{:.0f}_kpa", 1e-3 * vertical), stress_at_10_percent(c), strength,
                0.02 * strength, "Pa");
  }
  // control: with the generic critical-state line this soil dilates
  checks.at_least("control", stress_at_10_percent(test_of(0.35, 476.0, 0.53, 100e3)), 50e3, "Pa");
  return checks.take();
}

}  // namespace flowslide::fem
