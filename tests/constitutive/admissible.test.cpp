#include "tests/constitutive/sample_laws.hpp"

#include <cmath>
#include <tuple>
#include <type_traits>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

MohrCoulomb::Params soil() {
  MohrCoulomb::Params p;
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.cohesion = 1e3;
  p.friction_angle = 0.5235987755982988;  // 30 degrees: k = 3
  return p;
}

Stress<2> returned_by(const MohrCoulomb::Constants& c, const MohrCoulomb::State& s,
                      const Stress<2>& total) {
  return MohrCoulomb::admissible(c, s, total, LiquefiedReturn::vertical_stress).stress;
}

/// Laws of the runout, whichever they are.
template <class List>
struct TypesOf;
template <class... M>
struct TypesOf<LawList<M...>> {
  using type = std::tuple<M...>;
};
using LawsOfRunout = TypesOf<FlowLaws>::type;

}  // namespace

TEMPLATE_LIST_TEST_CASE("What a law admits it admits unchanged, and it admits what it returns",
                        "[constitutive]", LawsOfRunout) {
  using M = TestType;
  const auto params = sample_params<M>();
  const auto c = M::constants(params, 1.0);
  std::mt19937_64 random(11);
  int outside = 0, inside = 0;
  for (int i = 0; i < 3000; ++i) {
    auto total = random_voigt<Stress<2>>(random, i % 4 == 1 ? 3e3 : 60e3);
    for (int k = 0; k < 3; ++k) total[k] -= i % 2 ? 60e3 : 0.0;
    auto state = M::initial_state(params);
    if constexpr (requires { state.pore_pressure; }) state.pore_pressure = i % 3 ? 20e3 : 0.0;
    const AdmissibleStress r = M::admissible(c, state, total, LiquefiedReturn::vertical_stress);
    CHECK(r.after <= 1e-9);
    CHECK(r.after <= std::max(r.before, 1e-9));
    const AdmissibleStress again =
        M::admissible(c, state, r.stress, LiquefiedReturn::vertical_stress);
    CHECK(distance(again.stress, r.stress) <= 1e-6 * 60e3);
    CHECK(again.before <= 1e-9);
    if (r.before > 1e-9) {
      ++outside;
      CHECK(distance(r.stress, total) > 0.0);
    } else {
      ++inside;
      CHECK(distance(r.stress, total) <= 1e-10 * 60e3);
    }
  }
  constexpr bool elastic = std::is_same_v<M, LinearElastic> || std::is_same_v<M, NeoHookean>;
  CHECK((outside > 300) == !elastic);  // control: the stresses ask something of the law
  CHECK(inside > 30);
}

TEST_CASE("The surfaces of other laws are met where they are known", "[constitutive]") {
  constexpr LiquefiedReturn keeps = LiquefiedReturn::vertical_stress;
  const Stress<2> total{{-50e3, -50e3, -50e3, 120e3}};  // p = 50 kPa, tau = 120 kPa
  const auto at_rest = [&]<class M>(std::type_identity<M>) {
    const auto params = sample_params<M>();
    return M::admissible(M::constants(params, 1.0), M::initial_state(params), total, keeps).stress;
  };
  // mu(I): no more than mu_2 p.
  CHECK(at_rest(std::type_identity<MuI>{})[3] == Approx(0.64 * 50e3));
  // Modified Cam Clay: q = M sqrt(p (p_c - p)) with q = sqrt(3) tau.
  CHECK(at_rest(std::type_identity<ModifiedCamClay>{})[3] ==
        Approx(1.1 * std::sqrt(50e3 * 22e3) / std::sqrt(3.0)));
  // NorSand: q = p M_i (1 + ln(p_i/p)), M_i = M - N chi_i |psi_i|.
  const double chi = 3.5 / (1.0 - 0.03 * 3.5 / 1.25);
  const double psi = 0.75 - 0.9 + 0.03 * std::log(200.0);
  const double m = 1.25 - 0.3 * chi * std::abs(psi);
  CHECK(at_rest(std::type_identity<NorSand>{})[3] ==
        Approx(50e3 * m * (1.0 + std::log(4.0)) / std::sqrt(3.0)));
  // Fluids carry the shear at some rate, but no tension.
  CHECK(at_rest(std::type_identity<Bingham>{})[3] == 120e3);
  const auto fluid = sample_params<NewtonianFluid>();
  CHECK(NewtonianFluid::admissible(NewtonianFluid::constants(fluid, 1.0), {},
                                   {{3e3, 1e3, 2e3, 5e3}}, keeps)
            .stress == Stress<2>{{1e3, -1e3, 0.0, 5e3}});
}

