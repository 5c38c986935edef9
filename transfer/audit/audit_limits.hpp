#pragma once
#include "config/schema.hpp"

#include <string_view>

namespace flowslide {

/// Largest errors a transfer may have; docs/theory/transfer.md, "Audit".
struct AuditLimits {
  double mass = 1e-10;               ///< relative
  double volume = 1e-10;             ///< relative
  double momentum = 1e-3;            ///< of the sum of m |v|
  double kinetic_energy = 0.01;      ///< of it, or of that at 1 cm/s
  double stress = 0.02;              ///< integral of each component, of that of |sigma_yy|
  double yield = 1e-6;               ///< left after the return, relative to the strength
  double out_of_balance_rms = 0.03;  ///< [g], state at rest only
  double out_of_balance_max = 1.0;   ///< [g], state at rest only
  bool enforce = true;
};

template <>
struct Schema<AuditLimits> {
  static constexpr std::string_view doc =
      "Largest errors a transfer may have before it stops the run with exit code 3.";
  static void describe(FieldVisitor& v, AuditLimits& a) {
    const Range positive{.min = 0.0};
    v.quantity("mass", a.mass, Dim::none, positive, "relative error of the total mass");
    v.quantity("volume", a.volume, Dim::none, positive, "relative error of the total volume");
    v.quantity("momentum", a.momentum, Dim::none, positive,
               "error of each component of the momentum, relative to the sum of m |v|");
    v.quantity(
        "kinetic_energy", a.kinetic_energy, Dim::none, positive,
        "error of the kinetic energy, relative to it, or to that of the whole mass at 1 cm/s "
        "where it is less");
    v.quantity("stress", a.stress, Dim::none, positive,
               "error of the volume integral of each total stress component as mapped, relative to "
               "that of |sigma_yy|");
    v.quantity(
        "yield", a.yield, Dim::none, positive,
        "violation of the yield surface that the return may leave, relative to the strength");
    v.quantity(
        "out_of_balance_rms", a.out_of_balance_rms, Dim::none, positive,
        "out-of-balance acceleration of the first MPM step as mapped, in g, root mean square "
        "over interior nodes; applies to the state at rest before the motion");
    v.quantity("out_of_balance_max", a.out_of_balance_max, Dim::none, positive,
               "the same, largest value");
    v.flag("enforce", a.enforce, "false: report only, never stop the run");
  }
};

}  // namespace flowslide
