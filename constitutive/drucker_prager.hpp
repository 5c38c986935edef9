#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
#include "constitutive/shaking.hpp"
#include "constitutive/softening.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {

/// Drucker-Prager cone with a cap on mean tension, f = sqrt(J2) + alpha p - k <= 0 and p <= T,
/// fitted to Mohr-Coulomb in plane strain for the given dilation; softens over the accumulated
/// deviatoric plastic strain. Effective stress, as mohr_coulomb.hpp. docs/theory/drucker-prager.md
struct DruckerPrager {
  static constexpr std::string_view name = "drucker_prager";
  struct Params {
    double youngs_modulus = kUnset;           ///< E [Pa]
    double poisson_ratio = kUnset;            ///< nu [-]
    double cohesion = kUnset;                 ///< c [Pa]
    double friction_angle = kUnset;           ///< phi [rad]
    double dilation_angle = 0.0;              ///< psi [rad]
    std::optional<double> tension_cutoff;     ///< T [Pa], mean stress; unset: the apex k / alpha
    std::optional<double> residual_cohesion;  ///< [Pa]; unset: no softening of c
    std::optional<double> residual_friction_angle;  ///< [rad]; unset: no softening of phi
    double peak_strain = 0.0;                       ///< eps_q^p where softening starts [-]
    double residual_strain = 1.0;                   ///< eps_q^p where it ends [-]
  };
  template <class T>
  struct StateOf {
    T plastic_strain = 0.0;  ///< accumulated eps_q^p [-]
    T gap = 0.0;             ///< opened volumetric strain [-]
    T pore_pressure = 0.0;   ///< u [Pa] of the soil without a gap; effective = total + u
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 3> state_names{"plastic_strain", "gap",
                                                               "pore_pressure"};
  /// The cone that fits c and phi in plane strain with dilation beta.
  struct Cone {
    double alpha, k;
    static Cone fit(double cohesion, double phi, double beta) {
      const double flat = std::sqrt(1.0 - beta * beta / 3.0);
      const double alpha = sin(phi) / (flat + beta * sin(phi) / 3.0);
      return {alpha, cohesion * cos(phi) * (1.0 - alpha * beta / 3.0) / flat};
    }
  };
  struct Constants {
    Elasticity elastic;
    LinearSoftening softening;
    Cone peak, change;  ///< change from peak to residual
    double beta;        ///< volumetric over shear plastic strain
    double cohesion, cohesion_change;
    double tension_cutoff;  ///< [Pa]; infinite if only the apex bounds tension
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double softening_scale) {
    const double sin_psi = sin(p.dilation_angle);
    const double beta = sin_psi / std::sqrt(1.0 + sin_psi * sin_psi / 3.0);
    const double c_residual = p.residual_cohesion.value_or(p.cohesion);
    const Cone peak = Cone::fit(p.cohesion, p.friction_angle, beta);
    const Cone residual =
        Cone::fit(c_residual, p.residual_friction_angle.value_or(p.friction_angle), beta);
    return {elasticity(p),
            LinearSoftening::scaled(p.peak_strain, p.residual_strain, softening_scale),
            peak,
            {residual.alpha - peak.alpha, residual.k - peak.k},
            beta,
            p.cohesion,
            c_residual - p.cohesion,
            p.tension_cutoff.value_or(std::numeric_limits<double>::infinity())};
  }
  static State initial_state(const Params&) { return {}; }
  static ShearStrength shear_strength(const Params& p) {
    return {p.cohesion * cos(p.friction_angle), sin(p.friction_angle)};
  }
  template <class T>
  static T present_strength(const Constants& c, const StateOf<T>& s) noexcept {
    return c.cohesion + c.cohesion_change * c.softening.degree(s.plastic_strain);
  }

