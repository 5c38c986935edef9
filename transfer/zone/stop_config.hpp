#pragma once
#include "transfer/zone/zone_config.hpp"

#include <string_view>

namespace flowslide {

/// When a run that feeds the transfer may end: with the settings of transfer.zone that decide the
/// time, the run ends once no later state can change it.
struct StopAtTransferConfig : TransferRuleConfig {
  double after = 0.0;  ///< time recorded beyond that [s]
};

/// Throws InputError, also for a rule that can be settled at rest or never.
void check(const StopAtTransferConfig& config);

template <>
struct Schema<StopAtTransferConfig> {
  static constexpr std::string_view doc =
      "The run ends at the first recorded state from which on no later one can change the time of "
      "transfer. The settings of transfer.zone, best by a reference, stop_at_transfer: "
      "\"${stages.zone.with}\"; what they say of the zone itself has no part in this.";
  static void describe(FieldVisitor& v, StopAtTransferConfig& c);
};

}  // namespace flowslide
