#include "constitutive/pm4sand.hpp"

#include "constitutive/pm4sand_flow.hpp"
#include "core/elementary.hpp"

namespace flowslide {
namespace {

// Strain increments and tolerance that are left out; docs/theory/pm4sand.md, "Tolerance". Mixed
// steps of a single point are solved to 1e-5 of its stress, and implicit steps iterate.
constexpr double kPointPrecision = 1e-5, kMeshPrecision = 1e-4;

/// OpenSees' interpolation, which follows the authors' FLAC code rather than their manual.
double default_ce(double Dr) { return std::clamp(0.5 - 1.5 * (Dr - 0.55), 0.2, 0.5); }

double default_Ckaf(double Dr) {
  return std::clamp(5.0 + 220.0 * (Dr - 0.26) * (Dr - 0.26) * (Dr - 0.26), 4.0, 35.0);
}

/// C_dr lessens the dilatancy of the rotated surface; in very loose sand its formula would raise or
/// even turn it.
double default_Cdr(double Dr) {
  const double Cdr = 5.0 + 25.0 * (Dr - 0.35);
  validate(
      Cdr >= 1.0,
      "pm4sand: Dr = {} is too loose for the default of Cdr (5 + 25 (Dr - 0.35) is {:.3g}, and "
      "a divisor below 1 raises what it is to lessen) give Cdr, or a Dr of 0.19 or more",
      Dr, Cdr);
  return Cdr;
}

}  // namespace

PM4Sand::Constants PM4Sand::constants(const Params& p) {
  validate(p.emax > p.emin,
           "pm4sand: emax {} is not above emin {} (the void ratio falls with density) swap them?",
           p.emax, p.emin);
  validate(p.Q > 5.0,
           "pm4sand: Q = {} puts the critical state below one atmosphere at any density (the state "
           "index is then undefined) use a Q of about 10",
           p.Q);
  validate(p.nb > 0.0 || p.Ado,
           "pm4sand: nb = 0 puts the bounding surface on the critical state (the dilatancy that "
           "Ado is found from is then none) give Ado, or an nb of about 0.5");
  Constants c;
  c.G_unit = p.G0 * std::sqrt(p.P_atm);
  c.bulk_ratio = 2.0 / 3.0 * (1.0 + p.nu) / (1.0 - 2.0 * p.nu);
  c.pressure_ratio = c.bulk_ratio + 1.0 / 3.0;
  c.Cgd = p.Cgd;
  c.depth = p.Q - log(100.0 / p.P_atm);
  c.R = p.R;
  c.nb = p.nb;
  c.nd = p.nd;
  c.M = 2.0 * sin(p.phi_cv);
  c.m = p.m;
  c.h0 = p.h0.value_or(std::max(0.3, 0.5 * (0.25 + p.Dr)));
  c.C_g1 = c.h0 / 200.0;
  c.Ckaf = std::clamp(p.Ckaf.value_or(default_Ckaf(p.Dr)), 4.0, 35.0);
  c.inverse_hpo = 1.0 / p.hpo;
  c.ce2 = pow(p.ce.value_or(default_ce(p.Dr)), 2);
  c.inverse_Cdr = 1.0 / std::min(p.Cdr ? *p.Cdr : default_Cdr(p.Dr), 10.0);
  c.cz = p.cz;
  c.emax = p.emax;
  c.density_rate = 1.0 / (p.emax - p.emin);
  c.initial_void_ratio = p.emax - (p.emax - p.emin) * p.Dr;
  c.void_rate = 1.0 + c.initial_void_ratio;
  c.P_atm = p.P_atm;
  c.Fsed_min = std::min(p.Fsed_min.value_or(0.03 * exp(2.6 * p.Dr)), 0.99);
  c.p_sedo = p.p_sedo.value_or(0.2 * p.P_atm);
  c.Dr = p.Dr;
  c.Ado = p.Ado;
  c.z_max = p.z_max;
  c.opensees_reversals = p.reversals == Reversals::opensees ? 1.0 : 0.0;
  c.max_strain_increment = p.max_strain_increment.value_or(kPointPrecision);
  c.tolerance = p.tolerance.value_or(kPointPrecision);
  return c;
}

PM4Sand::Constants PM4Sand::mesh_constants(const Params& p) {
  Constants c = constants(p);
  c.max_strain_increment = p.max_strain_increment.value_or(kMeshPrecision);
  c.tolerance = p.tolerance.value_or(kMeshPrecision);
  return c;
}

ShearStrength PM4Sand::shear_strength(const Params& p) { return {0.0, sin(p.phi_cv)}; }

Elasticity PM4Sand::gravity_elasticity(const Params& p, double poisson_ratio) {
  const double shear = p.G0 * p.P_atm;
  return {2.0 / 3.0 * (1.0 + poisson_ratio) / (1.0 - 2.0 * poisson_ratio) * shear, shear};
}

PM4Sand::State PM4Sand::initial_state(const Constants& c, const Stress<2>& sigma,
                                      double volumetric_strain) noexcept {
  using namespace pm4sand;
  PM4Sand::State s;
  double p = -0.5 * (sigma[0] + sigma[1]);
  Deviator dev{-0.5 * (sigma[0] - sigma[1]), -sigma[3]};
  s.p_min = std::max(p, c.P_atm) / 200.0;
  if (p < s.p_min) {
    s.held_p = p - s.p_min;
    s.held = dev;
    p = s.p_min;
    dev = {};
  }
  const Surfaces<double> f = surfaces<double>(c, p, c.Dr);
  s.z_max = c.z_max.value_or(std::min(0.7 * exp(-6.1 * f.xi), 20.0));
  const double dense_A_do =
      f.Mb > 2.0 ? 1.5 : 2.5 * (asin(0.5 * f.Mb) - asin(0.5 * c.M)) / (f.Mb - f.Md);
  s.A_do = c.Ado.value_or(f.xi < 0.0 ? dense_A_do : 1.24);

  const double M_start = kRoot2 * norm(dev) / p;
  if (M_start > f.Mb) {
    const Deviator inside = (f.Mb / M_start) * dev;
    s.held = dev - inside;
    s.alpha = ((f.Mb - c.m) / (f.Mb * p)) * inside;
  } else {
    s.alpha = (1.0 / p) * dev;
  }
  s.alpha_true = s.alpha_max = s.alpha_min = s.alpha;
  s.z_peak = 1e-5 * s.z_max;
  s.p_zp = 0.01 * p;
  s.void_ratio = c.initial_void_ratio - c.void_rate * volumetric_strain;
  return s;
}

Elasticity PM4Sand::elasticity(const Constants& c, const State& s,
                               const Stress<2>& sigma) noexcept {
  using namespace pm4sand;
  const PointOf<double> at{-0.5 * (sigma[0] + sigma[1]) - s.held_p,
                           Deviator{-0.5 * (sigma[0] - sigma[1]), -sigma[3]} - s.held,
                           {},
                           {}};
  const double G = local<double>(c, s, stiffening<double>(c, s), at).G;
  return {c.bulk_ratio * G, G};
}

void Schema<PM4Sand::Params>::describe(FieldVisitor& v, PM4Sand::Params& p) {
  v.quantity("Dr", p.Dr, Dim::none, {.max = 1.0, .above = 0.0}, "relative density, 0..1");
  v.quantity("G0", p.G0, Dim::none, {.max = 1e5, .above = 0.0}, "shear modulus coefficient");
  v.quantity("hpo", p.hpo, Dim::none, {.max = 1e3, .above = 0.0},
             "contraction rate parameter; calibrate it to the cyclic strength");
  v.quantity("P_atm", p.P_atm, Dim::stress, {.min = 50e3, .max = 200e3}, "atmospheric pressure");
  v.quantity("h0", p.h0, Dim::none, {.max = 1e2, .above = 0.0},
             "plastic modulus factor; left out: max(0.3, (0.25 + Dr)/2)");
  v.quantity("emax", p.emax, Dim::none, {.max = 10.0, .above = 0.0}, "largest void ratio");
  v.quantity("emin", p.emin, Dim::none, {.max = 10.0, .above = 0.0}, "smallest void ratio");
  v.quantity("nb", p.nb, Dim::none, {.min = 0.0, .max = 10.0}, "exponent of the bounding surface");
  v.quantity("nd", p.nd, Dim::none, {.min = 0.0, .max = 10.0}, "exponent of the dilatancy surface");
  v.quantity("Ado", p.Ado, Dim::none, {.max = 1e2, .above = 0.0},
             "dilatancy coefficient; left out: from the surfaces at the initial state");
  v.quantity("z_max", p.z_max, Dim::none, {.max = 1e3, .above = 0.0},
             "limit of fabric; left out: min(0.7 exp(-6.1 xi_R0), 20)");
  v.quantity("cz", p.cz, Dim::none, {.min = 0.0, .max = 1e6}, "rate of fabric growth");
  v.quantity("ce", p.ce, Dim::none, {.max = 10.0, .above = 0.0},
             "factor on the strain accumulation after liquefaction; left out: 0.5 to 0.2 for Dr "
             "0.55 to 0.75");
  v.quantity("phi_cv", p.phi_cv, Dim::angle, {.above = 0.0, .below = 1.2},
             "friction angle at the critical state");
  v.quantity("nu", p.nu, Dim::none, {.min = 0.0, .below = 0.5}, "Poisson's ratio");
  v.quantity("Cgd", p.Cgd, Dim::none, {.min = 1.0, .max = 1e2},
             "largest degradation of G by fabric");
  v.quantity("Cdr", p.Cdr, Dim::none, {.max = 1e3, .above = 0.0},
             "factor on the dilatancy of the rotated surface; left out: 5 + 25 (Dr - 0.35), at "
             "most 10; needed below Dr = 0.19");
  v.quantity("Ckaf", p.Ckaf, Dim::none, {.max = 1e3, .above = 0.0},
             "factor on the plastic modulus under a static shear stress; left out: "
             "5 + 220 (Dr - 0.26)^3; kept within 4..35");
  v.quantity("Q", p.Q, Dim::none, {.max = 20.0, .above = 0.0}, "critical-state line: Q of Bolton");
  v.quantity("R", p.R, Dim::none, {.max = 20.0, .above = 0.0}, "critical-state line: R of Bolton");
  v.quantity("m", p.m, Dim::none, {.above = 0.0, .below = 0.5}, "radius of the yield surface");
  v.quantity("Fsed_min", p.Fsed_min, Dim::none, {.max = 1.0, .above = 0.0},
             "smallest elastic-modulus factor after shaking; left out: 0.03 exp(2.6 Dr)");
  v.quantity("p_sedo", p.p_sedo, Dim::stress, {.max = 1e6, .above = 0.0},
             "mean stress up to which the modulus is lowered after shaking; left out: P_atm/5");
  v.quantity("max_strain_increment", p.max_strain_increment, Dim::none, {.min = 1e-8, .max = 1.0},
             "largest strain component of a sub-step; left out: 1e-4 in explicit steps of a mesh, "
             "else 1e-5");
  v.choice("reversals", p.reversals, PM4Sand::reversals_names,
           "what small cycles about a shear stress remember: the distance from the last reversal "
           "until the one before is passed, or the rule as OpenSees has it");
  v.quantity("tolerance", p.tolerance, Dim::none, {.min = 1e-8, .max = 1.0},
             "stress error of a sub-step relative to the stress, which larger errors divide; left "
             "out: as max_strain_increment");
}

}  // namespace flowslide
