#pragma once
#include "fem/config.hpp"
#include "transfer/zone/stop_config.hpp"

#include <optional>

namespace flowslide {

/// Settings of the stage fem.run: those of the run, and what it takes from modules above fem.
struct FemRunConfig : FemConfig {
  std::optional<StopAtTransferConfig> stop_at_transfer;
  bool opensees_recorders = false;
};

template <>
struct Schema<FemRunConfig> {
  static constexpr std::string_view doc = Schema<FemConfig>::doc;
  static void describe(FieldVisitor& v, FemRunConfig& c) {
    Schema<FemConfig>::describe(v, c);
    v.group("stop_at_transfer", c.stop_at_transfer, Schema<StopAtTransferConfig>::doc);
    v.flag("opensees_recorders", c.opensees_recorders,
           "write the folder recorders too: text files with the names, columns and units (m, s, "
           "kPa) of scripts around OpenSees");
  }
};

}  // namespace flowslide
