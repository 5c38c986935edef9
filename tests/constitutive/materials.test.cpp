#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "(no InputError)";
}

std::map<std::string, double> mohr_coulomb() {
  return {
      {"youngs_modulus", 20e6}, {"poisson_ratio", 0.3}, {"cohesion", 5e3}, {"friction_angle", 0.5}};
}

}  // namespace

TEST_CASE("A material survives the way through its parameters by name", "[constitutive]") {
  MohrCoulomb::Params mc = sample_params<MohrCoulomb>();
  mc.residual_friction_angle = 0.3;
  mc.tension_cutoff = 0.0;
  mc.peak_strain = 0.125;
  ResidualStrength::Params bare = sample_params<ResidualStrength>();
  bare.strength.reset();
  bare.soft_strength.reset();
  const AnyMaterial materials[] = {Material<LinearElastic>{sample_params<LinearElastic>()},
                                   Material<MohrCoulomb>{mc},
                                   Material<ResidualStrength>{sample_params<ResidualStrength>()},
                                   Material<ResidualStrength>{bare}};
  for (const AnyMaterial& m : materials) {
    const LawParameters p = to_parameters(m);
    const AnyMaterial back = from_parameters(p.law, p.parameters);
    CHECK(back.index() == m.index());
    const LawParameters again = to_parameters(back);
    CHECK(again.law == p.law);
    CHECK(again.parameters == p.parameters);
  }
  // Value by value for one of them, as both directions could drop the same parameter.
  const auto back = std::get<Material<MohrCoulomb>>(
      from_parameters("mohr_coulomb", to_parameters(Material<MohrCoulomb>{mc}).parameters));
  CHECK(back.params.youngs_modulus == mc.youngs_modulus);
  CHECK(back.params.poisson_ratio == mc.poisson_ratio);
  CHECK(back.params.cohesion == mc.cohesion);
  CHECK(back.params.friction_angle == mc.friction_angle);
  CHECK(back.params.dilation_angle == mc.dilation_angle);
  CHECK(back.params.tension_cutoff == mc.tension_cutoff);
  CHECK(!back.params.residual_cohesion);
  CHECK(back.params.residual_friction_angle == mc.residual_friction_angle);
  CHECK(back.params.peak_strain == mc.peak_strain);
  CHECK(back.params.residual_strain == mc.residual_strain);
  // What the points bring stays open.
  CHECK(to_parameters(Material<ResidualStrength>{bare}).parameters.count("strength") == 0);
}

TEST_CASE("Parameters by name are checked", "[constitutive]") {
  REQUIRE_NOTHROW(from_parameters("mohr_coulomb", mohr_coulomb()));
  const auto with = [](std::string law, const std::string& key, double value) {
    return message_of([&] {
      auto p = mohr_coulomb();
      p[key] = value;
      from_parameters(law, p);
    });
  };
  CHECK_THAT(with("mohr-coulomb", "cohesion", 1.0), Contains("'mohr-coulomb'"));
  CHECK_THAT(with("mohr_coulomb", "cohesin", 1.0), Contains("cohesin"));
  CHECK_THAT(with("mohr_coulomb", "cohesion", -1.0), Contains("cohesion") && Contains("range"));
  CHECK_THAT(with("mohr_coulomb", "cohesion", kUnset), Contains("cohesion"));
  CHECK_THAT(with("mohr_coulomb", "poisson_ratio", 0.5), Contains("poisson_ratio"));
  CHECK_THAT(with("mohr_coulomb", "youngs_modulus", 0.0), Contains("youngs_modulus"));
  CHECK_THAT(with("mohr_coulomb", "friction_angle", 30.0), Contains("friction_angle"));
  CHECK_THAT(with("linear_elastic", "cohesion", 1.0), Contains("linear_elastic"));
  for (const char* key : {"youngs_modulus", "poisson_ratio", "cohesion", "friction_angle"}) {
    auto p = mohr_coulomb();
    p.erase(key);
    CHECK_THAT(message_of([&] { from_parameters("mohr_coulomb", p); }), Contains(key));
  }
}

TEST_CASE("Parameters that contradict each other are refused", "[constitutive]") {
  MohrCoulomb::Params p = sample_params<MohrCoulomb>();
  REQUIRE_NOTHROW(check(p));
  SECTION("hardening") {
    p.residual_friction_angle = 31.0 * kDegree;
    CHECK_THAT(message_of([&] { check(p); }), Contains("31.0 deg exceeds the peak 30.0 deg"));
  }
  SECTION("hardening of cohesion") {
    p.cohesion = 2e3;
    p.residual_cohesion = 2e3;
    CHECK_NOTHROW(check(p));  // control
    p.residual_cohesion = 1e6;
    CHECK_THAT(message_of([&] { check(p); }), Contains("1000 kPa exceeds the peak 2 kPa"));
  }
  SECTION("dilation") {
    p.dilation_angle = 40.0 * kDegree;
    CHECK_THAT(message_of([&] { check(p); }), Contains("dilation angle 40.0 deg"));
  }
  SECTION("no strength") {
    p.cohesion = p.friction_angle = p.dilation_angle = 0.0;
    CHECK_THAT(message_of([&] { check(p); }), Contains("no strength"));
  }
  SECTION("unset numbers do not slip through") {
    p.friction_angle = kUnset;
    CHECK_THROWS_AS(check(p), InputError);
  }
}

TEST_CASE("A material has exactly one law", "[constitutive]") {
  MaterialSettings s;
  CHECK_THAT(message_of([&] { make_material(s, "tailings"); }),
             Contains("'tailings'") && Contains("0 constitutive laws"));
  s.of<LinearElastic>() = sample_params<LinearElastic>();
  CHECK(std::holds_alternative<Material<LinearElastic>>(make_material(s, "tailings")));
  s.of<ResidualStrength>() = sample_params<ResidualStrength>();
  CHECK_THAT(message_of([&] { make_material(s, "tailings"); }), Contains("2 constitutive laws"));
  s.of<LinearElastic>().reset();
  CHECK(std::holds_alternative<Material<ResidualStrength>>(make_material(s, "tailings")));
  s.of<ResidualStrength>().reset();
  s.of<MohrCoulomb>() = sample_params<MohrCoulomb>();
  CHECK(std::holds_alternative<Material<MohrCoulomb>>(make_material(s, "tailings")));
  s.of<MohrCoulomb>()->dilation_angle = 1.0;
  CHECK_THAT(message_of([&] { make_material(s, "tailings"); }), Contains("dilation"));
}

TEST_CASE("Elastic constants from Young's modulus", "[constitutive]") {
  // Uniaxial stress: sigma = E eps, lateral strain -nu eps.
  const double young = 10e6, nu = 0.25, strain = 1e-3;
  const Elasticity e = Elasticity::from_young(young, nu);
  const Stress<3> s =
      hooke(e, Stress<3>{}, StrainIncrement<3>{{strain, -nu * strain, -nu * strain, 2e-3, 0, 0}});
  CHECK(s[0] == Approx(young * strain));
  CHECK(s[1] == Approx(0.0).margin(1e-6));
  CHECK(s[2] == Approx(0.0).margin(1e-6));
  CHECK(s[3] == Approx(young / (2.0 * (1.0 + nu)) * 2e-3));  // engineering shear strain
}
