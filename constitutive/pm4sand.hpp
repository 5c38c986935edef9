#pragma once
#include "config/schema.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/shaking.hpp"
#include "core/conventions.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace flowslide {

/// Numbers of PM4Sand; T is double, or as many as go through the same arithmetic (core/pack.hpp).
namespace pm4sand {

/// Symmetric, trace-free tensor in the plane: d = (xx - yy)/2, t = xy.
template <class T>
struct DeviatorOf {
  T d = 0.0, t = 0.0;
  bool operator==(const DeviatorOf&) const = default;
};

/// Everything a point remembers besides its stress; compression positive, Pa.
template <class T>
struct StateOf {
  DeviatorOf<T> alpha;       ///< back-stress ratio
  DeviatorOf<T> alpha_in;    ///< apparent initial back-stress ratio of this loading branch
  DeviatorOf<T> alpha_in_p;  ///< back-stress ratio at the reversal before the last
  DeviatorOf<T> alpha_true;  ///< back-stress ratio at the last reversal
  DeviatorOf<T> alpha_max;   ///< largest negative initial ratio so far, by component
  DeviatorOf<T> alpha_min;   ///< smallest positive one
  DeviatorOf<T> z;           ///< fabric
  DeviatorOf<T> z_in;        ///< fabric at the last reversal
  DeviatorOf<T> held;        ///< deviator of the initial stress beyond the bounding surface
  T held_p = 0.0;            ///< mean stress missing to p_min at the start
  T z_cum = 0.0;             ///< accumulated fabric
  T z_peak = 0.0;            ///< largest fabric so far
  T z_xp = 0.0;              ///< largest |z| p at a reversal
  T p_zp = 0.0;              ///< mean stress at that reversal
  T reversed = 0.0;          ///< 1 after the first reversal
  T p_min = 0.0;             ///< floor of mean stress in the moduli: max(p_0, P_atm)/200
  T z_max = 0.0;             ///< limit of fabric
  T A_do = 0.0;              ///< dilatancy coefficient
  T void_ratio = 0.0;
  T band = 1.0;  ///< length of softening over size of the element; 1: softens without a length
  bool operator==(const StateOf&) const = default;
};

/// What the rate equations know of a soil, with inverses and products so that they need not divide.
/// Members without a comment are the parameters of their names.
template <class T>
struct SoilOf {
  T G_unit;          ///< G_0 sqrt(P_atm): G at 1 Pa, before the other factors [Pa^(1/2)]
  T bulk_ratio;      ///< K/G
  T pressure_ratio;  ///< (K + G/3)/G
  T Cgd;
  T depth;  ///< Q - ln(100 Pa/P_atm)
  T R, nb, nd, M, m, h0;
  T C_g1;  ///< h_0/200
  T Ckaf;
  T inverse_hpo, inverse_Cdr;
  T ce2;  ///< c_e^2
  T cz, emax;
  T density_rate;  ///< D_R = density_rate (emax - e)
  T void_rate;     ///< de = -void_rate deps_v, 1 + e_init
  T P_atm, Fsed_min, p_sedo, tolerance;
  T opensees_reversals = 0.0;  ///< 1: small cycles remember what they do in OpenSees
  T post_shake = 0.0;  ///< 1: softer elasticity while the soil settles; the caller sets it then
};

}  // namespace pm4sand

/// PM4Sand 3.1 (Boulanger & Ziotopoulou 2017, UCD/CGM-17/01), a bounding-surface law for sand under
/// cyclic loading in plane strain. Effective stress outside: tension positive, Pa. Inside the
/// update compression is positive; the signs are turned at its border. Differences from the
/// implementation in OpenSees are listed in docs/theory/pm4sand.md.
struct PM4Sand {
  static constexpr std::string_view name = "pm4sand";
  static constexpr bool plane_mean_stress = true;  ///< sigma_zz is (xx + yy)/2

  /// What small cycles about a shear stress remember: docs/theory/pm4sand.md, "Reversals".
  enum class Reversals { published, opensees };
  static constexpr std::array<std::string_view, 2> reversals_names{"published", "opensees"};

