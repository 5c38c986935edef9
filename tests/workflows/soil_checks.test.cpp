#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

/// Numbers of soils that cannot be, or are odd.
using namespace flowslide;
using Catch::Contains;

namespace {

struct Answer {
  std::string errors, warnings;
};

Answer answer(const Findings& found) {
  return {fmt::format("{}", fmt::join(found.errors, "\n")),
          fmt::format("{}", fmt::join(found.warnings, "\n"))};
}

using M = FemMaterialConfig;

/// What is said of sound soil after a change; before it, nothing.
Answer with(const std::function<void(FemConfig&, M&)>& change) {
  FemConfig c;
  c.water.emplace().table = {{0.0, 20.0}};
  M m;
  m.density = 1870.0;
  m.void_ratio = 0.99;
  m.laws.of<LinearElastic>() = LinearElastic::Params{20e6, 0.3};
  c.materials["tailings"] = m;
  Findings control, found;
  check_fem_soils(c, control);
  CHECK(control.errors.empty());
  CHECK(control.warnings.empty());
  change(c, c.materials["tailings"]);
  check_fem_soils(c, found);
  return answer(found);
}

}  // namespace

TEST_CASE("Imported densities are plausible") {
  const auto with = [](double density) {
    Findings found;
    check_densities({{"tailings", 1, density}}, found);
    return answer(found);
  };
  CHECK(with(1900.0).warnings.empty());
  CHECK_THAT(with(500.0).errors, Contains("materials.tailings.density is 500 kg/m3"));
  CHECK_THAT(with(5500.0).errors, Contains("5500"));
  CHECK_THAT(with(1000.0).warnings, Contains("usual"));
  CHECK_THAT(with(1.8).errors, Contains("1.8 t/m3 are 1800 kg/m3"));
  CHECK_THAT(with(18.0).errors, Contains("18 kN/m3 is a density of 1835 kg/m3"));
  CHECK_THAT(with(18e3).errors, Contains("18000 N/m3 is a density of 1835 kg/m3"));
  CHECK_THAT(with(117.0).errors, Contains("117 lb/ft3 are 1874 kg/m3"));
}

TEST_CASE("Soils and water of the finite elements have plausible numbers") {
  CHECK_THAT(with([](FemConfig&, M& x) { x.density = 500.0; }).errors, Contains("density is 500"));
  // With a void ratio of 0.3 grains of 2.13 t/m3, with 2.5 of 4.05 t/m3.
  CHECK_THAT(with([](FemConfig&, M& x) { x.void_ratio = 0.3; }).warnings, Contains("grains"));
  CHECK_THAT(with([](FemConfig&, M& x) { x.void_ratio = 9.0; }).errors, Contains("9700 kg/m3"));
  CHECK_THAT(
      with([](FemConfig&, M& x) { x.laws.of<LinearElastic>()->youngs_modulus = 20.0; }).errors,
      Contains("youngs_modulus"));
  CHECK_THAT(with([](FemConfig& c, M&) { c.water->bulk_modulus = 2.2e3; }).errors,
             Contains("water.bulk_modulus"));
  CHECK_THAT(with([](FemConfig&, M& x) {
               x.permeability = {1.0, 1e-6};
             }).warnings,
             Contains("permeability is 1 m/s"));
  CHECK_THAT(with([](FemConfig& c, M&) { c.base.shear_wave_velocity = 80.0; }).warnings,
             Contains("base.shear_wave_velocity is 80 m/s"));
  CHECK_THAT(with([](FemConfig& c, M&) { c.water->density = 1.0; }).errors,
             Contains("water.density"));
  CHECK_THAT(with([](FemConfig& c, M&) { c.gravity.acceleration = 50.0; }).warnings,
             Contains("not that of the earth"));
  // Dry soil of 1400 kg/m3: saturated it would have grains of 1.8 t/m3.
  CHECK(with([](FemConfig&, M& x) {
          x.density = 1400.0;
          x.drained = true;
        }).warnings.empty());
}

TEST_CASE("Rock, layers and constants of sand have plausible numbers") {
  CHECK_THAT(with([](FemConfig& c, M&) { c.base.density = 2.0; }).errors, Contains("base.density"));
  CHECK_THAT(with([](FemConfig& c, M&) { c.base.density = 1000.0; }).warnings,
             Contains("base.density is 1000"));
  CHECK_THAT(with([](FemConfig&, M& x) {
               x.permeability = {1e-7, 1e-5};
             }).warnings,
             Contains("1e-05 m/s vertically is more than 1e-07 m/s horizontally"));
  CHECK_THAT(with([](FemConfig&, M& x) { x.k0 = 0.0; }).warnings, Contains("k0 is 0"));
  CHECK_THAT(with([](FemConfig&, M& x) { x.void_ratio = 40.0; }).errors,
             Contains("a void ratio is no percentage"));
  const auto sand = [](double G0, double hpo) {
    return with([=](FemConfig&, M& x) {
      x.laws = {};
      PM4Sand::Params law;
      law.Dr = 0.35;
      law.G0 = G0;
      law.hpo = hpo;
      x.laws.of<PM4Sand>() = law;
    });
  };
  CHECK(sand(476.0, 0.53).warnings.empty());
  CHECK_THAT(sand(476e3, 0.53).warnings, Contains("pm4sand.G0 is 4.76e+05"));
  CHECK_THAT(sand(476.0, 53.0).warnings,
             Contains("pm4sand.hpo is 53, outside the usual 0.01 to 20: it is"));
}
