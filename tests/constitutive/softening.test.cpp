#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Largest difference from tau(gamma) over a simple shear of `steps` equal increments to 20 %.
template <class M>
double error_in_shear(const typename M::Params& p, double peak, double soft, double eps_peak,
                      double eps_soft, int steps, double softening_scale = 1.0) {
  const auto c = M::constants(p, softening_scale);
  const double d_gamma = 0.2 / steps, g = c.elastic.shear;
  const double slope = (peak - soft) / (eps_soft - eps_peak) / std::sqrt(3.0);  // -d tau/d gamma_p
  auto state = M::initial_state(p);
  Stress<2> sigma;
  for (int d = 0; d < 3; ++d) sigma[d] = -1e6;  // far from tension; no effect on phi = 0
  double error = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const auto r = update<M, 2>(c, state, sigma, {{0.0, 0.0, 0.0, d_gamma}});
    sigma = r.stress;
    state = r.state;
    // tau = peak - slope (gamma - tau/G - gamma_peak), between G gamma and the soft strength.
    const double gamma = i * d_gamma, gamma_peak = std::sqrt(3.0) * eps_peak;
    const double falling = (peak - slope * (gamma - gamma_peak)) / (1.0 - slope / g);
    const double tau = std::min(g * gamma, std::max(soft, std::min(peak, falling)));
    error = std::max(error, std::abs(sigma[3] - tau));
  }
  return error;
}

}  // namespace

TEST_CASE("Liquefied soil in simple shear follows the line of softening", "[constitutive]") {
  ResidualStrength::Params p = sample_params<ResidualStrength>();
  p.residual_strain = 0.05;
  // The strength is that of the start of the step, so the answer lags by one increment.
  const double lag = 4e3 / 0.05 / std::sqrt(3.0) * (0.2 / 500);
  const double coarse = error_in_shear<ResidualStrength>(p, 8e3, 4e3, 0.0, 0.05, 500);
  const double fine = error_in_shear<ResidualStrength>(p, 8e3, 4e3, 0.0, 0.05, 1000);
  CHECK(coarse < 1.2 * lag);
  CHECK(fine < 0.55 * coarse);
  // control: another softening strain is not mistaken for this one
  CHECK(error_in_shear<ResidualStrength>(p, 8e3, 4e3, 0.0, 0.06, 1000) > 5.0 * coarse);
  // crack band: half the cell, twice the softening strain
  CHECK(error_in_shear<ResidualStrength>(p, 8e3, 4e3, 0.0, 0.10, 1000, 0.5) < lag);
}

TEST_CASE("Mohr-Coulomb without friction softens along the same line after its peak",
          "[constitutive]") {
  MohrCoulomb::Params p = sample_params<MohrCoulomb>();
  p.youngs_modulus = 5e6;
  p.cohesion = 8e3;
  p.friction_angle = p.dilation_angle = 0.0;
  p.residual_cohesion = 4e3;
  p.peak_strain = 0.02;
  p.residual_strain = 0.07;
  const double lag = 4e3 / 0.05 / std::sqrt(3.0) * (0.2 / 500);
  const double coarse = error_in_shear<MohrCoulomb>(p, 8e3, 4e3, 0.02, 0.07, 500);
  CHECK(coarse < 1.2 * lag);
  CHECK(error_in_shear<MohrCoulomb>(p, 8e3, 4e3, 0.02, 0.07, 1000) < 0.55 * coarse);
}

TEST_CASE("The friction angle softens linearly", "[constitutive]") {
  MohrCoulomb::Params p = sample_params<MohrCoulomb>();
  p.residual_friction_angle = 20.0 * kDegree;
  p.peak_strain = 0.1;
  p.residual_strain = 0.3;
  const MohrCoulomb::Constants c = MohrCoulomb::constants(p, 1.0);
  for (const auto& [strain, degrees] :
       {std::pair{0.0, 30.0}, {0.1, 30.0}, {0.15, 27.5}, {0.2, 25.0}, {0.3, 20.0}, {2.0, 20.0}}) {
    const double s = std::sin(degrees * kDegree);
    CHECK(MohrCoulomb::surface(c, MohrCoulomb::State{strain, 0.0, 0.0}).k ==
          Approx((1 + s) / (1 - s)).epsilon(1e-13));
  }
}

