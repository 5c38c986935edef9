#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {

/// Dense granular flow: tau = mu(I) r p with mu = mu_s + (mu_2 - mu_s) / (I_0/I + 1), the inertial
/// number I = gamma' d sqrt(rho_s / p) and the Lode factor r, 1 in plane flow; no volume change in
/// shear, no tension. Effective stress, as mohr_coulomb.hpp. docs/theory/mu-i.md
struct MuI {
  static constexpr std::string_view name = "mu_i";
  static constexpr bool rate_dependent = true;
  struct Params {
    double youngs_modulus = kUnset;   ///< E [Pa]
    double poisson_ratio = kUnset;    ///< nu [-]
    double mu_static = kUnset;        ///< mu_s [-]
    double mu_limit = kUnset;         ///< mu_2 [-]
    double inertial_number = kUnset;  ///< I_0 [-]
    double grain_size = kUnset;       ///< d [m]
    double grain_density = kUnset;    ///< rho_s [kg/m3]
    double lode_dependence = 1.0;     ///< w [-]: 1 Matsuoka & Nakai, 0 a circle (Jop et al.)
  };
  template <class T>
  struct StateOf {
    T plastic_strain = 0.0;  ///< accumulated eps_q^p [-]
    T gap = 0.0;             ///< opened volumetric strain [-]
    T pore_pressure = 0.0;   ///< u [Pa] of the soil without a gap; effective = total + u
  };
  using State = StateOf<double>;
  static constexpr double kMostLode = 0.38490017945975052;  ///< 2/(3 sqrt(3)), if axisymmetric
  static constexpr int kLodeIterations = 6;                 ///< error below 1e-10 up to mu_s = 0.95
  static constexpr std::array<std::string_view, 3> state_names{"plastic_strain", "gap",
                                                               "pore_pressure"};
  struct Constants {
    Elasticity elastic;
    double mu_static, mu_limit;
    double lode_cubic;   ///< (3 - mu_s^2) mu_s / 2, 0 for a circle
    double lode_weight;  ///< w
    double rate;         ///< I_0 / (d sqrt(rho_s)) [1/s / sqrt(Pa)]
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    const double cubic = 0.5 * (3.0 - p.mu_static * p.mu_static) * p.mu_static;
    return {elasticity(p),     p.mu_static,
            p.mu_limit,        p.lode_dependence > 0.0 ? cubic : 0.0,
            p.lode_dependence, p.inertial_number / (p.grain_size * std::sqrt(p.grain_density))};
  }
  static State initial_state(const Params&) { return {}; }
  static double present_strength(const Constants&, const State&) noexcept { return 0.0; }

  /// Lode factor r = 1 - w + w u: shear strength in the direction of a deviator over that of plane
  /// flow (J3 = 0), on the surface of Matsuoka & Nakai (1974) through mu_s: u = sqrt(J2)/(mu_s p)
  /// is the root of (3 - mu_s^2) mu_s x u^3 / 2 - u^2 + 1 = 0, x = -J3/J2^1.5 (compression
  /// positive), by Newton's iteration from 1.
  template <class T>
  static T lode_factor(const Constants& c, T tau, T j3) noexcept {
    const T x = min(T(kMostLode), max(T(-kMostLode), -j3 / max(tau * tau * tau, T(1e-300))));
    const T a = c.lode_cubic * x;
    T u = T(1.0);
    for (int i = 0; i < kLodeIterations; ++i)
      u = u - ((a * u - 1.0) * u * u + 1.0) / ((3.0 * a * u - 2.0) * u);
    return 1.0 + c.lode_weight * (u - 1.0);
  }

