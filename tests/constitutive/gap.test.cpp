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
