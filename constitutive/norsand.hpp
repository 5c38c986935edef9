#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/softening.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flowslide {

/// NorSand (Jefferies 1993; Jefferies & Been 2016) with a circular critical-state cone: associated,
/// f = q - p M_i (1 + ln(p_i/p)), hardening of the image pressure p_i towards the greatest dilation
/// that the state parameter allows. Effective stress; p > 0 in compression here.
/// docs/theory/norsand.md
struct NorSand {
  static constexpr std::string_view name = "norsand";
  static constexpr bool per_point = true;  ///< integrated in as many parts as the strain needs
  struct Params {
    double critical_ratio = kUnset;        ///< M = q/p at the critical state [-]
    double csl_void_ratio = kUnset;        ///< Gamma, void ratio of the critical state at 1 kPa [-]
    double csl_slope = kUnset;             ///< lambda_e, per natural logarithm [-]
    double dilatancy = 3.5;                ///< chi: smallest D_min = chi psi_i [-]
    double coupling = 0.3;                 ///< N of M_i = M - N chi_i |psi_i| [-]
    double hardening = kUnset;             ///< H_0 [-]
    double hardening_state = 0.0;          ///< H_psi: H = H_0 - H_psi psi [-]
    double shear_modulus = kUnset;         ///< G at the reference pressure [Pa]
    double shear_exponent = 0.5;           ///< n of G = G_ref (p/p_ref)^n [-]
    double poisson_ratio = 0.2;            ///< nu [-]
    double reference_pressure = 100e3;     ///< p_ref [Pa]
    double minimum_pressure = 100.0;       ///< lowest p [Pa]
    std::optional<double> void_ratio;      ///< e [-]; may be left to the points
    std::optional<double> image_pressure;  ///< p_i [Pa]; likewise
  };
  template <class T>
  struct StateOf {
    T plastic_strain = 0.0;  ///< accumulated eps_q^p [-]
    T pore_pressure = 0.0;   ///< u [Pa], constant; effective = total + u
    T void_ratio = 0.0;      ///< e [-]
    T image_pressure = 0.0;  ///< p_i [Pa]
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 4> state_names{"plastic_strain", "pore_pressure",
                                                               "void_ratio", "image_pressure"};
  struct Constants {
    Elasticity elastic;  ///< at the reference pressure
    Params p;
    double bulk_ratio;  ///< K/G
  };

