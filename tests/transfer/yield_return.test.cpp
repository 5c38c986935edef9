#include "transfer/map/yield_return.hpp"

#include <cmath>

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

}  // namespace

TEST_CASE("Mohr-Coulomb stress is left alone inside and brought to the surface outside",
          "[transfer]") {
  const MohrCoulomb::Constants c = MohrCoulomb::constants(soil(), 1.0);
  const MohrCoulomb::State dry{};
  const MohrCoulombSurface<double> surface = MohrCoulomb::surface(c, dry);

  const Stress<2> inside{{-50e3, -100e3, -50e3, 0.0}};
  CHECK(relative_violation(surface, inside) < 0.0);
  const Stress<2> same = return_mohr_coulomb(c, dry, inside);
  for (int i = 0; i < 4; ++i) CHECK(same[i] == Approx(inside[i]).margin(1e-9));

  // k = 3 and 2 c sqrt(k) = 3464 Pa: at s1 = -10 kPa the soil carries 33.5 kPa.
  const Stress<2> outside{{-10e3, -100e3, -20e3, 0.0}};
  CHECK(relative_violation(surface, outside) ==
        Approx(100e3 / (3.0 * 10e3 + 2e3 * std::sqrt(3.0)) - 1.0));
  const Stress<2> returned = return_mohr_coulomb(c, dry, outside);
  CHECK(std::abs(relative_violation(surface, returned)) < 1e-12);
}

TEST_CASE("Friction under water acts on effective stress", "[transfer]") {
  const MohrCoulomb::Constants c = MohrCoulomb::constants(soil(), 1.0);
  MohrCoulomb::State wet{};
  wet.pore_pressure = 60e3;
  // Admissible in total stress, not in effective stress: -10 and -50 kPa.
  const Stress<2> total{{-70e3, -110e3, -70e3, 0.0}};
  CHECK(relative_violation(MohrCoulomb::surface(c, MohrCoulomb::State{}), total) < 0.0);
  const Stress<2> returned = return_mohr_coulomb(c, wet, total);
  Stress<2> effective = returned;
  for (int i = 0; i < 3; ++i) effective[i] += wet.pore_pressure;
  CHECK(std::abs(relative_violation(MohrCoulomb::surface(c, wet), effective)) < 1e-12);
  CHECK(returned[1] > total[1]);
}

TEST_CASE("Liquefied soil keeps what the method says", "[transfer]") {
  const double s_r = 5e3;
  const Stress<2> total{{-150e3, -200e3, -150e3, 10e3}};
  CHECK(relative_violation(s_r, 0.0, total) > 1.0);

  const Stress<2> vertical = return_liquefied(LiquefiedReturn::vertical_stress, s_r, 0.0, total);
  CHECK(vertical[1] == Approx(-200e3).epsilon(1e-14));
  CHECK(equivalent_shear(vertical) == Approx(std::sqrt(3.0) * s_r).epsilon(1e-12));
  CHECK(vertical[0] < total[0]);
  CHECK(vertical[0] - vertical[2] == Approx(0.0).margin(1e-6));

  const Stress<2> mean = return_liquefied(LiquefiedReturn::mean_stress, s_r, 0.0, total);
  CHECK(mean_stress(mean) == Approx(mean_stress(total)).epsilon(1e-14));
  CHECK(equivalent_shear(mean) == Approx(std::sqrt(3.0) * s_r).epsilon(1e-12));
  CHECK(return_liquefied(LiquefiedReturn::none, s_r, 0.0, total) == total);

  const Stress<2> weak{{-199e3, -200e3, -199e3, 1e3}};
  const Stress<2> kept = return_liquefied(LiquefiedReturn::vertical_stress, s_r, 0.0, weak);
  for (int i = 0; i < 4; ++i) CHECK(kept[i] == Approx(weak[i]).epsilon(1e-14));
}

TEST_CASE("Liquefied soil has no mean tension after the return", "[transfer]") {
  const double s_r = 3e3;
  for (const LiquefiedReturn method :
       {LiquefiedReturn::vertical_stress, LiquefiedReturn::mean_stress}) {
    for (const Stress<2>& total :
         {Stress<2>{{4e3, -1e3, 4e3, 1e3}}, Stress<2>{{5e3, 5e3, 5e3, 0.0}},
          Stress<2>{{-9e3, 2e3, -1e3, -8e3}}}) {
      const Stress<2> r = return_liquefied(method, s_r, 0.0, total);
      CHECK(relative_violation(s_r, 0.0, r) < 1e-12);
    }
  }
  const Stress<2> crust =
      return_liquefied(LiquefiedReturn::vertical_stress, s_r, 0.0, {{4e3, -1e3, 4e3, 1e3}});
  CHECK(crust[1] == Approx(-1e3).epsilon(1e-12));
}
