#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Shear stress after shearing at a constant rate for long.
template <class M>
double steady_shear(const typename M::Params& p, double rate, Stress<2> s = {}) {
  const auto c = M::constants(p, 1.0);
  typename M::State state = M::initial_state(p);
  const double dt = 1e-5;
  for (int i = 0; i < 20000; ++i) {
    const auto r = update<M, 2>(c, state, s, {{0.0, 0.0, 0.0, rate * dt}}, dt);
    s = r.stress;
    state = r.state;
  }
  return s[3];
}

}  // namespace

TEST_CASE("Fluids settle on their flow curve", "[constitutive]") {
  const double rate = GENERATE(0.5, 3.0, 40.0);
  const auto newton = sample_params<NewtonianFluid>();
  CHECK(steady_shear<NewtonianFluid>(newton, rate) == Approx(newton.viscosity * rate));
  const auto bingham = sample_params<Bingham>();
  CHECK(steady_shear<Bingham>(bingham, rate) ==
        Approx(bingham.yield_stress + bingham.viscosity * rate));
  auto hb = sample_params<HerschelBulkley>();
  for (const double n : {0.4, 1.0, 1.6}) {
    hb.flow_index = n;
    CHECK(steady_shear<HerschelBulkley>(hb, rate) ==
          Approx(hb.yield_stress + hb.consistency * std::pow(rate, n)));
  }
}

TEST_CASE("Below the yield stress a Bingham fluid does not flow", "[constitutive]") {
  const auto p = sample_params<Bingham>();
  const auto c = Bingham::constants(p, 1.0);
  const double gamma = 0.9 * p.yield_stress / c.elastic.shear;
  auto r = update<Bingham, 2>(c, {}, {}, {{0.0, 0.0, 0.0, gamma}});
  const double held = r.stress[3];
  for (int i = 0; i < 1000; ++i) r = update<Bingham, 2>(c, r.state, r.stress, {});
  CHECK(r.stress[3] == held);
  CHECK(r.state.plastic_strain == 0.0);
  // Control: a Newtonian fluid gives way.
  const auto cn = NewtonianFluid::constants(sample_params<NewtonianFluid>(), 1.0);
  auto n = update<NewtonianFluid, 2>(cn, {}, {}, {{0.0, 0.0, 0.0, gamma}});
  for (int i = 0; i < 1000; ++i) n = update<NewtonianFluid, 2>(cn, n.state, n.stress, {});
  CHECK(std::abs(n.stress[3]) < 1e-6 * held);
}

TEST_CASE("Pressure follows the equation of state, and tension opens a gap", "[constitutive]") {
  auto p = sample_params<NewtonianFluid>();
  p.eos_exponent = GENERATE(1.0, 7.0);
  const auto c = NewtonianFluid::constants(p, 1.0);
  const double log_j = std::log(0.98);
  StressUpdate<NewtonianFluid::State, 3> r{};
  for (int i = 0; i < 100; ++i) {
    const double e = log_j / 300.0;
    r = update<NewtonianFluid, 3>(c, r.state, r.stress, {{e, e, e, 0.0, 0.0, 0.0}});
  }
  const double n = p.eos_exponent;
  CHECK(r.state.volume_ratio == Approx(0.98).epsilon(1e-10));
  CHECK(-mean_stress(r.stress) ==
        Approx(p.bulk_modulus / n * (std::pow(0.98, -n) - 1.0)).epsilon(1e-8));
  // Back and 5 % beyond: no tension; closed again: the same pressure as before.
  for (const double total : {-log_j + 0.05, -0.05 + log_j}) {
    for (int i = 0; i < 1000; ++i) {
      const double e = total / 3000.0;
      r = update<NewtonianFluid, 3>(c, r.state, r.stress, {{e, e, e, 0.0, 0.0, 0.0}});
    }
    if (total > 0.0) {
      CHECK(mean_stress(r.stress) == Approx(0.0).margin(1.0));
      CHECK(r.state.gap == Approx(0.05).epsilon(1e-3));
    }
  }
  CHECK(-mean_stress(r.stress) ==
        Approx(p.bulk_modulus / n * (std::pow(0.98, -n) - 1.0)).epsilon(1e-3));
}