  static Elasticity elasticity(const Params& p) {
    return {bulk_ratio(p.poisson_ratio) * p.shear_modulus, p.shear_modulus};
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p), p, bulk_ratio(p.poisson_ratio)};
  }
  static State initial_state(const Params& p) {
    return {0.0, 0.0, p.void_ratio.value_or(kUnset), p.image_pressure.value_or(kUnset)};
  }
  static double present_strength(const Constants&, const State&) noexcept { return kUnset; }
  /// K + 2 G at the present stress [Pa]: what bounds the time step.
  template <int Dim>
  static double present_modulus(const Constants& c, const State& s,
                                const Stress<Dim>& sigma) noexcept {
    return shear_at(c, -(mean_stress(sigma) + s.pore_pressure)) * (c.bulk_ratio + 2.0);
  }

  /// State parameter at the pressure p [-].
  static double state_parameter(const Params& p, double void_ratio, double pressure) noexcept {
    return void_ratio - p.csl_void_ratio + p.csl_slope * log(pressure / 1e3);
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>& old, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    // An invariant, not the largest component: the answer must not turn with the axes.
    double squares = 0.0;
    for (int i = 0; i < kVoigt<Dim>; ++i) squares += (i < 3 ? 2.0 : 1.0) * de[i] * de[i];
    // min hands on 199 for what is not a number, too
    const int parts = 1 + static_cast<int>(std::min(199.0, std::sqrt(squares) / kPart));
    StrainIncrement<Dim, T> part = de;
    for (T& x : part.v) x *= 1.0 / parts;
    StressUpdate<StateOf<T>, Dim, T> r{sigma, old};
    admit<Dim>(c, r);
    for (int i = 0; i < parts; ++i) advance<Dim>(c, part, r);
    return r;
  }

  /// p at least its minimum and the deviator scaled to the surface of the present image pressure.
  /// Without void ratio and image pressure the law cannot tell.
  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn) {
    if (!is_set(s.void_ratio) || !is_set(s.image_pressure)) return any_stress(total);
    const double p = std::max(c.p.minimum_pressure, -(mean_stress(total) + s.pore_pressure));
    return limited_shear(total, s.pore_pressure, std::sqrt(3.0 * j2(total)), most_shear(c, s, p),
                         p);
  }

 private:
  static constexpr double kPart = 5e-5;  ///< strain of a part

  static double bulk_ratio(double nu) { return 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)); }
  static double shear_at(const Constants& c, double pressure) noexcept {
    return c.elastic.shear * pow(std::max(pressure, c.p.minimum_pressure) / c.p.reference_pressure,
                                 c.p.shear_exponent);
  }

  /// M_i at an image pressure [-].
  static double image_ratio(const Params& k, double chi, double psi_image) noexcept {
    return std::max(0.1 * k.critical_ratio,
                    k.critical_ratio - k.coupling * chi * std::abs(psi_image));
  }
  static double limiting_dilatancy(const Params& k) noexcept {
    return k.dilatancy / (1.0 - k.csl_slope * k.dilatancy / k.critical_ratio);
  }

  /// q on the surface at the pressure p [Pa].
  static double most_shear(const Constants& c, const State& s, double p) noexcept {
    const double image = s.image_pressure;
    const double psi_image = state_parameter(c.p, s.void_ratio, image);
    const double m = image_ratio(c.p, limiting_dilatancy(c.p), psi_image);
    return std::max(0.0, p * m * (1.0 + log(image / p)));
  }

  /// A stress beyond the surface, which only the start of a run can bring, loses what is too much
  /// of its deviator: flow along the surface from that far is ill-conditioned.
  template <int Dim>
  static void admit(const Constants& c, StressUpdate<State, Dim>& r) noexcept {
    const double mean = mean_stress(r.stress), q = std::sqrt(3.0 * j2(r.stress));
    const double p = std::max(c.p.minimum_pressure, -(mean + r.state.pore_pressure));
    const double most = most_shear(c, r.state, p);
    if (!(q > most)) return;
    const double scale = most / q;
    for (int i = 0; i < 3; ++i) r.stress[i] = (r.stress[i] - mean) * scale + mean;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] *= scale;
  }

  template <int Dim>
  static void advance(const Constants& c, const StrainIncrement<Dim>& de,
                      StressUpdate<State, Dim>& r) noexcept {
    const Params& k = c.p;
    const double volumetric = de[0] + de[1] + de[2], mean = mean_stress(r.stress);
    const double p_old = std::max(k.minimum_pressure, -(mean + r.state.pore_pressure));
    const double shear = shear_at(c, p_old), bulk = c.bulk_ratio * shear;
    std::array<double, kVoigt<Dim>> s{};
    double j2_trial = 0.0;
    for (int i = 0; i < 3; ++i) {
      s[i] = r.stress[i] - mean + 2.0 * shear * (de[i] - volumetric / 3.0);
      j2_trial += 0.5 * s[i] * s[i];
    }
    for (int i = 3; i < kVoigt<Dim>; ++i) {
      s[i] = r.stress[i] + shear * de[i];
      j2_trial += s[i] * s[i];
    }
    const double q_trial = std::sqrt(3.0 * j2_trial);
    double q = q_trial, p = std::max(k.minimum_pressure, p_old - bulk * volumetric);
    double image = r.state.image_pressure, sheared = 0.0;
    const double e = std::max(0.01, r.state.void_ratio + (1.0 + r.state.void_ratio) * volumetric);

    const double chi = limiting_dilatancy(k);
    for (int i = 0; i < 30; ++i) {
      const double psi_image = state_parameter(k, e, image);
      const double m = image_ratio(k, chi, psi_image);
      const double f = q - p * m * (1.0 + log(image / p));
      if (f <= 1e-9 * p) break;
      const double dilatancy = m * log(p / image);  // M_i - eta on the surface
      const double h = std::max(0.0, k.hardening - k.hardening_state * state_parameter(k, e, p));
      const double greatest = exp(-chi * psi_image / m);
      const double ratio = p / image;
      const double hardening = h * image * ratio * ratio * (greatest - image / p);
      const double stiffness =
          3.0 * shear + bulk * dilatancy * dilatancy + p * m / image * hardening;
      const double step = std::min(f / std::max(stiffness, 0.3 * shear), q / (3.0 * shear));
      q -= 3.0 * shear * step;
      p = std::max(k.minimum_pressure, p - bulk * dilatancy * step);
      image = std::max(0.5 * k.minimum_pressure, image + hardening * step);
      sheared += step;
    }
    r.state.plastic_strain += sheared;
    r.state.void_ratio = e;
    r.state.image_pressure = image;
    const double scale = q_trial > 0.0 ? q / q_trial : 1.0;
    for (int i = 0; i < 3; ++i) r.stress[i] = s[i] * scale - p - r.state.pore_pressure;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = s[i] * scale;
  }
};
static_assert(ConstitutiveModel<NorSand, 2> && ConstitutiveModel<NorSand, 3>);

