#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
#include "constitutive/softening.hpp"

#include <algorithm>
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

  /// (sqrt(J2) - s) / s or (p - tension cut-off) / s, whichever is larger.
  static double violation(double strength, double tension_cutoff, const Stress<2>& stress) {
    return std::max(std::sqrt(j2(stress)) - strength, mean_stress(stress) - tension_cutoff) /
           std::max(strength, 1.0);
  }

  /// The deviator is scaled by a <= 1 until sqrt(J2) <= strength, and the mean stress p follows:
  /// `vertical_stress` keeps the total sigma_yy, which carries the overburden (p = sigma_yy -
  /// a s_yy), `mean_stress` keeps p. Neither leaves p above the tension cut-off.
  static Stress<2> brought_back(LiquefiedReturn keeps, double strength, double tension_cutoff,
                                const Stress<2>& total) {
    if (keeps == LiquefiedReturn::none) return total;
    const double p = mean_stress(total);
    const double shear = std::sqrt(j2(total));
    double scale = shear > strength ? strength / shear : 1.0;
    double mean = std::min(p, tension_cutoff);
    if (keeps == LiquefiedReturn::vertical_stress) {
      const double s_yy = total[1] - p;
      mean = total[1] - scale * s_yy;
      if (mean > tension_cutoff) {
        // Less deviator keeps sigma_yy, unless sigma_yy itself is beyond the cut-off.
        scale = s_yy < 0.0 && total[1] < tension_cutoff ? (total[1] - tension_cutoff) / s_yy : 0.0;
        mean = std::min(total[1] - scale * s_yy, tension_cutoff);
      }
    }
    Stress<2> returned;
    for (int i = 0; i < 3; ++i) returned[i] = mean + scale * (total[i] - p);
    returned[3] = scale * total[3];
    return returned;
  }

  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn keeps) {
    const double strength = present_strength(c, s);
    const Stress<2> returned = brought_back(keeps, strength, c.tension_cutoff, total);
    return {returned, violation(strength, c.tension_cutoff, total),
            violation(strength, c.tension_cutoff, returned)};
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