TEST_CASE("Granular flow settles on mu(I)", "[constitutive]") {
  const auto p = sample_params<MuI>();
  const double pressure = GENERATE(500.0, 20e3), rate = GENERATE(1.0, 20.0, 200.0);
  const Stress<2> start{{-pressure, -pressure, -pressure, 0.0}};
  const double inertial = rate * p.grain_size * std::sqrt(p.grain_density / pressure);
  const double mu = p.mu_static + (p.mu_limit - p.mu_static) / (p.inertial_number / inertial + 1.0);
  CHECK(steady_shear<MuI>(p, rate, start) == Approx(mu * pressure).epsilon(1e-6));
  CHECK(mu > 1.0001 * p.mu_static);
}

TEST_CASE("Granular flow beside plane flow is as strong as Matsuoka and Nakai have it",
          "[constitutive]") {
  auto p = sample_params<MuI>();
  p.mu_static = p.mu_limit = GENERATE(0.3, 0.577, 0.9);
  const double k = (9.0 - 3.0 * p.mu_static * p.mu_static) / (1.0 - p.mu_static * p.mu_static);
  const auto determinant = [](const Stress<3>& s) {  // order xx, yy, zz, xy, yz, zx
    return s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
           s[5] * (s[3] * s[4] - s[1] * s[5]);
  };
  // triaxial compression, extension, and something between
  const auto shape = GENERATE(Stress<3>{{1.0, 1.0, -2.0}}, Stress<3>{{-1.0, -1.0, 2.0}},
                              Stress<3>{{1.0, 0.2, -1.2, 0.3, -0.4, 0.1}});
  for (const double w : {1.0, 0.0}) {
    p.lode_dependence = w;
    const auto c = MuI::constants(p, 1.0);
    MuI::State state;
    Stress<3> s{{-10e3, -10e3, -10e3}};
    for (int i = 0; i < 200; ++i) {
      StrainIncrement<3> de;
      for (int j = 0; j < 6; ++j) de[j] = 1e-4 * shape[j] * (j < 3 ? 1.0 : 2.0);
      s = update<MuI, 3>(c, state, s, de, 1e-4).stress;
    }
    const double mean = -mean_stress(s), second = j2(s);
    CHECK(mean == Approx(10e3).epsilon(1e-12));
    if (w == 0.0) {  // control: the circle, as Jop et al. (2006) have it
      CHECK(std::sqrt(second) == Approx(p.mu_static * mean).epsilon(1e-9));
    } else {  // I1 I2 = k I3
      const double i2 = 3.0 * mean * mean - second;
      CHECK(3.0 * mean * i2 == Approx(-k * determinant(s)).epsilon(1e-8));
    }
  }
}

TEST_CASE("Grains with hardly any friction keep what little they have", "[constitutive]") {
  auto p = sample_params<MuI>();
  for (const double mu : {1e-9, 1e-6, 1e-3}) {
    p.mu_static = mu;
    const auto c = MuI::constants(p, 1.0);
    CHECK(MuI::lode_factor(c, 1.0, -0.3849) == Approx(1.0).margin(mu));
  }
  p.mu_static = 0.577;
  const auto c = MuI::constants(p, 1.0);
  CHECK(MuI::lode_factor(c, 1.0, -MuI::kMostLode) == Approx(1.264).epsilon(1e-3));
  CHECK(MuI::lode_factor(c, 1.0, MuI::kMostLode) == Approx(0.890).epsilon(1e-3));
  CHECK(MuI::lode_factor(c, 0.0, 0.0) == 1.0);
  // no grains have the friction from which the surface is all but a triangle
  p.mu_static = 0.95;
  p.mu_limit = 1.0;
  CHECK_THROWS_WITH(check(p), Catch::Contains("72 degrees") && Catch::Contains("lode_dependence"));
  p.lode_dependence = 0.0;
  CHECK_NOTHROW(check(p));
}

TEST_CASE("Grains that have parted carry nothing, sheared or pressed for a step",
          "[constitutive]") {
  const auto c = MuI::constants(sample_params<MuI>(), 1.0);
  MuI::State state;
  state.gap = 0.5;
  for (const double closing : {0.0, 0.1, 0.38}) {
    const auto r = update<MuI, 2>(c, state, Stress<2>{}, {{-closing, 0.0, 0.0, 0.2}}, 1e-4);
    for (int i = 0; i < 4; ++i) CHECK(std::abs(r.stress[i]) < 1e-14 * c.elastic.bulk);
    CHECK(r.state.gap == Approx(0.5 - closing));
  }
  // Pressed by more than was open they carry again.
  const auto r = update<MuI, 2>(c, state, Stress<2>{}, {{-0.6, 0.0, 0.0, 0.2}}, 1e-4);
  CHECK(r.stress[1] < 0.0);
}
