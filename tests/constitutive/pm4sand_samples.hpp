#pragma once
#include "constitutive/pm4sand.hpp"
#include "constitutive/point_driver.hpp"
#include "tests/support/paths.hpp"

#include <fstream>
#include <sstream>
#include <string>

/// The parameter sets and histories of fixtures/pm4sand.
namespace flowslide::testing {

inline PM4Sand::Params pm4sand_tailings() {
  PM4Sand::Params p;
  p.Dr = 0.35;
  p.G0 = 476.0;
  p.hpo = 2.70;
  p.Q = 11.998;
  p.R = 3.75;
  p.emax = 1.095;
  p.emin = 0.795;
  return p;
}

/// Default parameters but for what calibrates the cyclic strength.
inline PM4Sand::Params pm4sand_default(double Dr, double G0, double hpo) {
  PM4Sand::Params p;
  p.Dr = Dr;
  p.G0 = G0;
  p.hpo = hpo;
  return p;
}

inline PM4Sand::Params pm4sand_embankment() {
  PM4Sand::Params p = pm4sand_default(0.55, 677.0, 0.40);
  p.emax = 1.365;
  p.emin = 1.065;
  return p;
}

inline PM4Sand::Params pm4sand_foundation() {
  PM4Sand::Params p = pm4sand_default(0.75, 890.0, 0.63);
  p.emax = 1.025;
  p.emin = 0.725;
  return p;
}

/// Consolidated at K0 = 0.5 to sigma'_v [Pa].
inline Stress<2> at_rest(double vertical) {
  return {{-0.5 * vertical, -vertical, -0.5 * vertical, 0.0}};
}

inline PointUnderTest pm4sand_point(const PM4Sand::Params& p, const Stress<2>& stress,
                                    double volumetric_strain = 0.0) {
  const auto c = PM4Sand::constants(p);
  return make_point(
      stress, PM4Sand::initial_state(c, stress, volumetric_strain),
      [c](const Stress<2>& sigma, const PM4Sand::State& s, const StrainIncrement<2>& de) {
        return PM4Sand::update(c, s, sigma, de);
      },
      [c](const Stress<2>& sigma, const PM4Sand::State& s) {
        return PM4Sand::elasticity(c, s, sigma);
      });
}

/// Rows of a fixture; an empty cell is NaN.
inline std::vector<std::vector<double>> pm4sand_rows(const std::string& name) {
  std::ifstream file(test::fixture("pm4sand/" + name));
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::istringstream cells(line + ",");
    while (std::getline(cells, cell, ',')) row.push_back(cell.empty() ? kUnset : std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace flowslide::testing