  /// Shear stress after a step in which the elastic predictor reached `tau_trial` under pressure p:
  /// the smaller root of (tau_trial - tau)(mu_2 q - tau) = a (tau - mu_s q), a = G dt rate sqrt(p),
  /// q = r p, written so that it does not cancel (Dunatunga & Kamrin 2015).
  template <class T>
  static T flow_stress(const Constants& c, T tau_trial, T p, T q, double dt) noexcept {
    const T a = c.elastic.shear * dt * c.rate * sqrt(p);
    const T b = c.mu_limit * q + tau_trial + a;
    const T h = c.mu_limit * q * tau_trial + a * (c.mu_static * q);
    const T root = b + sqrt(max(T(0.0), b * b - 4.0 * h));
    return select(tau_trial > c.mu_static * q, 2.0 * h / max(root, T(1e-300)), tau_trial);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(const Constants& c,
                                                               const StateOf<T>& old,
                                                               const Stress<Dim, T>& sigma,
                                                               const StrainIncrement<Dim, T>& de,
                                                               double dt) noexcept {
    const T volumetric = de[0] + de[1] + de[2];
    const GapStep<T> step = close_gap_first(old.gap, volumetric);
    StrainIncrement<Dim, T> strain = de;
    for (int i = 0; i < 3; ++i) strain[i] -= (volumetric - step.volumetric) * (1.0 / 3.0);
    const Stress<Dim, T> trial = hooke(c.elastic, sigma, strain);
    const T total_mean = mean_stress(trial);
    const T tension =
        total_mean + present_pore_pressure(c.elastic.bulk, old.pore_pressure, old.gap);
    const T excess = max(T(0.0), tension), p = max(T(0.0), -tension);
    const T tau_trial = sqrt(j2(trial));
    const T tau = flow_stress(c, tau_trial, p, p * lode_factor(c, tau_trial, j3(trial)), dt);

    StressUpdate<StateOf<T>, Dim, T> r;
    r.state = old;
    r.state.plastic_strain =
        old.plastic_strain + (tau_trial - tau) * (1.0 / (std::sqrt(3.0) * c.elastic.shear));
    r.state.gap = step.gap + excess * (1.0 / c.elastic.bulk);
    const T u = present_pore_pressure(c.elastic.bulk, old.pore_pressure, r.state.gap);
    const T scale = select(tau < tau_trial, tau / max(tau_trial, T(1e-300)), T(1.0));
    for (int i = 0; i < 3; ++i) r.stress[i] = (trial[i] - total_mean) * scale - p - u;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = trial[i] * scale;
    return r;
  }

  /// No tension, and the deviator scaled to mu_2 r p, which no rate exceeds: between mu_s and mu_2
  /// the stress says how fast it flows.
  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn) {
    const double p = std::max(0.0, -(mean_stress(total) + s.pore_pressure));
    const double tau = std::sqrt(j2(total)), r = lode_factor(c, tau, j3(total));
    return limited_shear(total, s.pore_pressure, tau, c.mu_limit * r * p, p);
  }
};
static_assert(ConstitutiveModel<MuI, 2> && ConstitutiveModel<MuI, 3>);

/// Relations between parameters that ranges cannot express. Throws InputError.
void check(const MuI::Params& p);

template <>
struct Schema<MuI::Params> {
  static constexpr std::string_view doc = "Dense granular flow with the mu(I) rheology.";
  static void describe(FieldVisitor& v, MuI::Params& p) {
    v.quantity("youngs_modulus", p.youngs_modulus, Dim::stress, {.above = 0.0},
               "Young's modulus E");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu");
    v.quantity("mu_static", p.mu_static, Dim::none, {.above = 0.0},
               "friction coefficient mu_s = sqrt(J2)/p at the onset of plane flow");
    v.quantity("mu_limit", p.mu_limit, Dim::none, {.above = 0.0},
               "friction coefficient mu_2 of fast flow");
    v.quantity("inertial_number", p.inertial_number, Dim::none, {.above = 0.0},
               "inertial number I_0 half way between the two");
    v.quantity("grain_size", p.grain_size, Dim::length, {.above = 0.0}, "grain diameter d");
    v.quantity("grain_density", p.grain_density, Dim::density, {.above = 0.0},
               "density rho_s of the grains");
    v.quantity("lode_dependence", p.lode_dependence, Dim::none, {.min = 0.0, .max = 1.0},
               "strength beside plane flow: 1 by Matsuoka & Nakai, as sand has it; 0 the same in "
               "all directions of the deviator");
  }
};

}  // namespace flowslide