  /// Names and defaults of the OpenSees command; the density is the element's business.
  struct Params {
    double Dr = kUnset;                  ///< relative density, 0..1
    double G0 = kUnset;                  ///< shear modulus coefficient [-]
    double hpo = kUnset;                 ///< contraction rate, calibrated to cyclic strength [-]
    double P_atm = kAtmosphere;          ///< [Pa]
    std::optional<double> h0;            ///< unset: max(0.3, (0.25 + Dr)/2)
    double emax = 0.8, emin = 0.5;       ///< void ratios at Dr = 0 and Dr = 1
    double nb = 0.5, nd = 0.1;           ///< bounding and dilatancy surface exponents
    std::optional<double> Ado;           ///< unset: from the surfaces at the initial state
    std::optional<double> z_max;         ///< unset: min(0.7 exp(-6.1 xi_R0), 20)
    double cz = 250.0;                   ///< rate of fabric growth
    std::optional<double> ce;            ///< unset: 0.5 to 0.2 for Dr 0.55 to 0.75
    double phi_cv = 33.0 * kPi / 180.0;  ///< critical-state friction angle [rad]
    double nu = 0.3;                     ///< Poisson's ratio
    double Cgd = 2.0;                    ///< factor by which fabric lowers G in the end
    std::optional<double> Cdr;           ///< unset: min(10, 5 + 25 (Dr - 0.35))
    std::optional<double> Ckaf;          ///< unset: 5 + 220 (Dr - 0.26)^3 within 4..35
    double Q = 10.0, R = 1.5;            ///< critical-state line (Bolton)
    double m = 0.01;                     ///< size of the yield surface
    std::optional<double> Fsed_min;      ///< unset: min(0.99, 0.03 exp(2.6 Dr))
    std::optional<double> p_sedo;        ///< [Pa]; unset: P_atm/5
    /// Largest strain component of a sub-step, and its allowed relative stress error. Unset: 1e-4
    /// in explicit steps of a mesh, else 1e-5.
    std::optional<double> max_strain_increment, tolerance;
    Reversals reversals = Reversals::published;
  };

  using Deviator = pm4sand::DeviatorOf<double>;
  using State = pm4sand::StateOf<double>;
  static constexpr std::array<std::string_view, 29> state_names{
      "alpha_d",      "alpha_t",      "alpha_in_d",  "alpha_in_t",  "alpha_in_p_d", "alpha_in_p_t",
      "alpha_true_d", "alpha_true_t", "alpha_max_d", "alpha_max_t", "alpha_min_d",  "alpha_min_t",
      "z_d",          "z_t",          "z_in_d",      "z_in_t",      "held_d",       "held_t",
      "held_p",       "z_cum",        "z_peak",      "z_xp",        "p_zp",         "reversed",
      "p_min",        "z_max",        "A_do",        "void_ratio",  "band"};

  /// Numbers derived once from the parameters.
  struct Constants : pm4sand::SoilOf<double> {
    double Dr, initial_void_ratio, max_strain_increment;
    std::optional<double> Ado, z_max;
  };

  struct Work {
    int sub_steps = 0;  ///< accepted sub-steps
    int rejected = 0;   ///< sub-steps repeated with a smaller size
    int floored = 0;    ///< sub-steps that ended below p_min/5 and were lifted
  };
  struct Update : Work {
    Stress<2> stress;
    State state;
  };

  /// Throws InputError for relations that ranges cannot express.
  static Constants constants(const Params& p);
  /// For explicit steps of a mesh, whose sub-steps may be coarser.
  static Constants mesh_constants(const Params& p);

  /// The elastic stage of gravity: Hooke's law with G = G0 P_atm at every pressure. The Poisson's
  /// ratio of that stage sets K_0 = nu/(1 - nu) and need not be the law's own.
  static Elasticity gravity_elasticity(const Params& p, double poisson_ratio);

  /// Critical-state friction: tau <= p sin(phi_cv).
  static ShearStrength shear_strength(const Params& p);

  /// FirstCall of OpenSees: the state of a point that was consolidated to `sigma` and has no
  /// history of shearing. A stress below p_min or beyond the bounding surface is split: the
  /// admissible part is integrated, the rest is held and added again to every returned stress.
  /// @param volumetric_strain of the gravity stage, compression positive; lowers the void ratio.
  static State initial_state(const Constants& c, const Stress<2>& sigma,
                             double volumetric_strain = 0.0) noexcept;

  /// Present elastic constants [Pa]; what a time-step bound and an elastic tangent need.
  static Elasticity elasticity(const Constants& c, const State& s, const Stress<2>& sigma) noexcept;

  /// The stress and state after `de` (engineering shear, zz ignored). The out-of-plane stress of
  /// the result is (xx + yy)/2, the law's own mean stress. Splitting `de` at any multiple of
  /// max_strain_increment does not change the result. NaN in, NaN out; the same for a strain of
  /// more than 1.
  [[nodiscard]] static Update update(const Constants& c, const State& old, const Stress<2>& sigma,
                                     const StrainIncrement<2>& de) noexcept;

  /// A point that is to be updated in place.
  struct Task {
    const Constants* constants;
    State* state;
    Stress<2>* stress;
    StrainIncrement<2> increment;
  };
  /// `update` of every point that `next` names, until it returns false: the same bits, in any
  /// order, many points at a time. A point that is done makes room for the next one.
  template <class Next>
  static Work update_all(Next&& next) noexcept;  // in pm4sand_lanes.hpp
};
static_assert(std::is_trivially_copyable_v<PM4Sand::State> &&
              sizeof(PM4Sand::State) == sizeof(double) * PM4Sand::state_names.size());

/// As PM4Sand::constants.
void check(const PM4Sand::Params& p);

template <>
struct Schema<PM4Sand::Params> {
  static constexpr std::string_view doc =
      "PM4Sand 3.1 in plane strain; argument names and defaults of OpenSees.";
  static void describe(FieldVisitor& v, PM4Sand::Params& p);
};

}  // namespace flowslide
