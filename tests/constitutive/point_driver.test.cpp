#include "constitutive/point_driver.hpp"

#include "core/check.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

struct Nothing {};
struct Answer {
  Stress<2> stress;
  Nothing state;
};
constexpr Elasticity kSoil{20e6, 10e6};

/// Linear elasticity with |tau| limited to `strength`.
PointUnderTest point(double strength = 1e9) {
  return make_point(
      Stress<2>{{-50e3, -100e3, -50e3, 0.0}}, Nothing{},
      [strength](const Stress<2>& s, const Nothing&, const StrainIncrement<2>& de) {
        Stress<2> r = hooke<2>(kSoil, s, de);
        r[3] = std::min(std::max(r[3], -strength), strength);
        return Answer{r, {}};
      },
      [](const Stress<2>&, const Nothing&) { return kSoil; });
}

}  // namespace

TEST_CASE("A mixed step meets the prescribed stress", "[point]") {
  PointUnderTest p = point();
  const auto de = mixed_step(
      p, {Prescribed{}, Prescribed::stress_value(-120e3), Prescribed::strain_increment(1e-4)},
      1e-3);
  CHECK(de[0] == 0.0);
  CHECK(de[1] == Approx(-20e3 / (20e6 + 40e6 / 3.0)));
  CHECK(p.stress[1] == Approx(-120e3));
  CHECK(p.stress[3] == Approx(1e3));
}

TEST_CASE("A mixed step says that a stress is beyond the strength", "[point]") {
  PointUnderTest p = point(5e3);
  CHECK_THROWS_AS(mixed_step(p, {Prescribed{}, Prescribed{}, Prescribed::stress_value(6e3)}, 1e-3),
                  NumericsError);
  CHECK(p.stress[3] == 0.0);
}

TEST_CASE("A mixed step ends where the law has no number to give", "[point]") {
  int calls = 0;
  PointUnderTest p = make_point(
      Stress<2>{{-50e3, -100e3, -50e3, 0.0}}, Nothing{},
      [&calls](const Stress<2>& s, const Nothing&, const StrainIncrement<2>& de) {
        ++calls;
        Stress<2> r = hooke<2>(kSoil, s, de);
        if (r[3] > 5e3) r[3] = std::nan("");
        return Answer{r, {}};
      },
      [](const Stress<2>&, const Nothing&) { return kSoil; });
  CHECK_THROWS_WITH(
      mixed_step(p, {Prescribed{}, Prescribed{}, Prescribed::stress_value(6e6)}, 1e-3),
      Catch::Contains("not finite"));
  CHECK(calls < 100);
}

TEST_CASE("Simple shear turns at the prescribed stress", "[point]") {
  PointUnderTest p = point();
  SimpleShear shear;
  shear.strain_step = 1e-5;
  shear.reversal_stress = 999.0;  // strain 1e-4 in ten steps
  shear.max_half_cycles = 4;
  const ShearTest test = run_simple_shear(p, shear);
  CHECK(test.end == ShearEnd::half_cycles);
  CHECK(test.records.size() == 1 + 10 + 3 * 20);
  CHECK_FALSE(cycles_to_strain(test.records, 2e-4).has_value());
  CHECK(pore_pressure_ratio(test, test.records.size() - 1) == Approx(0.0).margin(1e-12));
}

TEST_CASE("The loop of an elastic-plastic point has the known damping", "[point]") {
  // tau_max = 1 kPa is reached at gamma_y = 1e-4; cycles to gamma_a = 4e-4:
  // area 4 tau_max (gamma_a - gamma_y), damping area/(2 pi tau_max gamma_a) = (2/pi)(3/4)
  PointUnderTest p = point(1e3);
  SimpleShear shear;
  shear.strain_step = 1e-6;
  shear.reversal_strain = 4e-4;
  shear.max_half_cycles = 4;
  const Loop loop = last_loop(run_simple_shear(p, shear));
  CHECK(loop.secant_modulus == Approx(1e3 / 4e-4).epsilon(1e-6));
  CHECK(loop.damping == Approx(1.5 / 3.14159265358979).epsilon(1e-3));
}

TEST_CASE("Simple shear that does not end is refused", "[point]") {
  PointUnderTest p = point();
  SimpleShear shear;
  shear.reversal_stress = 1e3;
  shear.max_half_cycles = 1000000;
  shear.max_steps = 1000;
  CHECK_THROWS_AS(run_simple_shear(p, shear), InputError);
}

TEST_CASE("Simple shear refuses a step that leads nowhere", "[point]") {
  PointUnderTest p = point();
  SimpleShear shear;
  shear.strain_step = 0.0;
  CHECK_THROWS_AS(run_simple_shear(p, shear), InputError);
  shear = {};
  shear.reversal_stress = -1.0;
  CHECK_THROWS_AS(run_simple_shear(p, shear), InputError);
}
