#include "constitutive/drucker_prager.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/residual_strength.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

template <class Law>
typename Law::Params soil();
template <>
MohrCoulomb::Params soil<MohrCoulomb>() {
  MohrCoulomb::Params p;
  p.youngs_modulus = 20e6, p.poisson_ratio = 0.3, p.cohesion = 1e3, p.friction_angle = 0.5;
  return p;
}
template <>
DruckerPrager::Params soil<DruckerPrager>() {
  DruckerPrager::Params p;
  p.youngs_modulus = 20e6, p.poisson_ratio = 0.3, p.cohesion = 1e3, p.friction_angle = 0.5;
  return p;
}
template <>
ResidualStrength::Params soil<ResidualStrength>() {
  ResidualStrength::Params p;
  p.youngs_modulus = 20e6, p.poisson_ratio = 0.45, p.strength = 5e3, p.soft_strength = 2e3;
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE("A wide gap takes up changes of volume without a change of pressure",
                   "[constitutive]", MohrCoulomb, DruckerPrager, ResidualStrength) {
  const auto params = soil<TestType>();
  const auto constants = TestType::constants(params, 1.0);
  auto state = TestType::initial_state(params);
  for (const double volumetric : {-0.35, -0.01, 0.01, 0.35}) {
    StrainIncrement<2, double> de{};
    de[0] = de[1] = de[2] = volumetric / 3.0;
    state.gap = 0.5;
    const auto open = TestType::template update<2>(constants, state, Stress<2>{}, de);
    CHECK(std::abs(mean_stress(open.stress)) < 1e-6);
    CHECK(open.state.gap == Approx(0.5 + volumetric));
    // Control: without a gap the same compression meets K, far above anything else here.
    state.gap = 0.0;
    const auto closed = TestType::template update<2>(constants, state, Stress<2>{}, de);
    if (volumetric < 0.0)
      CHECK(mean_stress(closed.stress) ==
            Approx(TestType::elasticity(params).bulk * volumetric).epsilon(1e-6));
  }
}

TEMPLATE_TEST_CASE("Soil in pieces has no stress until it touches again", "[constitutive]",
                   MohrCoulomb, DruckerPrager, ResidualStrength) {
  const auto params = soil<TestType>();
  const auto constants = TestType::constants(params, 1.0);
  auto state = TestType::initial_state(params);
  const Stress<2> sigma{{-1e5, -1e5, -1e5, 500.0}};
  const auto strained = [&](double gap, double volumetric) {
    state.gap = gap;
    const StrainIncrement<2> de{{0.5 * volumetric, 0.5 * volumetric, 0.0, 1e-4}};
    return update_law<TestType, 2, double>(constants, state, sigma, de, 1e-3);
  };
  CHECK(strained(0.5, 0.01).stress == Stress<2>{});
  CHECK(strained(0.5, 0.01).state.gap == Approx(0.51));
  CHECK(strained(kApart, 0.01).stress == Stress<2>{});
  // It closes: shear is carried again before pressure is.
  CHECK(strained(0.405, -0.01).stress[3] != 0.0);
  CHECK(strained(0.405, -0.01).state.gap == Approx(0.395));
  // Control: the law by itself keeps the shear stress however far the soil has opened.
  state.gap = 0.5;
  CHECK(TestType::template update<2>(constants, state, sigma, {{0.0, 0.0, 0.0, 1e-4}}).stress[3] !=
        0.0);
}
