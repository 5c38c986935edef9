#pragma once
#include "config/schema.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
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
  template <class T>
  struct StateOf {
    T plastic_strain = 0.0;  ///< accumulated eps_q^p [-]
    T gap = 0.0;             ///< opened volumetric strain [-]
    T strength = 0.0;        ///< S_r of this point [Pa]
    T soft_strength = 0.0;   ///< c_soft of this point [Pa]
  };
  using State = StateOf<double>;
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

  template <class T>
  static T present_strength(const Constants& c, const StateOf<T>& s) noexcept {
    return s.strength + (s.soft_strength - s.strength) * c.softening.degree(s.plastic_strain);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>& old, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    // (i) elastic predictor; deviator and mean stress are independent of each other.
    const T volumetric = de[0] + de[1] + de[2];
    const GapStep<T> step = close_gap_first(old.gap, volumetric);
    const T third = volumetric * (1.0 / 3.0);
    const T p_old = mean_stress(sigma);
    const T p_trial = p_old + c.elastic.bulk * step.volumetric;
    const double two_g = 2.0 * c.elastic.shear;
    std::array<T, kVoigt<Dim>> s{};
    T j2_trial = 0.0;
    for (int i = 0; i < 3; ++i) {
      s[i] = sigma[i] - p_old + two_g * (de[i] - third);
      j2_trial += 0.5 * s[i] * s[i];
    }
    for (int i = 3; i < kVoigt<Dim>; ++i) {
      s[i] = sigma[i] + c.elastic.shear * de[i];
      j2_trial += s[i] * s[i];
    }

    // (ii) radial return to q = sqrt(3) s_u with the strength at the start of the step.
    const T limit = present_strength(c, old), square = limit * limit;
    const auto yields = j2_trial > square;
    const T over_tau = inverse_sqrt(max(max(j2_trial, square), T(1e-280)));
    const T over = select(yields, j2_trial * over_tau - limit, T(0.0));
    const T scale = select(yields, limit * over_tau, T(1.0));

    // (iii) tension cut-off on the mean stress; what opens is remembered.
    const T excess = max(T(0.0), p_trial - c.tension_cutoff);
    const T p = p_trial - excess;

    StressUpdate<StateOf<T>, Dim, T> r;
    for (int i = 0; i < 3; ++i) r.stress[i] = s[i] * scale + p;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = s[i] * scale;
    r.state = old;
    r.state.plastic_strain = old.plastic_strain + over * (1.0 / (std::sqrt(3.0) * c.elastic.shear));
    r.state.gap = step.gap + excess * (1.0 / c.elastic.bulk);
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
