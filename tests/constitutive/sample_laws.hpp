#pragma once
#include "constitutive/materials.hpp"

#include <random>

#include <Eigen/Dense>

/// Parameters of every law and random stresses for the tests of this folder.
namespace flowslide {

inline constexpr double kDegree = 0.017453292519943295;

inline LinearElastic::Params sample(LinearElastic::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  return p;
}
inline MohrCoulomb::Params sample(MohrCoulomb::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.cohesion = 5e3;
  p.friction_angle = 30.0 * kDegree;
  p.dilation_angle = 10.0 * kDegree;
  return p;
}
inline ResidualStrength::Params sample(ResidualStrength::Params p) {
  p.youngs_modulus = 5e6;
  p.poisson_ratio = 0.49;
  p.strength = 8e3;
  p.soft_strength = 4e3;
  return p;
}
inline NeoHookean::Params sample(NeoHookean::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  return p;
}
inline DruckerPrager::Params sample(DruckerPrager::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.cohesion = 5e3;
  p.friction_angle = 30.0 * kDegree;
  p.dilation_angle = 10.0 * kDegree;
  return p;
}
inline MuI::Params sample(MuI::Params p) {
  p.youngs_modulus = 20e6;
  p.poisson_ratio = 0.3;
  p.mu_static = 0.38;
  p.mu_limit = 0.64;
  p.inertial_number = 0.28;
  p.grain_size = 5e-3;
  p.grain_density = 2500.0;
  return p;
}
inline NewtonianFluid::Params sample(NewtonianFluid::Params p) {
  p.bulk_modulus = 20e6;
  p.viscosity = 50.0;
  return p;
}
inline Bingham::Params sample(Bingham::Params p) {
  p.bulk_modulus = 20e6;
  p.viscosity = 50.0;
  p.yield_stress = 200.0;
  return p;
}
inline HerschelBulkley::Params sample(HerschelBulkley::Params p) {
  p.bulk_modulus = 20e6;
  p.consistency = 80.0;
  p.flow_index = 0.5;
  p.yield_stress = 200.0;
  return p;
}
inline PM4Sand::Params sample(PM4Sand::Params p) {
  p.Dr = 0.35;
  p.G0 = 476.0;
  p.hpo = 0.53;
  return p;
}
inline ModifiedCamClay::Params sample(ModifiedCamClay::Params p) {
  p.critical_ratio = 1.1;
  p.compression_index = 0.1;
  p.swelling_index = 0.02;
  p.poisson_ratio = 0.25;
  p.preconsolidation = 72e3;
  return p;
}
inline NorSand::Params sample(NorSand::Params p) {
  p.critical_ratio = 1.25;
  p.csl_void_ratio = 0.9;
  p.csl_slope = 0.03;
  p.dilatancy = 3.5;
  p.hardening = 150.0;
  p.shear_modulus = 50e6;
  p.void_ratio = 0.75;
  p.image_pressure = 200e3;
  return p;
}
template <class M>
typename M::Params sample_params() {
  return sample(typename M::Params{});
}

/// The update of one point with the types spelled out, so that braces may stand for zeros.
template <class M, int Dim>
StressUpdate<typename M::State, Dim> update(const typename M::Constants& c,
                                            const typename M::State& state,
                                            const Stress<Dim>& sigma,
                                            const StrainIncrement<Dim>& de, double dt = 1e-4) {
  return update_law<M, Dim, double>(c, state, sigma, de, dt);
}

/// Whether an update left the elastic range.
template <class State>
bool yielded(const State& before, const State& after) {
  bool plastic = false;
  if constexpr (requires { before.plastic_strain; })
    plastic = plastic || after.plastic_strain > before.plastic_strain;
  if constexpr (requires { before.gap; }) plastic = plastic || after.gap > before.gap;
  return plastic;
}

/// Laws of critical states live under pressure only; their stiffness follows it.
template <class M>
inline constexpr bool kNeedsPressure =
    std::is_same_v<M, ModifiedCamClay> || std::is_same_v<M, NorSand>;

template <class M_, int Dim_>
struct LawIn {
  using M = M_;
  static constexpr int dim = Dim_;
};

/// Type lists for tests, made from the list of laws: a law that is added is tested.
template <class M>
struct FollowsStrain {
  static constexpr bool value = !requires { M::rate_dependent; };
};
template <class M>
struct HasPacks {
  static constexpr bool value = !kNeedsPressure<M> && !std::is_same_v<M, HerschelBulkley>;
};
template <class>
struct InBoth;
template <class... M>
struct InBoth<LawList<M...>> {
  using type = std::tuple<LawIn<M, 2>..., LawIn<M, 3>...>;
};
template <class>
struct Plain;
template <class... M>
struct Plain<LawList<M...>> {
  using type = std::tuple<M...>;
};
using EveryLaw = Plain<FlowLaws>::type;
using EveryLawIn2And3 = InBoth<FlowLaws>::type;
using LawsOfStrainIn2And3 = InBoth<Filtered<FlowLaws, FollowsStrain>>::type;
using EveryShakingLaw = Plain<ShakingLaws>::type;
using LawsWithPacks = Plain<Filtered<FlowLaws, HasPacks>>::type;

/// Components that are not small: a normal distribution of the given scale.
template <class V>
V random_voigt(std::mt19937_64& random, double scale) {
  std::normal_distribution<double> normal(0.0, scale);
  V r;
  for (double& x : r.v) x = normal(random);
  return r;
}

inline Eigen::Matrix3d tensor(const Stress<2>& s) {
  return Eigen::Matrix3d{{s[0], s[3], 0.0}, {s[3], s[1], 0.0}, {0.0, 0.0, s[2]}};
}
inline Eigen::Matrix3d tensor(const Stress<3>& s) {
  return Eigen::Matrix3d{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
}
template <int Dim>
Eigen::Matrix3d tensor(const StrainIncrement<Dim>& e) {
  Stress<Dim> s;
  for (int i = 0; i < kVoigt<Dim>; ++i) s[i] = i < 3 ? e[i] : 0.5 * e[i];
  return tensor(s);
}
/// Voigt from a tensor; `shear` is 1 for stress and 2 for strain.
template <class V>
V voigt(const Eigen::Matrix3d& t, double shear) {
  V r;
  for (int i = 0; i < 3; ++i) r[i] = t(i, i);
  r[3] = shear * t(0, 1);
  if constexpr (std::tuple_size_v<decltype(r.v)> == 6) {
    r[4] = shear * t(1, 2);
    r[5] = shear * t(0, 2);
  }
  return r;
}

/// Largest first.
template <int Dim>
std::array<double, 3> principal(const Stress<Dim>& s) {
  const Eigen::Vector3d v =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor(s), Eigen::EigenvaluesOnly)
          .eigenvalues();
  return {v[2], v[1], v[0]};
}

template <int Dim>
double distance(const Stress<Dim>& a, const Stress<Dim>& b) {
  return (tensor(a) - tensor(b)).norm();
}

}  // namespace flowslide
