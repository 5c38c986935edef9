#include "tests/constitutive/pm4sand_samples.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::testing;

namespace {

struct Cyclic {
  std::string file;
  PM4Sand::Params params;
  double vertical, csr, volumetric_strain, stop_strain;
  int half_cycles;  ///< of OpenSees, until stop_strain
};

/// Steps of strain between the turning points of a drained history, at constant vertical stress.
std::vector<Loop> drained_loops(PointUnderTest point, const std::vector<std::vector<double>>& rows,
                                double step) {
  const double vertical = point.stress[1];
  ShearTest test{{{0.0, point.stress[0], vertical, point.stress[3], 0.0, 0}},
                 ShearEnd::half_cycles};
  std::vector<Loop> loops;
  ShearRecord now = test.records.front();
  for (const auto& row : rows) {
    const double way = row[0] - now.gamma;
    const int n = static_cast<int>(std::ceil(std::abs(way) / step));
    for (int i = 0; i < n; ++i) {
      mixed_step(
          point,
          {Prescribed{}, Prescribed::stress_value(vertical), Prescribed::strain_increment(way / n)},
          1.0);
      now.gamma += way / n;
      now.tau = point.stress[3];
      test.records.push_back(now);
    }
    if (now.half_cycles >= 2) loops.push_back(last_loop(test));
    ++now.half_cycles;
  }
  return loops;
}

}  // namespace

TEST_CASE("PM4Sand follows OpenSees in undrained cyclic simple shear", "[pm4sand]") {
  const Cyclic c = GENERATE(
      Cyclic{"tailings_cyc_s100_csr090.csv", pm4sand_tailings(), 100e3, 0.09, 5.1846e-4, 0.05, 29},
      Cyclic{"tailings_cyc_s050_csr100.csv", pm4sand_tailings(), 50e3, 0.10, 2.5923e-4, 0.05, 22},
      Cyclic{"embankment_cyc_s100_csr120.csv", pm4sand_embankment(), 100e3, 0.12, 3.6453e-4, 0.03,
             63});
  CAPTURE(c.file);
  PointUnderTest point = pm4sand_point(c.params, at_rest(c.vertical), c.volumetric_strain);
  SimpleShear shear;
  shear.reversal_stress = c.csr * c.vertical;
  shear.stop_strain = c.stop_strain;
  const ShearTest test = run_simple_shear(point, shear);
  CHECK(test.end == ShearEnd::stop_strain);
  CHECK(test.records.back().half_cycles == c.half_cycles);
  CHECK(cycles_to_strain(test.records, 0.03).value_or(0.0) == 0.5 * c.half_cycles);

  // step by step: a run that turns one step too early is already off by the step's stress
  double sum = 0.0;
  const auto rows = pm4sand_rows(c.file);
  REQUIRE(rows.size() > 50);
  for (const auto& row : rows) {
    const ShearRecord& mine = test.records.at(static_cast<std::size_t>(row[0]));
    const double vertical = (mine.sigma_yy - 1e3 * row[3]) / c.vertical;
    const double shear_stress = (mine.tau - 1e3 * row[4]) / c.vertical;
    sum += vertical * vertical + shear_stress * shear_stress;
  }
  CHECK(std::sqrt(sum / static_cast<double>(rows.size())) < 0.002);
}

TEST_CASE("PM4Sand reaches the undrained strength of OpenSees", "[pm4sand]") {
  for (const double vertical : {50e3, 100e3, 250e3}) {
    PointUnderTest point =
        pm4sand_point(pm4sand_tailings(), at_rest(vertical), 5.1846e-9 * vertical);
    SimpleShear shear;
    shear.strain_step = 2e-5;
    shear.stop_strain = 0.1;
    const ShearTest test = run_simple_shear(point, shear);
    for (const auto& row : pm4sand_rows("tailings_mono.csv")) {
      if (row[0] * 1e3 != vertical) continue;
      CAPTURE(vertical, row[1]);
      const auto step = static_cast<std::size_t>(std::lround(row[1] / shear.strain_step));
      // At the bounding surface OpenSees' result depends on its step by a percent or two; before it
      // does not.
      const double tolerance = row[1] <= 0.01 ? 0.002 : 0.02;
      CHECK(test.records.at(step).tau == Approx(1e3 * row[2]).epsilon(tolerance));
    }
  }
}

