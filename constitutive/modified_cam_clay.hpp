#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/gap.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flowslide {

/// Modified Cam Clay with indices lambda*, kappa* of logarithmic strain (Butterfield 1979):
/// f = q^2/M^2 + p (p - p_c), associated; K = p/kappa*, constant Poisson's ratio. Effective stress,
/// as mohr_coulomb.hpp; p > 0 in compression here. docs/theory/modified-cam-clay.md
struct ModifiedCamClay {
  static constexpr std::string_view name = "modified_cam_clay";
  static constexpr bool per_point = true;       ///< the return is solved by iteration
  static constexpr bool keeps_pressure = true;  ///< stiffness goes with pressure: minimum_pressure
  struct Params {
    double critical_ratio = kUnset;          ///< M = q/p at the critical state [-]
    double compression_index = kUnset;       ///< lambda* [-]
    double swelling_index = kUnset;          ///< kappa* [-]
    double poisson_ratio = kUnset;           ///< nu [-]
    std::optional<double> preconsolidation;  ///< p_c [Pa]; may be left to the points
    double reference_pressure = 100e3;       ///< p for stiffness before stresses are known [Pa]
    double minimum_pressure = 100.0;         ///< p below which a gap opens [Pa]
  };
  template <class T>
  struct StateOf {
    T plastic_strain = 0.0;    ///< accumulated eps_q^p [-]
    T gap = 0.0;               ///< opened volumetric strain [-]
    T pore_pressure = 0.0;     ///< u [Pa] of the soil without a gap; effective = total + u
    T preconsolidation = 0.0;  ///< p_c [Pa]
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 4> state_names{"plastic_strain", "gap",
                                                               "pore_pressure", "preconsolidation"};
  struct Constants {
    Elasticity elastic;       ///< at the reference pressure
    double m2;                ///< M^2
    double kappa, hardening;  ///< kappa*, 1 / (lambda* - kappa*)
    double shear_ratio;       ///< G/K
    double minimum;           ///< [Pa]
  };

