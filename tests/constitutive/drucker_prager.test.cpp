#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

DruckerPrager::Params with(double phi, double psi) {
  DruckerPrager::Params p = sample_params<DruckerPrager>();
  p.friction_angle = phi * kDegree;
  p.dilation_angle = psi * kDegree;
  return p;
}

/// Shortened along y in plane strain with the lateral stress held, until it flows.
Stress<2> biaxial_failure(const DruckerPrager::Params& p) {
  const auto c = DruckerPrager::constants(p, 1.0);
  DruckerPrager::State state;
  Stress<2> s{{-50e3, -50e3, -50e3, 0.0}};
  for (int i = 0; i < 30000; ++i) {
    StrainIncrement<2> de{{1e-6, -2e-6, 0.0, 0.0}};
    // The lateral strain that keeps sigma_xx, by secant steps.
    for (int k = 0; k < 8; ++k) {
      const double off = update<DruckerPrager, 2>(c, state, s, de).stress[0] + 50e3;
      de[0] -= off / (c.elastic.bulk + 4.0 / 3.0 * c.elastic.shear);
    }
    const auto r = update<DruckerPrager, 2>(c, state, s, de);
    s = r.stress;
    state = r.state;
  }
  return s;
}

}  // namespace

TEST_CASE("In plane strain the cone fails where Mohr-Coulomb does", "[constitutive]") {
  const auto [phi, psi] =
      GENERATE(std::pair{30.0, 0.0}, std::pair{30.0, 15.0}, std::pair{30.0, 30.0},
               std::pair{20.0, 5.0}, std::pair{0.0, 0.0});
  const auto p = with(phi, psi);
  const Stress<2> s = biaxial_failure(p);
  const double radius = 0.5 * std::abs(s[0] - s[1]), centre = 0.5 * (s[0] + s[1]);
  const double expected =
      p.cohesion * std::cos(p.friction_angle) - centre * std::sin(p.friction_angle);
  CAPTURE(phi, psi);
  CHECK(s[0] == Approx(-50e3).epsilon(1e-3));
  CHECK(radius == Approx(expected).epsilon(2e-3));
}

TEST_CASE("With psi = phi the return to cone and cap is the closest point", "[constitutive]") {
  DruckerPrager::Params p = with(30.0, 30.0);
  const double cutoff = GENERATE(-1.0, 0.0, 4e3);
  if (cutoff >= 0.0) p.tension_cutoff = cutoff;
  const auto c = DruckerPrager::constants(p, 1.0);
  const auto y = DruckerPrager::surface(c, DruckerPrager::State{});
  std::mt19937_64 random(5);
  int cap = 0, cone = 0;
  for (int i = 0; i < 30000; ++i) {
    const auto trial = random_voigt<Stress<3>>(random, 20e3);
    const Stress<3> s = update<DruckerPrager, 3>(c, {}, trial, {}).stress;
    const double tau = std::sqrt(j2(s)), mean = mean_stress(s);
    REQUIRE(tau + y.alpha * mean - y.k < 1e-9 * 20e3);
    REQUIRE(mean - y.tension < 1e-9 * 20e3);
    // The step from s to the trial points out of the set: towards no admissible point.
    const double dp = (mean_stress(trial) - mean) / c.elastic.bulk;
    const double dt = (std::sqrt(j2(trial)) - tau) / c.elastic.shear;
    for (const auto& [tau2, p2] : {std::pair{0.0, double(y.tension)},
                                   std::pair{y.k - y.alpha * y.tension, double(y.tension)},
                                   std::pair{y.k + y.alpha * 1e6, -1e6}, std::pair{0.0, -1e6}})
      REQUIRE(dp * (p2 - mean) + dt * (tau2 - tau) < 1e-6);
    cap += mean > y.tension - 1.0;
    cone += std::abs(tau + y.alpha * mean - y.k) < 1.0;
  }
  CHECK(cap > 20);
  CHECK(cone > 1000);
}

TEST_CASE("What tension opens closes before pressure returns", "[constitutive]") {
  const auto c = DruckerPrager::constants(with(30.0, 0.0), 1.0);
  auto r = update<DruckerPrager, 3>(c, {}, {}, {{2e-3, 2e-3, 2e-3, 0.0, 0.0, 0.0}});
  CHECK(r.state.gap > 5e-3);
  const auto half =
      update<DruckerPrager, 3>(c, r.state, r.stress, {{-1e-3, -1e-3, -1e-3, 0, 0, 0}});
  CHECK(half.state.gap == Approx(r.state.gap - 3e-3));
  r = update<DruckerPrager, 3>(c, half.state, half.stress, {{-1e-3, -1e-3, -1e-3, 0, 0, 0}});
  CHECK(r.state.gap == 0.0);
  CHECK(mean_stress(r.stress) == Approx(0.0).margin(1e-9 * c.elastic.bulk));
}

TEST_CASE("The cone softens towards its residual", "[constitutive]") {
  DruckerPrager::Params p = with(30.0, 0.0);
  p.residual_cohesion = 1e3;
  p.residual_friction_angle = 20.0 * kDegree;
  p.residual_strain = 0.02;
  const auto c = DruckerPrager::constants(p, 1.0);
  DruckerPrager::State state;
  Stress<2> s{{-50e3, -50e3, -50e3, 0.0}};
  double peak = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const auto r = update<DruckerPrager, 2>(c, state, s, {{0.0, 0.0, 0.0, 1e-4}});
    s = r.stress;
    state = r.state;
    peak = std::max(peak, std::sqrt(j2(s)));
  }
  // Simple shear at constant volume without dilation keeps p.
  CHECK(peak == Approx(5e3 * std::cos(0.5235987755982988) + 25e3).epsilon(0.02));
  CHECK(std::sqrt(j2(s)) ==
        Approx(1e3 * std::cos(20.0 * kDegree) + 50e3 * std::sin(20.0 * kDegree)).epsilon(1e-6));
  CHECK(DruckerPrager::present_strength(c, state) == Approx(1e3));
}