TEST_CASE("Mohr-Coulomb stress is left alone inside and brought to the surface outside",
          "[constitutive]") {
  const MohrCoulomb::Constants c = MohrCoulomb::constants(soil(), 1.0);
  const MohrCoulomb::State dry{};
  const MohrCoulombSurface<double> surface = MohrCoulomb::surface(c, dry);

  const Stress<2> inside{{-50e3, -100e3, -50e3, 0.0}};
  CHECK(MohrCoulomb::violation(surface, inside) < 0.0);
  const Stress<2> same = returned_by(c, dry, inside);
  for (int i = 0; i < 4; ++i) CHECK(same[i] == Approx(inside[i]).margin(1e-9));

  // k = 3 and 2 c sqrt(k) = 3464 Pa: at s1 = -10 kPa the soil carries 33.5 kPa.
  const Stress<2> outside{{-10e3, -100e3, -20e3, 0.0}};
  CHECK(MohrCoulomb::violation(surface, outside) ==
        Approx(100e3 / (3.0 * 10e3 + 2e3 * std::sqrt(3.0)) - 1.0));
  const Stress<2> returned = returned_by(c, dry, outside);
  CHECK(std::abs(MohrCoulomb::violation(surface, returned)) < 1e-12);
}

TEST_CASE("Friction under water acts on effective stress", "[constitutive]") {
  const MohrCoulomb::Constants c = MohrCoulomb::constants(soil(), 1.0);
  MohrCoulomb::State wet{};
  wet.pore_pressure = 60e3;
  // Admissible in total stress, not in effective stress: -10 and -50 kPa.
  const Stress<2> total{{-70e3, -110e3, -70e3, 0.0}};
  CHECK(MohrCoulomb::violation(MohrCoulomb::surface(c, MohrCoulomb::State{}), total) < 0.0);
  const Stress<2> returned = returned_by(c, wet, total);
  Stress<2> effective = returned;
  for (int i = 0; i < 3; ++i) effective[i] += wet.pore_pressure;
  CHECK(std::abs(MohrCoulomb::violation(MohrCoulomb::surface(c, wet), effective)) < 1e-12);
  CHECK(returned[1] > total[1]);
}

TEST_CASE("Liquefied soil keeps what the method says", "[constitutive]") {
  const double s_r = 5e3;
  const Stress<2> total{{-150e3, -200e3, -150e3, 10e3}};
  CHECK(ResidualStrength::violation(s_r, 0.0, total) > 1.0);

  const Stress<2> vertical =
      ResidualStrength::brought_back(LiquefiedReturn::vertical_stress, s_r, 0.0, total);
  CHECK(vertical[1] == Approx(-200e3).epsilon(1e-14));
  CHECK(equivalent_shear(vertical) == Approx(std::sqrt(3.0) * s_r).epsilon(1e-12));
  CHECK(vertical[0] < total[0]);
  CHECK(vertical[0] - vertical[2] == Approx(0.0).margin(1e-6));

  const Stress<2> mean =
      ResidualStrength::brought_back(LiquefiedReturn::mean_stress, s_r, 0.0, total);
  CHECK(mean_stress(mean) == Approx(mean_stress(total)).epsilon(1e-14));
  CHECK(equivalent_shear(mean) == Approx(std::sqrt(3.0) * s_r).epsilon(1e-12));
  CHECK(ResidualStrength::brought_back(LiquefiedReturn::none, s_r, 0.0, total) == total);

  const Stress<2> weak{{-199e3, -200e3, -199e3, 1e3}};
  const Stress<2> kept =
      ResidualStrength::brought_back(LiquefiedReturn::vertical_stress, s_r, 0.0, weak);
  for (int i = 0; i < 4; ++i) CHECK(kept[i] == Approx(weak[i]).epsilon(1e-14));
}

TEST_CASE("Liquefied soil has no mean tension after the return", "[constitutive]") {
  const double s_r = 3e3;
  for (const LiquefiedReturn method :
       {LiquefiedReturn::vertical_stress, LiquefiedReturn::mean_stress}) {
    for (const Stress<2>& total :
         {Stress<2>{{4e3, -1e3, 4e3, 1e3}}, Stress<2>{{5e3, 5e3, 5e3, 0.0}},
          Stress<2>{{-9e3, 2e3, -1e3, -8e3}}}) {
      const Stress<2> r = ResidualStrength::brought_back(method, s_r, 0.0, total);
      CHECK(ResidualStrength::violation(s_r, 0.0, r) < 1e-12);
    }
  }
  const Stress<2> crust = ResidualStrength::brought_back(LiquefiedReturn::vertical_stress, s_r, 0.0,
                                                         {{4e3, -1e3, 4e3, 1e3}});
  CHECK(crust[1] == Approx(-1e3).epsilon(1e-12));
}
