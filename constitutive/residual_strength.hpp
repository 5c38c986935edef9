#pragma once
#include "config/schema.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/softening.hpp"

#include <cmath>

namespace flowslide {

/// Liquefied soil: undrained, phi = 0, strength S_r that softens linearly to c_soft over the
/// accumulated deviatoric plastic strain. Von Mises calibrated in simple shear, q <= sqrt(3) s,
/// which in plane strain without volume change is Tresca's s. Total stress.
/// docs/theory/residual-strength.md
struct ResidualStrength {
  static constexpr std::string_view name = "residual_strength";
  struct Params {
    double youngs_modulus = kUnset;       ///< E [Pa]
    double poisson_ratio = kUnset;        ///< nu [-], near 0.5 for undrained soil
    std::optional<double> strength;       ///< S_r [Pa]; may be left to the points
    std::optional<double> soft_strength;  ///< c_soft [Pa]; likewise
    double residual_strain = 1.0;         ///< eps_q^p at which c_soft is reached [-]
    double tension_cutoff = 0.0;          ///< largest mean tension [Pa]
  };
  struct State {
    double plastic_strain = 0.0;  ///< accumulated eps_q^p [-]
    double gap = 0.0;             ///< opened volumetric strain [-]
    double strength = 0.0;        ///< S_r of this point [Pa]
    double soft_strength = 0.0;   ///< c_soft of this point [Pa]
  };
  static constexpr std::array<std::string_view, 4> state_names{"plastic_strain", "gap", "strength",
                                                               "soft_strength"};
  struct Constants {
    Elasticity elastic;
    LinearSoftening softening;
    double tension_cutoff;
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double softening_scale) {
    return {elasticity(p), LinearSoftening::scaled(0.0, p.residual_strain, softening_scale),
            p.tension_cutoff};
  }
  static State initial_state(const Params& p) {
    return {0.0, 0.0, p.strength.value_or(kUnset), p.soft_strength.value_or(kUnset)};
  }

  static double present_strength(const Constants& c, const State& s) noexcept {
    return s.strength + (s.soft_strength - s.strength) * c.softening.degree(s.plastic_strain);
  }

  template <int Dim>
  [[nodiscard]] static StressUpdate<State, Dim> update(const Constants& c, const State& old,
                                                       const Stress<Dim>& sigma,
                                                       const StrainIncrement<Dim>& de) noexcept {
    // (i) elastic predictor; deviator and mean stress are independent of each other.
    const GapStep step = close_gap_first(old.gap, de[0] + de[1] + de[2]);
    const double third = (de[0] + de[1] + de[2]) / 3.0;
    const double p_old = mean_stress(sigma);
    const double p_trial = p_old + c.elastic.bulk * step.volumetric;
    std::array<double, kVoigt<Dim>> s{};
    for (int i = 0; i < 3; ++i) s[i] = sigma[i] - p_old + 2.0 * c.elastic.shear * (de[i] - third);
    for (int i = 3; i < kVoigt<Dim>; ++i) s[i] = sigma[i] + c.elastic.shear * de[i];

    // (ii) radial return to q = sqrt(3) s_u with the strength at the start of the step; without
    // bounded mean tension separated soil would hang together, so it carries no shear either.
    double j2_trial = 0.0;
    for (int i = 0; i < 3; ++i) j2_trial += 0.5 * s[i] * s[i];
    for (int i = 3; i < kVoigt<Dim>; ++i) j2_trial += s[i] * s[i];
    const double tau = std::sqrt(j2_trial);
    const double limit = present_strength(c, old);
    const double scale = tau > limit ? limit / tau : 1.0;
    const double d_plastic = tau > limit ? (tau - limit) / (std::sqrt(3.0) * c.elastic.shear) : 0.0;

    // (iii) tension cut-off on the mean stress; what opens is remembered.
    const double excess = std::max(0.0, p_trial - c.tension_cutoff);
    const double p = p_trial - excess;

    StressUpdate<State, Dim> r;
    for (int i = 0; i < 3; ++i) r.stress[i] = s[i] * scale + p;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = s[i] * scale;
    r.state = old;
    r.state.plastic_strain = old.plastic_strain + d_plastic;
    r.state.gap = step.gap + excess / c.elastic.bulk;
    r.outcome = tau > limit || excess > 0.0 ? Outcome::plastic : Outcome::elastic;
    return r;
  }
};
static_assert(ConstitutiveModel<ResidualStrength, 2> && ConstitutiveModel<ResidualStrength, 3>);

template <>
struct Schema<ResidualStrength::Params> {
  static constexpr std::string_view doc =
      "Liquefied soil with residual strength (phi = 0), softening with plastic strain.";
  static void describe(FieldVisitor& v, ResidualStrength::Params& p) {
    v.quantity("youngs_modulus", p.youngs_modulus, Dim::stress, {.above = 0.0},
               "Young's modulus E");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio; undrained soil is nearly incompressible");
    v.quantity("strength", p.strength, Dim::stress, {.above = 0.0},
               "residual undrained strength S_r; may be left out where every point brings its own");
    v.quantity("soft_strength", p.soft_strength, Dim::stress, {.above = 0.0},
               "strength c_soft after large strain; may be left out likewise");
    v.quantity("residual_strain", p.residual_strain, Dim::none, {.min = 0.0},
               "deviatoric plastic strain at which c_soft is reached; 0 switches softening off");
    v.quantity("tension_cutoff", p.tension_cutoff, Dim::stress, {.min = 0.0},
               "largest mean tension");
  }
};

}  // namespace flowslide
