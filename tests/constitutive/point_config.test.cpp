#include "constitutive/point_config.hpp"

#include "core/check.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

PointConfig elastic() {
  PointConfig c;
  c.material.laws.of<LinearElastic>() =
      LinearElastic::Params{.youngs_modulus = 26e6, .poisson_ratio = 0.3};
  c.stress.vertical = 100e3;
  return c;
}

/// Of the Mochikoshi dam, sheared at 100 kPa.
PointConfig tailings() {
  PointConfig c;
  c.material.laws.of<PM4Sand>() = PM4Sand::Params{};
  c.material.laws.of<PM4Sand>()->Dr = 0.35;
  c.material.laws.of<PM4Sand>()->G0 = 476.0;
  c.material.laws.of<PM4Sand>()->hpo = 2.70;
  c.material.laws.of<PM4Sand>()->Q = 11.998;
  c.material.laws.of<PM4Sand>()->R = 3.75;
  c.stress.vertical = 100e3;
  c.simple_shear.emplace();
  return c;
}

std::string fact(const PointReport& report, const std::string& name) {
  for (const auto& [key, text] : report.facts)
    if (key == name) return text;
  return "no such fact";
}

}  // namespace

TEST_CASE("a path of strains and stresses is followed", "[point]") {
  PointConfig c = elastic();
  // Vertical stress of -150 kPa without lateral strain, then 1e-4 of shear.
  c.path = {{.stress_yy = -150e3, .steps = 10}, {.gamma_xy = 1e-4, .steps = 5}};
  const PointReport r = run_point(c);
  REQUIRE(r.rows.size() == 16);
  const double oedometer = 26e6 * 0.7 / (1.3 * 0.4);
  CHECK(r.rows[10].eps_yy == Approx(-50e3 / oedometer));
  CHECK(r.rows[10].sigma_xx == Approx(-50e3 - 50e3 * 0.3 / 0.7));
  CHECK(r.rows[15].tau == Approx(1e-4 * 10e6));
  CHECK(r.rows[5].sigma_yy == Approx(-125e3));
}

TEST_CASE("a point that compacts has the strengths of OpenSees", "[point]") {
  // tau at 10 % strain [kPa], default emax and emin; without the consolidation strain 5.83 at 100.
  const auto [vertical, compacts, strength] = GENERATE(table<double, bool, double>(
      {{50e3, true, 4.38}, {100e3, true, 6.30}, {250e3, true, 11.64}, {100e3, false, 5.83}}));
  PointConfig c = tailings();
  c.stress.vertical = vertical;
  c.stress.compacts = compacts;
  c.simple_shear->stop_strain = 0.1;
  c.simple_shear->strain_step = 2e-5;
  CHECK(run_point(c).rows.back().tau == Approx(1e3 * strength).epsilon(0.02));
}

TEST_CASE("only soil with a void ratio compacts", "[point]") {
  PointConfig c = elastic();
  c.simple_shear.emplace();
  c.stress.compacts = true;
  CHECK_THROWS_WITH(run_point(c), Contains("pm4sand"));
  c = tailings();
  c.stress.k0 = 1.0;
  c.stress.compacts = true;
  CHECK_THROWS_WITH(run_point(c), Contains("k0 = 1"));
}

TEST_CASE("PM4Sand liquefies in cyclic simple shear from settings", "[point]") {
  PointConfig c = tailings();
  c.stress.vertical = 101.3e3;
  c.simple_shear->csr = 0.09;
  c.simple_shear->strain_step = 2e-5;
  const PointReport r = run_point(c);
  // OpenSees: r_u = 0.7 at 14.2 cycles.
  const std::string cycles = fact(r, "r_u = 0.7 first");
  CHECK(std::abs(std::stod(cycles.substr(6)) - 14.2) < 1.0);
  CHECK_THAT(fact(r, "ended"), Contains("shear strain"));
  CHECK_THAT(point_csv(r), Contains("gamma,eps_xx"));
}

