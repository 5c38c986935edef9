#include "constitutive/point_fit.hpp"

#include "core/check.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Cycles in halves.
double halves(double n) { return 0.5 * std::floor(2.0 * n); }

PointConfig loose_sand() {
  PM4Sand::Params soil;
  soil.Dr = 0.35;
  soil.G0 = 476.0;
  soil.hpo = 0.5;
  PointConfig c;
  c.material.laws.of<PM4Sand>() = soil;
  c.stress.vertical = 100e3;
  PointShear& shear = c.simple_shear.emplace();
  shear.csr = 0.1;
  shear.strain_step = 2e-5;
  shear.max_cycles = 30;
  return c;
}

}  // namespace

TEST_CASE("a parameter is found for cycles that rise with it, and for cycles that fall",
          "[constitutive]") {
  const double target = GENERATE(5.0, 15.0, 22.5);
  for (const double start : {0.01, 1.0, 300.0}) {
    const PointFit up = fit_to_cycles(start, target, [](double v) { return halves(10.0 * v); });
    CHECK(up.value == Approx(0.1 * target).epsilon(2e-3));
    CHECK(halves(10.0 * up.value) >= target);
    CHECK(halves(10.0 * 0.998 * up.value) < target);
    const PointFit down = fit_to_cycles(start, target, [](double v) { return halves(10.0 / v); });
    CHECK(down.value == Approx(10.0 / target).epsilon(2e-3));
    CHECK(halves(10.0 / down.value) >= target);
    CHECK(up.tests < 40);
  }
}

TEST_CASE("a parameter that does not decide is refused, with what was tried", "[constitutive]") {
  CHECK_THROWS_WITH(fit_to_cycles(1.0, 15.0, [](double) { return 3.0; }),
                    Catch::Contains("from 0.0009766 to 1024 the strain is reached after 3 cycles, "
                                    "whatever the value (15 cycles were asked for"));
  CHECK_THROWS_WITH(
      fit_to_cycles(1.0, 15.0, [](double) { return std::numeric_limits<double>::infinity(); }),
      Catch::Contains("the strain is not reached, whatever"));
  // a range that ends at 4 holds no more than 8 cycles
  const auto within = [](double v) {
    if (v > 4.0) throw InputError("out of range");
    if (v < 9.7e-4) throw NumericsError("not finite");
    return 2.0 * v;
  };
  CHECK_THROWS_WITH(fit_to_cycles(1.0, 15.0, within),
                    Catch::Contains("to 4 the strain is reached after 0.00195") &&
                        Catch::Contains("to 8 cycles"));
  CHECK(fit_to_cycles(1.0, 7.0, within).value == Approx(3.5).epsilon(1e-3));
  // what is wrong with the first value is told
  CHECK_THROWS_WITH(fit_to_cycles(5.0, 7.0, within), Catch::Contains("out of range"));
}

TEST_CASE("where cycles jump, those on the far side are told", "[constitutive]") {
  const PointFit found = fit_to_cycles(1.0, 15.0, [](double v) { return v < 2.0 ? 9.0 : 22.0; });
  CHECK(found.value == Approx(2.0).epsilon(2e-3));
  CHECK(found.cycles == 22.0);
}

TEST_CASE("hpo of PM4Sand is found for a cyclic strength", "[constitutive]") {
  PointConfig c = loose_sand();
  const auto cycles = [&c](double hpo) {
    c.material.laws.of<PM4Sand>()->hpo = hpo;
    return cycles_to_strain(run_point(c).rows, 0.03).value_or(1e9);
  };
  const PointFit found = fit_to_cycles(0.5, 15.0, cycles);
  CHECK(found.cycles == Approx(15.0).margin(0.25));
  CHECK(cycles(found.value) == found.cycles);
  CHECK(cycles(0.99 * found.value) <= 15.0);
  CHECK(cycles(0.9 * found.value) < 15.0);  // control: the parameter matters
}
