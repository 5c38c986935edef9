#pragma once
#include "config/schema.hpp"
#include "constitutive/fluid.hpp"
#include "core/elementary.hpp"

#include <optional>

namespace flowslide {

/// Newtonian fluid, tau = eta gamma'. docs/theory/fluids.md
struct NewtonianFluid {
  static constexpr std::string_view name = "newtonian_fluid";
  static constexpr bool rate_dependent = true;
  struct Params {
    double bulk_modulus = kUnset;         ///< K [Pa]
    double viscosity = kUnset;            ///< eta [Pa s]
    double eos_exponent = 1.0;            ///< n [-]
    double tension_cutoff = 0.0;          ///< [Pa]
    std::optional<double> shear_modulus;  ///< G [Pa]; unset: 0.2 K
  };
  template <class T>
  using StateOf = FluidState<T>;
  using State = StateOf<double>;
  static constexpr auto state_names = kFluidStates;
  struct Constants {
    Elasticity elastic;
    EquationOfState eos;
    double viscosity, tension_cutoff;
  };

  static Elasticity elasticity(const Params& p) {
    return {p.bulk_modulus, p.shear_modulus.value_or(kFluidShearRatio * p.bulk_modulus)};
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p), {p.bulk_modulus, p.eos_exponent}, p.viscosity, p.tension_cutoff};
  }
  static State initial_state(const Params&) { return {}; }
  static double present_strength(const Constants&, const State&) noexcept { return 0.0; }

  static AdmissibleStress admissible(const Constants& c, const State&, const Stress<2>& total,
                                     LiquefiedReturn) {
    return admissible_fluid(c.tension_cutoff, total);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(const Constants& c,
                                                               const StateOf<T>& old,
                                                               const Stress<Dim, T>& sigma,
                                                               const StrainIncrement<Dim, T>& de,
                                                               double dt) noexcept {
    const double keep = c.viscosity / (c.viscosity + c.elastic.shear * dt);
    return update_fluid<Dim>(c.eos, c.elastic.shear, c.tension_cutoff, old, sigma, de,
                             [&](T tau) { return tau * keep; });
  }
};
static_assert(ConstitutiveModel<NewtonianFluid, 2> && ConstitutiveModel<NewtonianFluid, 3>);

/// Bingham fluid, tau = tau_y + eta gamma'. docs/theory/fluids.md
struct Bingham {
  static constexpr std::string_view name = "bingham";
  static constexpr bool rate_dependent = true;
  struct Params {
    double bulk_modulus = kUnset;         ///< K [Pa]
    double viscosity = kUnset;            ///< eta [Pa s]
    double yield_stress = kUnset;         ///< tau_y [Pa]
    double eos_exponent = 1.0;            ///< n [-]
    double tension_cutoff = 0.0;          ///< [Pa]
    std::optional<double> shear_modulus;  ///< G [Pa]; unset: 0.2 K
  };
  template <class T>
  using StateOf = FluidState<T>;
  using State = StateOf<double>;
  static constexpr auto state_names = kFluidStates;
  struct Constants {
    Elasticity elastic;
    EquationOfState eos;
    double viscosity, yield_stress, tension_cutoff;
  };

  static Elasticity elasticity(const Params& p) {
    return {p.bulk_modulus, p.shear_modulus.value_or(kFluidShearRatio * p.bulk_modulus)};
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p),
            {p.bulk_modulus, p.eos_exponent},
            p.viscosity,
            p.yield_stress,
            p.tension_cutoff};
  }
  static State initial_state(const Params&) { return {}; }
  static double present_strength(const Constants& c, const State&) noexcept {
    return c.yield_stress;
  }

  static AdmissibleStress admissible(const Constants& c, const State&, const Stress<2>& total,
                                     LiquefiedReturn) {
    return admissible_fluid(c.tension_cutoff, total);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(const Constants& c,
                                                               const StateOf<T>& old,
                                                               const Stress<Dim, T>& sigma,
                                                               const StrainIncrement<Dim, T>& de,
                                                               double dt) noexcept {
    // tau = tau_trial - G dt gamma' and tau = tau_y + eta gamma', linear in gamma'.
    const double keep = c.viscosity / (c.viscosity + c.elastic.shear * dt);
    return update_fluid<Dim>(c.eos, c.elastic.shear, c.tension_cutoff, old, sigma, de,
                             [&](T tau) { return c.yield_stress + (tau - c.yield_stress) * keep; });
  }
};
static_assert(ConstitutiveModel<Bingham, 2> && ConstitutiveModel<Bingham, 3>);

/// Herschel-Bulkley fluid, tau = tau_y + k gamma'^n. docs/theory/fluids.md
struct HerschelBulkley {
  static constexpr std::string_view name = "herschel_bulkley";
  static constexpr bool rate_dependent = true;
  static constexpr bool per_point = true;  ///< the flow curve is solved by iteration
  struct Params {
    double bulk_modulus = kUnset;         ///< K [Pa]
    double consistency = kUnset;          ///< k [Pa s^n]
    double flow_index = kUnset;           ///< n [-]; below 1 the fluid thins with rate
    double yield_stress = kUnset;         ///< tau_y [Pa]
    double eos_exponent = 1.0;            ///< of the equation of state [-]
    double tension_cutoff = 0.0;          ///< [Pa]
    std::optional<double> shear_modulus;  ///< G [Pa]; unset: 0.2 K
  };
  template <class T>
  using StateOf = FluidState<T>;
  using State = StateOf<double>;
  static constexpr auto state_names = kFluidStates;
  struct Constants {
    Elasticity elastic;
    EquationOfState eos;
    double consistency, flow_index, yield_stress, tension_cutoff;
  };

