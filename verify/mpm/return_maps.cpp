#include "constitutive/materials.hpp"
#include "verify/mpm/list.hpp"

#include <bit>
#include <cmath>
#include <random>

/// A million random stresses and strains through every law: nothing that is not finite, nothing
/// beyond the yield surface, plane strain and three dimensions the same.
namespace flowslide::mpm {
namespace {

constexpr double kStress = 30e3, kStrain = 2e-3, kStep = 1e-4;

LinearElastic::Params sample(LinearElastic::Params) { return {20e6, 0.3}; }
NeoHookean::Params sample(NeoHookean::Params) { return {20e6, 0.3}; }
MohrCoulomb::Params sample(MohrCoulomb::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.cohesion = 5e3;
  p.friction_angle = 0.55;
  p.dilation_angle = 0.15;
  p.tension_cutoff = 2e3;
  return p;
}
DruckerPrager::Params sample(DruckerPrager::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.cohesion = 5e3;
  p.friction_angle = 0.55;
  p.dilation_angle = 0.15;
  return p;
}
ResidualStrength::Params sample(ResidualStrength::Params p) {
  p.youngs_modulus = 5e6;
  p.poisson_ratio = 0.49;
  p.strength = 8e3;
  p.soft_strength = 4e3;
  return p;
}
ModifiedCamClay::Params sample(ModifiedCamClay::Params p) {
  p.critical_ratio = 1.1;
  p.compression_index = 0.1;
  p.swelling_index = 0.02;
  p.poisson_ratio = 0.25;
  p.preconsolidation = 150e3;
  return p;
}
NorSand::Params sample(NorSand::Params p) {
  p.critical_ratio = 1.25;
  p.csl_void_ratio = 0.9;
  p.csl_slope = 0.03;
  p.hardening = 150.0;
  p.shear_modulus = 50e6;
  p.void_ratio = 0.75;
  p.image_pressure = 60e3;
  return p;
}
MuI::Params sample(MuI::Params) { return {20e6, 0.3, 0.38, 0.64, 0.28, 5e-3, 2500.0}; }
NewtonianFluid::Params sample(NewtonianFluid::Params p) {
  p.bulk_modulus = 20e6;
  p.viscosity = 50.0;
  return p;
}
Bingham::Params sample(Bingham::Params p) {
  p.bulk_modulus = 20e6;
  p.viscosity = 50.0;
  p.yield_stress = 200.0;
  return p;
}
HerschelBulkley::Params sample(HerschelBulkley::Params p) {
  p.bulk_modulus = 20e6;
  p.consistency = 80.0;
  p.flow_index = 0.5;
  p.yield_stress = 200.0;
  return p;
}

/// Yield function over the stress scale, <= 0 inside; 0 for laws without one.
template <class M>
double violation(const typename M::Constants& c, const typename M::State& state,
                 const Stress<3>& s) {
  const double tau = std::sqrt(j2(s)), mean = mean_stress(s);
  if constexpr (std::is_same_v<M, MohrCoulomb>) {
    const Eigen3 e = eigen_symmetric(s);
    const auto sorted = sort3(e.value[0], e.value[1], e.value[2]);
    return yield_violation(MohrCoulomb::surface(c, state),
                           Principal<double>{sorted.hi, sorted.mid, sorted.lo}) /
           kStress;
  } else if constexpr (std::is_same_v<M, DruckerPrager>) {
    const auto y = DruckerPrager::surface(c, state);
    return std::max(tau + y.alpha * mean - y.k, mean - y.tension) / kStress;
  } else if constexpr (std::is_same_v<M, ResidualStrength>) {
    return std::max(tau - M::present_strength(c, state), mean - c.tension_cutoff) / kStress;
  } else if constexpr (std::is_same_v<M, MuI>) {
    const double r = M::lode_factor(c, tau, j3(s));
    return std::max(tau + c.mu_limit * r * mean, mean) / kStress;
  } else if constexpr (requires { M::rate_dependent; }) {
    return (mean - c.tension_cutoff) / kStress;
  } else {
    return 0.0;
  }
}

struct Tally {
  double bad = 0.0, violation = 0.0, difference = 0.0;
};

template <class M>
Tally throw_at(int count) {
  const auto params = sample(typename M::Params{});
  const auto c = M::constants(params, 1.0);
  const typename M::State state = M::initial_state(params);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  Tally tally;
  for (int i = 0; i < count; ++i) {
    // One in eight at an edge, one in eight at the apex or beyond, some far out.
    const double size = kStress * (i % 16 == 5 ? 100.0 : 1.0);
    Stress<2> sigma;
    StrainIncrement<2> de;
    for (int k = 0; k < 4; ++k) {
      sigma[k] = size * normal(random);
      de[k] = kStrain * normal(random);
    }
    if (i % 8 == 1) sigma[2] = sigma[1], sigma[3] = 0.0, de = {};
    if (i % 8 == 2) sigma[0] = sigma[1] = sigma[2] = std::abs(sigma[0]), sigma[3] = 0.0, de = {};
    const auto flat = update_law<M, 2, double>(c, state, sigma, de, kStep);
    const auto solid =
        update_law<M, 3, double>(c, state, Stress<3>{{sigma[0], sigma[1], sigma[2], sigma[3]}},
                                 StrainIncrement<3>{{de[0], de[1], de[2], de[3]}}, kStep);
    const Stress<3> s{{flat.stress[0], flat.stress[1], flat.stress[2], flat.stress[3]}};
    double difference = 0.0, sum = 0.0;
    for (int k = 0; k < 6; ++k) {
      sum += std::abs(s[k]) + std::abs(solid.stress[k]);
      difference = std::max(difference, std::abs(s[k] - solid.stress[k]));
    }
    if (!std::isfinite(sum)) tally.bad += 1.0;
    // The strength is that of the start of the step.
    tally.violation = std::max(tally.violation, violation<M>(c, state, s) * kStress / size);
    tally.difference = std::max(tally.difference, difference / (size + c.elastic.bulk * kStrain));
  }
  return tally;
}

}  // namespace

std::vector<Check> verify_return_maps(std::string_view name) {
  CheckList checks(name);
  FlowLaws::each([&]<class M>() {
    // Laws that integrate in many parts get fewer states.
    const Tally t = throw_at<M>(std::is_same_v<M, NorSand> ? 100000 : 1000000);
    checks.error(fmt::format("{}_not_finite", M::name), t.bad, 0.0);
    checks.at_most(fmt::format("{}_violation", M::name), t.violation, 1e-10);
    checks.error(fmt::format("{}_2d_against_3d", M::name), t.difference, 1e-10);
  });
  return checks.take();
}

}  // namespace flowslide::mpm
