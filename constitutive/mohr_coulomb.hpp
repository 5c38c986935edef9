#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
#include "constitutive/mohr_coulomb_return.hpp"
#include "constitutive/principal.hpp"
#include "constitutive/shaking.hpp"
#include "constitutive/softening.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {

/// Mohr-Coulomb with tension cut-off; cohesion and friction angle soften linearly over the
/// accumulated deviatoric plastic strain. Acts on effective stress: the pore pressure of a point is
/// part of its state and stays constant. docs/theory/mohr-coulomb.md
struct MohrCoulomb {
  static constexpr std::string_view name = "mohr_coulomb";
  static constexpr bool long_chain_3d = true;  ///< of principal axes and regions
  struct Params {
    double youngs_modulus = kUnset;        ///< E [Pa]
    double poisson_ratio = kUnset;         ///< nu [-]
    double cohesion = kUnset;              ///< c [Pa]
    double friction_angle = kUnset;        ///< phi [rad]
    double dilation_angle = 0.0;           ///< psi [rad]
    std::optional<double> tension_cutoff;  ///< [Pa]; unset: the apex c / tan phi, or c if phi = 0
    std::optional<double> residual_cohesion;        ///< [Pa]; unset: no softening of c
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
  struct Constants {
    Elasticity elastic;
    LinearSoftening softening;
    double cohesion, cohesion_change;
    double friction, friction_change;  ///< phi [rad]
    double m;                          ///< (1 + sin psi) / (1 - sin psi)
    double tension_cutoff;             ///< [Pa]; infinite if only the apex bounds tension
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double softening_scale) {
    const double sin_psi = sin(p.dilation_angle);
    return {elasticity(p),
            LinearSoftening::scaled(p.peak_strain, p.residual_strain, softening_scale),
            p.cohesion,
            p.residual_cohesion.value_or(p.cohesion) - p.cohesion,
            p.friction_angle,
            p.residual_friction_angle.value_or(p.friction_angle) - p.friction_angle,
            (1.0 + sin_psi) / (1.0 - sin_psi),
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
  static MohrCoulombSurface<T> surface(const Constants& c, const StateOf<T>& s) noexcept {
    const T degree = c.softening.degree(s.plastic_strain);
    const T phi = c.friction + c.friction_change * degree;
    const T cohesion = c.cohesion + c.cohesion_change * degree;
    const T sin_phi = sine(phi);
    const T across = cohesion * sqrt(1.0 - sin_phi * sin_phi);  // c cos phi
    // One division for two: by sin phi and by 1 - sin phi.
    const T one_minus = 1.0 - sin_phi, slope = max(T(1e-6), sin_phi);
    const T inverse = reciprocal(one_minus * slope), over_minus = inverse * slope;
    const T apex = select(sin_phi > T(1e-6), across * (inverse * one_minus), cohesion);
    return {(1.0 + sin_phi) * over_minus, c.m, 2.0 * across * over_minus,
            min(T(c.tension_cutoff), apex)};
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
    Stress<Dim, T> trial = hooke(c.elastic, sigma, strain);
    const T u_old = present_pore_pressure(c.elastic.bulk, old.pore_pressure, old.gap);
    for (int i = 0; i < 3; ++i) trial[i] += u_old;

    // (ii), (iii) return in principal axes with the strength at the start of the step
    const MohrCoulombSurface<T> y = surface(c, old);
    T deviatoric = 0.0, opened = 0.0;
    Stress<Dim, T> returned = trial;
    // Principal axes in 3D cost more than all the rest. What a lane gives may not hang on its
    // company.
    const auto elastic = surely_elastic(y, trial);
    if (Dim == 2 || !all(elastic)) {
      returned = map_principal(trial, [&](const Sorted3<T>& t) noexcept {
        const Principal<T> r =
            return_to_mohr_coulomb(c.elastic, y, Principal<T>{t.hi, t.mid, t.lo});
        const T d1 = t.hi - r.s1, d2 = t.mid - r.s2, d3 = t.lo - r.s3;
        const T mean = (d1 + d2 + d3) * (1.0 / 3.0);
        const T e1 = d1 - mean, e2 = d2 - mean, e3 = d3 - mean;
        deviatoric = sqrt(2.0 / 3.0 * (e1 * e1 + e2 * e2 + e3 * e3)) * (0.5 / c.elastic.shear);
        // Only what opens in tension closes again; dilation of shear does not.
        const auto in_tension = r.s1 >= y.tension - 1e-9 * (y.tension + y.sigma_c);
        opened = select(in_tension, max(T(0.0), mean) * (1.0 / c.elastic.bulk), T(0.0));
        return Sorted3<T>{r.s1, r.s2, r.s3};
      });
      if constexpr (Dim == 3) {
        for (int i = 0; i < kVoigt<Dim>; ++i) returned[i] = select(elastic, trial[i], returned[i]);
        deviatoric = select(elastic, T(0.0), deviatoric);
        opened = select(elastic, T(0.0), opened);
      }
    }
    StressUpdate<StateOf<T>, Dim, T> r;
    r.state = old;
    r.state.plastic_strain = old.plastic_strain + deviatoric;
    r.state.gap = step.gap + opened;
    const T u_new = present_pore_pressure(c.elastic.bulk, old.pore_pressure, r.state.gap);
    for (int i = 0; i < 3; ++i) returned[i] -= u_new;
    r.stress = returned;
    return r;
  }

  /// f / strength of the shear part or of the tension limit, whichever is larger, of the stress
  /// that friction acts on. The strength is that at the present confinement, at least that without
  /// confinement and 1 Pa.
  static double violation(const MohrCoulombSurface<double>& surface, const Stress<2>& stress) {
    const double centre = 0.5 * (stress[0] + stress[1]);
    const double radius = hypot(0.5 * (stress[0] - stress[1]), stress[3]);
    const Sorted3<double> s = sort3(centre + radius, centre - radius, stress[2]);
    const double unconfined = std::max(surface.sigma_c, 1.0);
    const double confined = std::max(surface.sigma_c - surface.k * s.hi, unconfined);
    return std::max((surface.k * s.hi - s.lo - surface.sigma_c) / confined,
                    (s.hi - surface.tension) / unconfined);
  }

  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn) {
    const MohrCoulombSurface<double> y = surface(c, s);
    return own_return<MohrCoulomb>(
        c, s, total, [&y](const Stress<2>& effective) { return violation(y, effective); });
  }

 private:
  /// True only inside the surface; from invariants alone, s1 <= p + 2 tau/sqrt(3) and
  /// s1 - s3 <= 2 tau with tau = sqrt(J2).
  template <int Dim, class T>
  static auto surely_elastic(const MohrCoulombSurface<T>& y, const Stress<Dim, T>& s) noexcept {
    const T tau = sqrt(j2(s)), highest = mean_stress(s) + 1.1547005383792517 * tau;
    return (y.k - 1.0) * highest + 2.0 * tau <= y.sigma_c && highest <= y.tension;
  }
  /// sin on [0, 1] to 1e-15 by its Taylor series: the library's does not run on eight lanes.
  template <class T>
  static T sine(T x) noexcept {
    const T y = x * x;
    return x * (1.0 + y * (-1.0 / 6 +
                           y * (1.0 / 120 + y * (-1.0 / 5040 +
                                                 y * (1.0 / 362880 +
                                                      y * (-1.0 / 39916800 +
                                                           y * (1.0 / 6227020800.0 +
                                                                y * (-1.0 / 1307674368000.0))))))));
  }
};
static_assert(ConstitutiveModel<MohrCoulomb, 2> && ConstitutiveModel<MohrCoulomb, 3>);

/// Relations between parameters that ranges cannot express. Throws InputError.
void check(const MohrCoulomb::Params& p);

template <>
struct Schema<MohrCoulomb::Params> {
  static constexpr std::string_view doc =
      "Mohr-Coulomb with tension cut-off and linear softening of cohesion and friction angle.";
  static void describe(FieldVisitor& v, MohrCoulomb::Params& p) {
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
               "largest tensile stress; left out: the apex c/tan(phi), or c if phi = 0");
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
