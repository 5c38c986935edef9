#include "workflows/stages/cross_checks.hpp"

/// What a report would keep to itself.
namespace flowslide {

void check_limits(const ReportConfig& report, Findings& found) {
  const ReportConfig usual;
  const auto look = [&](const char* name, const char* balance, double limit, double least) {
    if (limit > least)
      warn(found,
           "{}: {:g} lets the {} balance be off by so much without a word. Those of sound runs "
           "close to 0.001 or better; keep {:g}.",
           name, limit, balance, least);
  };
  look("energy_warning", "energy", report.energy_warning, usual.energy_warning);
  look("momentum_warning", "impulse", report.momentum_warning, usual.momentum_warning);
  look("mass_warning", "mass", report.mass_warning, usual.mass_warning);
}

void check_transfer_rules(const MapConfig& map, Findings& found) {
  if (map.friction_acts_on == FrictionStress::total)
    warn(found,
         "friction_acts_on: total hands no pore pressure over: soil below the water has the "
         "friction of dry soil. Take effective.");
  // The least that anybody has computed with is a quarter.
  constexpr double kLeastSoft = 0.05;
  if (map.c_soft_ratio && *map.c_soft_ratio < kLeastSoft)
    warn(
        found,
        "c_soft_ratio: {:g} leaves liquefied soil with {:.3g} % of its residual strength: it flows "
        "like a liquid. It is a ratio, 1 for the residual strength itself.",
        *map.c_soft_ratio, 100.0 * *map.c_soft_ratio);
  const AuditLimits usual, &a = map.audit;
  const auto look = [&](const char* name, double limit, double least) {
    if (limit > least)
      warn(found, "audit.{}: {:g} passes errors of the transfer that {:g} would refuse.", name,
           limit, least);
  };
  look("mass", a.mass, usual.mass);
  look("volume", a.volume, usual.volume);
  look("momentum", a.momentum, usual.momentum);
  look("kinetic_energy", a.kinetic_energy, usual.kinetic_energy);
  look("stress", a.stress, usual.stress);
  look("yield", a.yield, usual.yield);
  look("out_of_balance_rms", a.out_of_balance_rms, usual.out_of_balance_rms);
  look("out_of_balance_max", a.out_of_balance_max, usual.out_of_balance_max);
}

}  // namespace flowslide