  /// The surface at the present state.
  template <class T>
  struct Surface {
    T alpha, k, tension;
  };
  template <class T>
  static Surface<T> surface(const Constants& c, const StateOf<T>& s) noexcept {
    const T degree = c.softening.degree(s.plastic_strain);
    const T alpha = c.peak.alpha + c.change.alpha * degree, k = c.peak.k + c.change.k * degree;
    const T apex = select(alpha > T(1e-6), k / max(alpha, T(1e-6)), k);
    return {alpha, k, min(T(c.tension_cutoff), apex)};
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>& old, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    // (i) elastic predictor in effective stress
    const T volumetric = de[0] + de[1] + de[2];
    const GapStep<T> step = close_gap_first(old.gap, volumetric);
    StrainIncrement<Dim, T> strain = de;
    for (int i = 0; i < 3; ++i) strain[i] -= (volumetric - step.volumetric) * (1.0 / 3.0);
    const Stress<Dim, T> trial = hooke(c.elastic, sigma, strain);
    const T total_mean = mean_stress(trial);
    const T p_trial =
        total_mean + present_pore_pressure(c.elastic.bulk, old.pore_pressure, old.gap);
    const T tau_trial = sqrt(j2(trial));

    // (ii) return to the cone with the strength at the start of the step
    const Surface<T> y = surface(c, old);
    const double g = c.elastic.shear, kb = c.elastic.bulk * c.beta;
    const T f = max(T(0.0), tau_trial + y.alpha * p_trial - y.k);
    const T multiplier = f / (g + y.alpha * kb);
    T tau = tau_trial - g * multiplier, p = p_trial - kb * multiplier;

    // (iii) beyond the cap: its plane, or the edge where it meets the cone
    const auto beyond = p > y.tension || tau < T(0.0);
    const T edge = max(T(0.0), y.k - y.alpha * y.tension);
    tau = select(beyond, min(tau_trial, edge), tau);
    p = select(beyond, min(p_trial, y.tension), p);
    const T sheared = (tau_trial - tau) * (1.0 / g);
    const T opened = select(
        beyond, max(T(0.0), (p_trial - p) * (1.0 / c.elastic.bulk) - c.beta * sheared), T(0.0));

    StressUpdate<StateOf<T>, Dim, T> r;
    r.state = old;
    r.state.plastic_strain = old.plastic_strain + sheared * (1.0 / std::sqrt(3.0));
    r.state.gap = step.gap + opened;
    const T u = present_pore_pressure(c.elastic.bulk, old.pore_pressure, r.state.gap);
    const T scale = select(tau < tau_trial, tau / max(tau_trial, T(1e-300)), T(1.0));
    for (int i = 0; i < 3; ++i) r.stress[i] = (trial[i] - total_mean) * scale + p - u;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = trial[i] * scale;
    return r;
  }

  /// f / strength of the cone or of the cap, whichever is larger; as for Mohr-Coulomb.
  static double violation(const Surface<double>& y, const Stress<2>& effective) {
    const double p = mean_stress(effective), unconfined = std::max(y.k, 1.0);
    const double confined = std::max(y.k - y.alpha * p, unconfined);
    return std::max((std::sqrt(j2(effective)) + y.alpha * p - y.k) / confined,
                    (p - y.tension) / unconfined);
  }

  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn) {
    const Surface<double> y = surface(c, s);
    return own_return<DruckerPrager>(
        c, s, total, [&y](const Stress<2>& effective) { return violation(y, effective); });
  }
};
static_assert(ConstitutiveModel<DruckerPrager, 2> && ConstitutiveModel<DruckerPrager, 3>);

/// Relations between parameters that ranges cannot express. Throws InputError.
void check(const DruckerPrager::Params& p);

template <>
struct Schema<DruckerPrager::Params> {
  static constexpr std::string_view doc =
      "Drucker-Prager, fitted to Mohr-Coulomb in plane strain, with a cap on tension and linear "
      "softening.";
  static void describe(FieldVisitor& v, DruckerPrager::Params& p) {
    v.quantity("youngs_modulus", p.youngs_modulus, Dim::stress, {.above = 0.0},
               "Young's modulus E");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu");
    v.quantity("cohesion", p.cohesion, Dim::stress, {.min = 0.0}, "peak cohesion c");
    v.quantity("friction_angle", p.friction_angle, Dim::angle, {.min = 0.0, .max = 1.0},
               "peak friction angle phi");
    v.quantity("dilation_angle", p.dilation_angle, Dim::angle, {.min = 0.0, .max = 1.0},
               "dilation angle psi");
    v.quantity("tension_cutoff", p.tension_cutoff, Dim::stress, {.min = 0.0},
               "largest mean tension; left out: the apex of the cone");
    v.quantity("residual_cohesion", p.residual_cohesion, Dim::stress, {.min = 0.0},
               "cohesion after softening; left out: no softening of c");
    v.quantity("residual_friction_angle", p.residual_friction_angle, Dim::angle,
               {.min = 0.0, .max = 1.0},
               "friction angle after softening; left out: no softening of phi");
    v.quantity("peak_strain", p.peak_strain, Dim::none, {.min = 0.0},
               "deviatoric plastic strain at which softening starts");
    v.quantity(
        "residual_strain", p.residual_strain, Dim::none, {.min = 0.0},
        "deviatoric plastic strain at which softening ends; not above peak_strain: no softening");
  }
};

}  // namespace flowslide