TEST_CASE("settings of a point that cannot be run are refused", "[point]") {
  PointConfig c = elastic();
  CHECK_THROWS_WITH(check(c), Contains("neither simple_shear nor path"));
  c.simple_shear.emplace();
  c.path.emplace_back();
  CHECK_THROWS_WITH(check(c), Contains("both simple_shear and path"));
  c.path.clear();
  c.simple_shear->csr = 0.1;
  c.simple_shear->reversal_strain = 0.01;
  CHECK_THROWS_WITH(check(c), Contains("2 of csr"));
  c.simple_shear->csr.reset();
  c.simple_shear->strain_step = 1e-8;
  CHECK_THROWS_WITH(check(c), Contains("steps"));
  c = elastic();
  c.path = {{.strain_xx = 1e-3, .stress_xx = -1e3}};
  CHECK_THROWS_WITH(check(c), Contains("leg 1") && Contains("xx"));
  c.path = {{.gamma_xy = 1e-3}, {}};
  CHECK_THROWS_WITH(check(c), Contains("path.1: leg 2 gives no strain and no stress"));
  c.path.assign(30, {.gamma_xy = 1e-3, .steps = 1000000});
  CHECK_THROWS_WITH(check(c), Contains("path: 3e+07 steps"));
  c.path.clear();
  c.simple_shear.emplace();
  c.simple_shear->csr = 0.1;
  c.simple_shear->stop_strain = 10.0;
  c.simple_shear->strain_step = 1e-8;
  CHECK_THROWS_WITH(check(c), Contains("about 1e+09 steps"));
  c.simple_shear.emplace().stop_strain = 1e-6;
  CHECK_THROWS_WITH(check(c), Contains("simple_shear.strain_step: 5e-06 is more than"));
  c.material.laws.of<LinearElastic>().reset();
  CHECK_THROWS_WITH(check(c), Contains("material: ") && Contains("0 constitutive laws"));
}

TEST_CASE("what a run gives to every point is not left out of a test", "[point]") {
  PointConfig c;
  ResidualStrength::Params& liquefied = c.material.laws.of<ResidualStrength>().emplace();
  liquefied.youngs_modulus = 10e6;
  liquefied.poisson_ratio = 0.45;
  liquefied.strength = 5e3;
  c.stress.vertical = 50e3;
  c.stress.k0 = 1.0;
  c.simple_shear.emplace();
  // It would be elastic for ever: no number exceeds one that is not there.
  CHECK_THROWS_WITH(run_point(c),
                    Contains("material.residual_strength: 'soft_strength' is missing"));
  c.material.laws.of<ResidualStrength>()->soft_strength = 5e3;
  CHECK(run_point(c).rows.back().tau == Approx(5e3));
  c.material.laws = {};
  ModifiedCamClay::Params& clay = c.material.laws.of<ModifiedCamClay>().emplace();
  clay.critical_ratio = 1.2;
  clay.compression_index = 0.1;
  clay.swelling_index = 0.02;
  clay.poisson_ratio = 0.3;
  CHECK_THROWS_WITH(run_point(c), Contains("'preconsolidation' is missing"));
}

TEST_CASE("a test does not begin from a stress that the law cannot carry", "[point]") {
  PointConfig c;
  MohrCoulomb::Params& soil = c.material.laws.of<MohrCoulomb>().emplace();
  soil.youngs_modulus = 20e6;
  soil.poisson_ratio = 0.3;
  soil.cohesion = 1e3;
  soil.friction_angle = 0.5;
  c.stress.vertical = 100e3;
  c.simple_shear.emplace();
  CHECK(run_point(c).warnings.empty());
  for (const auto& [k0, shear] : {std::pair(0.0, 0.0), {10.0, 0.0}, {0.5, 90e3}, {0.5, -90e3}}) {
    c.stress.k0 = k0;
    c.stress.shear = shear;
    CHECK_THROWS_WITH(run_point(c), Contains("stress: mohr_coulomb cannot carry 100 kPa vertical"));
  }
  PointConfig sand = tailings();
  sand.simple_shear->stop_strain = 1e-4;
  CHECK(run_point(sand).warnings.empty());
  sand.stress.shear = 90e3;
  const std::vector<std::string> warnings = run_point(sand).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("pm4sand cannot carry all of the stress"));
}

TEST_CASE("shearing that turns too late is told", "[point]") {
  PointConfig c = tailings();
  c.simple_shear->csr = 0.09;
  c.simple_shear->max_cycles = 2;
  CHECK(run_point(c).warnings.empty());
  c.simple_shear->csr = 0.001;  // the stress of half a step
  const std::vector<std::string> warnings = run_point(c).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("times what was asked for") && Contains("strain_step"));
  c.simple_shear->csr.reset();
  c.simple_shear->reversal_strain = 5.1e-6;
  CHECK_THAT(run_point(c).warnings.at(0), Contains("a shear strain of"));
}

TEST_CASE("a stress beyond the strength names its leg", "[point]") {
  PointConfig c;
  c.material.laws.of<ResidualStrength>() = ResidualStrength::Params{
      .youngs_modulus = 10e6, .poisson_ratio = 0.45, .strength = 5e3, .soft_strength = 5e3};
  c.stress.vertical = 50e3;
  c.stress.k0 = 1.0;
  c.path = {{.gamma_xy = 1e-5, .steps = 2}, {.tau_xy = 6e3, .steps = 10}};
  CHECK_THROWS_WITH(run_point(c), Contains("leg 2 of the path"));
}