TEST_CASE("Softening degree and its scaling", "[constitutive]") {
  const auto s = LinearSoftening::scaled(0.1, 0.5, 1.0);
  CHECK(s.degree(0.0) == 0.0);
  CHECK(s.degree(0.1) == 0.0);
  CHECK(s.degree(0.3) == Approx(0.5));
  CHECK(s.degree(0.5) == Approx(1.0));
  CHECK(s.degree(9.0) == 1.0);
  // Twice the reference length: both strains halve.
  const auto coarse = LinearSoftening::scaled(0.1, 0.5, 2.0);
  CHECK(coarse.degree(0.05) == 0.0);
  CHECK(coarse.degree(0.15) == Approx(0.5));
  CHECK(coarse.degree(0.25) == Approx(1.0));
  // A width that is not positive switches softening off.
  CHECK(LinearSoftening::scaled(0.5, 0.5, 1.0).degree(10.0) == 0.0);
  CHECK(LinearSoftening::scaled(0.0, 0.0, 1.0).degree(10.0) == 0.0);
}

TEST_CASE("Strength that is reported is strength that acts", "[constitutive]") {
  ResidualStrength::Params p = sample_params<ResidualStrength>();
  const auto c = ResidualStrength::constants(p, 1.0);
  auto state = ResidualStrength::initial_state(p);
  CHECK(ResidualStrength::present_strength(c, state) == 8e3);
  state.plastic_strain = 0.25;  // of residual_strain = 1: a quarter of the way from 8 to 4 kPa
  CHECK(ResidualStrength::present_strength(c, state) == Approx(7e3));
  const auto r = update<ResidualStrength, 2>(c, state, {}, {{0.0, 0.0, 0.0, 0.1}});
  CHECK(r.stress[3] == Approx(7e3));
  // What the points bring overrules what the material says.
  state.strength = state.soft_strength = 1e3;
  CHECK(update<ResidualStrength, 2>(c, state, {}, {{0.0, 0.0, 0.0, 0.1}}).stress[3] == Approx(1e3));
  p.strength.reset();
  CHECK(!is_set(ResidualStrength::initial_state(p).strength));
}

TEMPLATE_TEST_CASE_SIG("Liquefied soil keeps q and mean tension below their limits",
                       "[constitutive]", ((int Dim), Dim), 2, 3) {
  ResidualStrength::Params p = sample_params<ResidualStrength>();
  p.tension_cutoff = 500.0;
  const auto c = ResidualStrength::constants(p, 1.0);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> power(0.0, 6.0);
  for (int i = 0; i < 100000; ++i) {
    const auto sigma = random_voigt<Stress<Dim>>(random, std::pow(10.0, power(random)));
    const auto r = update<ResidualStrength, Dim>(c, ResidualStrength::initial_state(p), sigma, {});
    REQUIRE(equivalent_shear(r.stress) <= std::sqrt(3.0) * 8e3 * (1 + 1e-12) + 1e-9);
    REQUIRE(mean_stress(r.stress) <= 500.0 + 1e-12 * tensor(sigma).norm());
    REQUIRE(r.state.plastic_strain >= 0.0);
    REQUIRE(r.state.gap >= 0.0);
  }
}

TEST_CASE("Liquefied soil that was pulled apart closes before it carries again", "[constitutive]") {
  const auto p = sample_params<ResidualStrength>();
  const auto c = ResidualStrength::constants(p, 1.0);
  const Stress<2> start{{-2e3, -2e3, -2e3, 0.0}};
  auto r = update<ResidualStrength, 2>(c, ResidualStrength::initial_state(p), start,
                                       {{0.0, 0.02, 0.0, 0.0}});
  CHECK(mean_stress(r.stress) == Approx(0.0).margin(1e-9));
  CHECK(r.state.gap == Approx(0.02 - 2e3 / c.elastic.bulk));
  // Half closed: still nothing. Closed: the pressure of the start, and not more.
  auto half = update<ResidualStrength, 2>(c, r.state, r.stress, {{0.0, -0.01, 0.0, 0.0}});
  CHECK(mean_stress(half.stress) == Approx(0.0).margin(1e-9));
  const auto closed =
      update<ResidualStrength, 2>(c, half.state, half.stress, {{0.0, -0.01, 0.0, 0.0}});
  CHECK(mean_stress(closed.stress) == Approx(-2e3).epsilon(1e-9));
  CHECK(closed.state.gap == 0.0);
  half.state.gap = 0.0;  // control
  CHECK(
      mean_stress(update<ResidualStrength, 2>(c, half.state, half.stress, {{0.0, -0.01, 0.0, 0.0}})
                      .stress) < -500e3);
}
