#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("Stretches without rotation reach the closed form", "[constitutive]") {
  // F = diag(a, b, c) reached in many steps of log strain.
  const std::array<double, 3> stretch =
      GENERATE(std::array{1.5, 1.0, 1.0}, std::array{0.4, 1.2, 1.0}, std::array{3.0, 0.5, 0.9});
  const auto p = sample_params<NeoHookean>();
  const auto c = NeoHookean::constants(p, 1.0);
  const int steps = 2000;
  StressUpdate<NeoHookean::State, 3> r{{}, NeoHookean::initial_state(p)};
  StrainIncrement<3> de{};
  for (int i = 0; i < 3; ++i) de[i] = std::log(stretch[i]) / steps;
  for (int i = 0; i < steps; ++i) r = update<NeoHookean, 3>(c, r.state, r.stress, de);
  const double j = stretch[0] * stretch[1] * stretch[2], mu = c.elastic.shear;
  const double lambda = c.elastic.bulk - 2.0 / 3.0 * mu;
  CHECK(r.state.volume_ratio == Approx(j).epsilon(1e-8));
  for (int i = 0; i < 3; ++i) {
    const double expected =
        (mu * (stretch[i] * stretch[i] - 1.0) + 0.5 * lambda * (j * j - 1.0)) / j;
    CHECK(r.stress[i] == Approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("At small strain neo-Hookean is Hooke", "[constitutive]") {
  const auto p = sample_params<NeoHookean>();
  const auto c = NeoHookean::constants(p, 1.0);
  std::mt19937_64 random(3);
  for (int i = 0; i < 100; ++i) {
    const auto de = random_voigt<StrainIncrement<3>>(random, 1e-6);
    const auto s = update<NeoHookean, 3>(c, NeoHookean::initial_state(p), {}, de).stress;
    const Stress<3> linear = hooke(c.elastic, Stress<3>{}, de);
    CHECK(distance(s, linear) < 1e-4 * tensor(linear).norm());
  }
}

TEST_CASE("A closed path of strain gives the stress back", "[constitutive]") {
  // Elasticity with a potential: no work is left after a closed path; hypoelastic laws drift.
  const auto p = sample_params<NeoHookean>();
  const auto c = NeoHookean::constants(p, 1.0);
  StressUpdate<NeoHookean::State, 3> r{{}, NeoHookean::initial_state(p)};
  const int steps = 1000;
  for (const double direction : {1.0, -1.0}) {
    for (const int component : {0, 1, 0}) {
      StrainIncrement<3> de{};
      de[component] = direction * (component == 0 ? 0.3 : 0.4) / steps;
      for (int i = 0; i < steps; ++i) r = update<NeoHookean, 3>(c, r.state, r.stress, de);
    }
  }
  CHECK(tensor(r.stress).norm() < 1e-6 * c.elastic.shear);
}
