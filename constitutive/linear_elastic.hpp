#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/shaking.hpp"

namespace flowslide {

/// Isotropic linear elasticity on increments.
struct LinearElastic {
  static constexpr std::string_view name = "linear_elastic";
  struct Params {
    double youngs_modulus = kUnset;  ///< E [Pa]
    double poisson_ratio = kUnset;   ///< nu [-]
  };
  template <class T>
  struct StateOf {};
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 0> state_names{};
  struct Constants {
    Elasticity elastic;
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p)};
  }
  static State initial_state(const Params&) { return {}; }
  static ShearStrength shear_strength(const Params&) { return {}; }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>&, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    return {hooke(c.elastic, sigma, de), {}};
  }
  static double present_strength(const Constants&, const State&) noexcept { return kUnset; }
  static AdmissibleStress admissible(const Constants&, const State&, const Stress<2>& total,
                                     LiquefiedReturn) {
    return any_stress(total);
  }
};
static_assert(ConstitutiveModel<LinearElastic, 2> && ConstitutiveModel<LinearElastic, 3>);

template <>
struct Schema<LinearElastic::Params> {
  static constexpr std::string_view doc = "Isotropic linear elasticity.";
  static void describe(FieldVisitor& v, LinearElastic::Params& p) {
    v.quantity("youngs_modulus", p.youngs_modulus, Dim::stress, {.above = 0.0},
               "Young's modulus E");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu");
  }
};

}  // namespace flowslide