  static Elasticity elasticity(const Params& p) {
    const double bulk = p.reference_pressure / p.swelling_index;
    return {bulk, shear_ratio(p.poisson_ratio) * bulk};
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p),
            p.critical_ratio * p.critical_ratio,
            p.swelling_index,
            1.0 / (p.compression_index - p.swelling_index),
            shear_ratio(p.poisson_ratio),
            p.minimum_pressure};
  }
  static State initial_state(const Params& p) {
    return {0.0, 0.0, 0.0, p.preconsolidation.value_or(kUnset)};
  }
  static double present_strength(const Constants&, const State&) noexcept { return kUnset; }
  /// K + 2 G at the present stress [Pa]: what bounds the time step.
  template <int Dim>
  static double present_modulus(const Constants& c, const State& s,
                                const Stress<Dim>& sigma) noexcept {
    const double p = std::max(c.minimum, -(mean_stress(sigma) + s.pore_pressure));
    return p / c.kappa * (1.0 + 2.0 * c.shear_ratio);
  }

  /// Invariants and hardening variable that a step changes.
  struct Point {
    double p, q, p_c;
    double sheared = 0.0;  ///< eps_q^p of the step
  };
  /// Brings the elastic predictor back to the yield surface; false if the iteration does not end.
  static bool return_to_surface(const Constants& c, double shear, Point& x) noexcept {
    const double p0 = x.p, q0 = x.q, pc0 = x.p_c, scale = 1.0 / (pc0 * pc0);
    if (q0 * q0 / c.m2 + p0 * (p0 - pc0) <= 0.0) return true;
    double e = 0.0, g = 0.0;  // plastic volumetric strain (compression > 0), multiplier x p_c
    const double drag = 6.0 * shear / c.m2 / pc0;
    for (int i = 0; i < 40; ++i) {
      const double p = p0 * exp(-e / c.kappa), pc = pc0 * exp(e * c.hardening);
      const double q = q0 / (1.0 + drag * g);
      const double flow = e - g * (2.0 * p - pc) / pc0;
      const double f = (q * q / c.m2 + p * (p - pc)) * scale;
      if (std::abs(flow) < 1e-14 && std::abs(f) < 1e-12) {
        x = {p, q, pc, 2.0 * g * q / (c.m2 * pc0)};
        return g >= 0.0;
      }
      const double dp = -p / c.kappa, dpc = pc * c.hardening;
      const double flow_e = 1.0 - g * (2.0 * dp - dpc) / pc0, flow_g = -(2.0 * p - pc) / pc0;
      const double f_e = ((2.0 * p - pc) * dp - p * dpc) * scale;
      const double f_g = -2.0 * q * q / c.m2 * drag / (1.0 + drag * g) * scale;
      const double det = flow_e * f_g - flow_g * f_e;
      double de = -(flow * f_g - flow_g * f) / det, dg = -(flow_e * f - f_e * flow) / det;
      const double cut = std::min({1.0, 0.5 * c.kappa / std::max(std::abs(de), 1e-300),
                                   (g + 0.2 / drag) / std::max(std::abs(dg), 1e-300)});
      e += cut * de;
      g = std::max(0.0, g + cut * dg);
    }
    return false;
  }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>& old, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    StressUpdate<StateOf<T>, Dim, T> r;
    for (int parts = 1; parts <= 1024; parts *= 4) {
      r = {sigma, old};
      StrainIncrement<Dim, T> part = de;
      for (T& x : part.v) x *= 1.0 / parts;
      bool done = true;
      for (int i = 0; i < parts && done; ++i) done = advance<Dim>(c, part, r);
      if (done) return r;
    }
    return r;
  }

  /// f / p_c^2 or how far p lies below its minimum, over p_c, whichever is larger.
  static double violation(const Constants& c, double p, double q, double p_c) {
    return std::max((q * q / c.m2 + p * (p - p_c)) / (p_c * p_c), (c.minimum - p) / p_c);
  }

  /// p within its bounds and the deviator scaled to the ellipse of the present p_c: what another
  /// model knew of the soil does not harden it. Without p_c the law cannot tell.
  static AdmissibleStress admissible(const Constants& c, const State& s, const Stress<2>& total,
                                     LiquefiedReturn) {
    if (!is_set(s.preconsolidation)) return any_stress(total);
    const double p_c = std::max(s.preconsolidation, 2.0 * c.minimum);
    const double p_given = -(mean_stress(total) + s.pore_pressure), q = std::sqrt(3.0 * j2(total));
    const double p = std::clamp(p_given, c.minimum, p_c);
    const double most = std::sqrt(c.m2 * p * (p_c - p));
    const double scale = q > most ? most / q : 1.0;
    return {scaled_deviator(total, scale, p, s.pore_pressure), violation(c, p_given, q, p_c),
            violation(c, p, scale * q, p_c)};
  }

 private:
  static double shear_ratio(double nu) { return 1.5 * (1.0 - 2.0 * nu) / (1.0 + nu); }

  template <int Dim>
  static bool advance(const Constants& c, const StrainIncrement<Dim>& de,
                      StressUpdate<State, Dim>& r) noexcept {
    const double volumetric = de[0] + de[1] + de[2], mean = mean_stress(r.stress);
    const double bulk_gap = c.minimum / c.kappa;
    const GapStep<double> step = close_gap_first(r.state.gap, volumetric);
    const double u = present_pore_pressure(bulk_gap, r.state.pore_pressure, r.state.gap);
    const double p_old = std::max(c.minimum, -(mean + u));
    const double shear = c.shear_ratio * p_old / c.kappa;
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
    Point x{p_old * exp(-step.volumetric / c.kappa), q_trial, r.state.preconsolidation};
    const double opened = std::max(0.0, c.kappa * log(c.minimum / x.p));
    x.p = std::max(x.p, c.minimum);
    x.p_c = std::max(x.p_c, 2.0 * c.minimum);
    if (!(std::abs(step.volumetric) < 0.5 * c.kappa) || !return_to_surface(c, shear, x))
      return false;
    r.state.plastic_strain += x.sheared;
    r.state.gap = step.gap + opened;
    r.state.preconsolidation = x.p_c;
    const double scale = q_trial > 0.0 ? x.q / q_trial : 1.0;
    const double now = present_pore_pressure(bulk_gap, r.state.pore_pressure, r.state.gap);
    for (int i = 0; i < 3; ++i) r.stress[i] = s[i] * scale - x.p - now;
    for (int i = 3; i < kVoigt<Dim>; ++i) r.stress[i] = s[i] * scale;
    return true;
  }
};
static_assert(ConstitutiveModel<ModifiedCamClay, 2> && ConstitutiveModel<ModifiedCamClay, 3>);

/// Relations between parameters that ranges cannot express. Throws InputError.
void check(const ModifiedCamClay::Params& p);

template <>
struct Schema<ModifiedCamClay::Params> {
  static constexpr std::string_view doc = "Modified Cam Clay.";
  static void describe(FieldVisitor& v, ModifiedCamClay::Params& p) {
    v.quantity("critical_ratio", p.critical_ratio, Dim::none, {.above = 0.0},
               "M = q/p at the critical state; 6 sin(phi) / (3 - sin(phi)) in compression");
    v.quantity("compression_index", p.compression_index, Dim::none, {.above = 0.0},
               "lambda* = lambda/(1+e), slope of ln p against volumetric strain");
    v.quantity("swelling_index", p.swelling_index, Dim::none, {.above = 0.0},
               "kappa* = kappa/(1+e)");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu");
    v.quantity("preconsolidation", p.preconsolidation, Dim::stress, {.above = 0.0},
               "preconsolidation pressure p_c; may be left out where every point brings its own");
    v.quantity("reference_pressure", p.reference_pressure, Dim::stress, {.above = 0.0},
               "mean pressure for the stiffness of the first time step");
    v.quantity("minimum_pressure", p.minimum_pressure, Dim::stress, {.above = 0.0},
               "mean pressure below which the soil opens");
  }
};

}  // namespace flowslide