TEST_CASE("PM4Sand has the strengths the tailings were calibrated to", "[pm4sand]") {
  // tau at 10 % strain [kPa], OpenSees with smaller time steps than the histories
  const auto [vertical, strength] =
      GENERATE(table<double, double>({{50e3, 4.38}, {100e3, 6.30}, {250e3, 11.64}}));
  PointUnderTest point = pm4sand_point(pm4sand_tailings(), at_rest(vertical), 5.1846e-9 * vertical);
  SimpleShear shear;
  shear.strain_step = 2e-5;
  shear.stop_strain = 0.1;
  CHECK(run_simple_shear(point, shear).records.back().tau == Approx(1e3 * strength).epsilon(0.02));
}

TEST_CASE("PM4Sand has the stiffness and damping of OpenSees in drained shear", "[pm4sand]") {
  const auto [file, params, strain, step] =
      GENERATE(table<std::string, PM4Sand::Params, double, double>(
          {{"embankment_drained_s100_g0010.csv", pm4sand_embankment(), 3.6453e-4, 1e-5},
           {"foundation_drained_s100_g0010.csv", pm4sand_foundation(), 2.7729e-4, 1e-5},
           {"tailings_drained_s100_g0100.csv", pm4sand_tailings(), 5.1847e-4, 5e-5}}));
  CAPTURE(file);
  const auto rows = pm4sand_rows(file);
  REQUIRE(rows.size() > 8);
  const auto loops = drained_loops(pm4sand_point(params, at_rest(100e3), strain), rows, step);
  REQUIRE(loops.size() == rows.size() - 2);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    CAPTURE(i);
    CHECK(loops[i].secant_modulus == Approx(1e3 * rows[i + 2][2]).epsilon(0.005));
    CHECK(loops[i].damping == Approx(rows[i + 2][3]).epsilon(0.015));
  }
}

TEST_CASE("PM4Sand's generic calibration has the manual's cyclic strength", "[pm4sand]") {
  // CRR at 15 cycles to 3 % strain, 1 atm, K0 = 0.5: 3 % is reached later at 10 % less, sooner at
  // 10 % more stress.
  const auto [Dr, G0, hpo, crr] = GENERATE(table<double, double, double, double>(
      {{0.35, 476.0, 0.53, 0.0899}, {0.55, 677.0, 0.40, 0.1472}, {0.75, 890.0, 0.63, 0.3123}}));
  const PM4Sand::Params sand = pm4sand_default(Dr, G0, hpo);
  const auto cycles = [&sand](double csr) {
    PointUnderTest point = pm4sand_point(sand, at_rest(kAtmosphere));
    SimpleShear shear;
    shear.strain_step = 1e-5;
    shear.reversal_stress = csr * kAtmosphere;
    shear.max_half_cycles = 60;
    return cycles_to_strain(run_simple_shear(point, shear).records, 0.03).value_or(30.0);
  };
  CAPTURE(Dr);
  CHECK(cycles(0.9 * crr) > 15.0);
  CHECK(cycles(1.1 * crr) < 15.0);
}

TEST_CASE("PM4Sand: drained loops in which Newton's method circles are halved and go on",
          "[pm4sand]") {
  // steps for which the vertical stress was missed by 0.4 to 23 Pa
  struct Case {
    PM4Sand::Params p;
    double vertical, step, reversal;
  };
  for (const Case& k : {Case{pm4sand_default(0.35, 476.0, 0.53), 20e3, 1.3e-5, 0.005},
                        Case{pm4sand_default(0.75, 890.0, 0.63), 100e3, 5e-5, 0.02}}) {
    PointUnderTest point = pm4sand_point(k.p, at_rest(k.vertical));
    SimpleShear test;
    test.drained = true;
    test.strain_step = k.step;
    test.reversal_strain = k.reversal;
    test.stop_strain = 1.0;
    test.max_half_cycles = 4;
    const ShearTest r = run_simple_shear(point, test);
    CHECK(r.end == ShearEnd::half_cycles);
    for (const ShearRecord& row : r.records)
      CHECK(row.sigma_yy == Approx(-k.vertical).epsilon(1.01e-5));
  }
}
