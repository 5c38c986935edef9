#pragma once
#include "model/zone.hpp"
#include "transfer/audit/audit.hpp"
#include "transfer/audit/audit_limits.hpp"
#include "transfer/sordo2024/compat_sordo2024.hpp"

namespace flowslide {

/// Settings of the stage: those of the script, and what the audit of this program asks.
struct SordoTransferConfig : SordoConfig {
  double cell = kUnset;                 ///< cell of the MPM grid [m]
  std::array<double, 2> grid_origin{};  ///< a node of the MPM grid [m]
};

struct SordoResult {
  ParticleSet particles;
  TransferAudit audit;
};

/// The points of the published script, of the frame that the zone names, with the audit of this
/// program. The defects of the script exceed the limits of the audit by design, so they are
/// reported and never enforced. Throws what map_sordo2024 does.
SordoResult map_sordo2024_audited(const FemHistory& history, const LiquefactionZone& zone,
                                  const SordoTransferConfig& config);

template <>
struct Schema<SordoTransferConfig> {
  static constexpr std::string_view doc = Schema<SordoConfig>::doc;
  static void describe(FieldVisitor& v, SordoTransferConfig& c) {
    v.quantity("cell", c.cell, Dim::length, {.above = 0.0}, "cell of the MPM grid, for the audit");
    v.tuple("grid_origin", c.grid_origin, Dim::length, "a node of the MPM grid, for the audit");
    Schema<SordoConfig>::describe(v, c);
  }
};

}  // namespace flowslide