  static Elasticity elasticity(const Params& p) {
    return {p.bulk_modulus, p.shear_modulus.value_or(kFluidShearRatio * p.bulk_modulus)};
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p),  {p.bulk_modulus, p.eos_exponent},
            p.consistency,  p.flow_index,
            p.yield_stress, p.tension_cutoff};
  }
  static State initial_state(const Params&) { return {}; }
  static double present_strength(const Constants& c, const State&) noexcept {
    return c.yield_stress;
  }

  /// The root of k y^n + G dt y = over, by Newton's method inside a bracket [1/s].
  static double shear_rate(const Constants& c, double over, double dt) noexcept {
    const double g_dt = c.elastic.shear * dt;
    double low = 0.0;
    double high = std::min(over / g_dt, pow(over / c.consistency, 1.0 / c.flow_index));
    double y = high;
    for (int i = 0; i < 60 && high - low > 1e-14 * high; ++i) {
      const double flow = c.consistency * pow(y, c.flow_index);
      const double residual = flow + g_dt * y - over;
      (residual > 0.0 ? high : low) = y;
      const double next = y - residual / (c.flow_index * flow / y + g_dt);
      if (std::abs(next - y) <= 1e-14 * y) return next;
      y = next > low && next < high ? next : 0.5 * (low + high);
    }
    return y;
  }

  static AdmissibleStress admissible(const Constants& c, const State&, const Stress<2>& total,
                                     LiquefiedReturn) {
    return admissible_fluid(c.tension_cutoff, total);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(const Constants& c,
                                                               const StateOf<T>& old,
                                                               const Stress<Dim, T>& sigma,
                                                               const StrainIncrement<Dim, T>& de,
                                                               double dt) noexcept {
    return update_fluid<Dim>(c.eos, c.elastic.shear, c.tension_cutoff, old, sigma, de, [&](T tau) {
      const double over = tau - c.yield_stress;
      return over > 0.0 ? tau - c.elastic.shear * dt * shear_rate(c, over, dt) : tau;
    });
  }
};
static_assert(ConstitutiveModel<HerschelBulkley, 2> && ConstitutiveModel<HerschelBulkley, 3>);

/// The settings that all fluids have.
template <class Params>
void describe_fluid(FieldVisitor& v, Params& p) {
  v.quantity("eos_exponent", p.eos_exponent, Dim::none, {.min = 1.0},
             "exponent n of the equation of state p = K/n (J^-n - 1); 7 for water");
  v.quantity("tension_cutoff", p.tension_cutoff, Dim::stress, {.min = 0.0}, "largest mean tension");
  v.quantity("shear_modulus", p.shear_modulus, Dim::stress, {.above = 0.0},
             "elastic shear modulus below the flow; left out: a fifth of bulk_modulus");
}

inline constexpr std::string_view kFluidBulkDoc =
    "bulk modulus K; 100 times density x (largest speed)^2 keeps the volume to 1 %";

template <>
struct Schema<NewtonianFluid::Params> {
  static constexpr std::string_view doc = "Newtonian fluid with an equation of state.";
  static void describe(FieldVisitor& v, NewtonianFluid::Params& p) {
    v.quantity("bulk_modulus", p.bulk_modulus, Dim::stress, {.above = 0.0}, kFluidBulkDoc);
    v.quantity("viscosity", p.viscosity, Dim::viscosity, {.min = 0.0}, "dynamic viscosity eta");
    describe_fluid(v, p);
  }
};
template <>
struct Schema<Bingham::Params> {
  static constexpr std::string_view doc = "Bingham fluid with an equation of state.";
  static void describe(FieldVisitor& v, Bingham::Params& p) {
    v.quantity("bulk_modulus", p.bulk_modulus, Dim::stress, {.above = 0.0}, kFluidBulkDoc);
    v.quantity("viscosity", p.viscosity, Dim::viscosity, {.min = 0.0}, "plastic viscosity eta");
    v.quantity("yield_stress", p.yield_stress, Dim::stress, {.min = 0.0},
               "shear stress tau_y below which it does not flow");
    describe_fluid(v, p);
  }
};
template <>
struct Schema<HerschelBulkley::Params> {
  static constexpr std::string_view doc = "Herschel-Bulkley fluid with an equation of state.";
  static void describe(FieldVisitor& v, HerschelBulkley::Params& p) {
    v.quantity("bulk_modulus", p.bulk_modulus, Dim::stress, {.above = 0.0}, kFluidBulkDoc);
    v.quantity("consistency", p.consistency, Dim::none, {.above = 0.0},
               "consistency k of tau = tau_y + k gamma'^n, in Pa s^n");
    v.quantity("flow_index", p.flow_index, Dim::none, {.max = 2.0, .above = 0.0}, "exponent n");
    v.quantity("yield_stress", p.yield_stress, Dim::stress, {.min = 0.0},
               "shear stress tau_y below which it does not flow");
    describe_fluid(v, p);
  }
};

}  // namespace flowslide