/// Relations between parameters that ranges cannot express. Throws InputError.
void check(const NorSand::Params& p);

template <>
struct Schema<NorSand::Params> {
  static constexpr std::string_view doc = "NorSand with a circular critical-state cone.";
  static void describe(FieldVisitor& v, NorSand::Params& p) {
    v.quantity("critical_ratio", p.critical_ratio, Dim::none, {.above = 0.0},
               "M = q/p at the critical state");
    v.quantity("csl_void_ratio", p.csl_void_ratio, Dim::none, {.above = 0.0},
               "void ratio of the critical state line at p = 1 kPa");
    v.quantity("csl_slope", p.csl_slope, Dim::none, {.above = 0.0},
               "slope of the critical state line, e against ln p");
    v.quantity("dilatancy", p.dilatancy, Dim::none, {.above = 0.0},
               "chi: greatest dilation is chi times the state parameter");
    v.quantity("coupling", p.coupling, Dim::none, {.min = 0.0, .max = 1.0},
               "volumetric coupling N: the image stress ratio is M - N chi_i abs(psi_i)");
    v.quantity("hardening", p.hardening, Dim::none, {.above = 0.0}, "plastic hardening H_0");
    v.quantity("hardening_state", p.hardening_state, Dim::none, {}, "H_psi of H = H_0 - H_psi psi");
    v.quantity("shear_modulus", p.shear_modulus, Dim::stress, {.above = 0.0},
               "shear modulus at the reference pressure");
    v.quantity("shear_exponent", p.shear_exponent, Dim::none, {.min = 0.0, .max = 1.0},
               "exponent of the pressure in the shear modulus");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu");
    v.quantity("reference_pressure", p.reference_pressure, Dim::stress, {.above = 0.0},
               "mean pressure at which shear_modulus holds");
    v.quantity("minimum_pressure", p.minimum_pressure, Dim::stress, {.above = 0.0},
               "lowest mean pressure");
    v.quantity("void_ratio", p.void_ratio, Dim::none, {.above = 0.0},
               "void ratio; may be left out where every point brings its own");
    v.quantity("image_pressure", p.image_pressure, Dim::stress, {.above = 0.0},
               "image pressure p_i; may be left out likewise");
  }
};

}  // namespace flowslide
