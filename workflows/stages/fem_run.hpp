#pragma once
#include "fem/config.hpp"
#include "model/ground_motion.hpp"
#include "transfer/zone/stop_config.hpp"

#include <optional>

namespace flowslide {

/// When a motion has shaken: docs/guide/motions.md.
struct EndWithMotionConfig {
  double arias = 0.995;  ///< share of the Arias intensity [-]
  double after = 2.0;    ///< [s]
};

/// Settings of the stage fem.run: those of the run, and what it takes from modules above fem.
struct FemRunConfig : FemConfig {
  std::optional<EndWithMotionConfig> end_with_motion;
  std::optional<StopAtTransferConfig> stop_at_transfer;
  bool opensees_recorders = false;
};

template <>
struct Schema<EndWithMotionConfig> {
  static constexpr std::string_view doc =
      "The run ends where the motion has shaken: a share of its Arias intensity has come, and a "
      "while has passed. In place of end.";
  static void describe(FieldVisitor& v, EndWithMotionConfig& c) {
    v.quantity("arias", c.arias, Dim::none, {.max = 1.0, .above = 0.0},
               "share of the Arias intensity of the motion");
    v.quantity(
        "after", c.after, Dim::time, {.min = 0.0},
        "time after that, for a failure that the last of the shaking sets off to show; up to "
        "the next recorded state, and not beyond the motion");
  }
};

template <>
struct Schema<FemRunConfig> {
  static constexpr std::string_view doc = Schema<FemConfig>::doc;
  static void describe(FieldVisitor& v, FemRunConfig& c) {
    Schema<FemConfig>::describe(v, c);
    v.group("end_with_motion", c.end_with_motion, Schema<EndWithMotionConfig>::doc);
    v.group("stop_at_transfer", c.stop_at_transfer, Schema<StopAtTransferConfig>::doc);
    v.flag("opensees_recorders", c.opensees_recorders,
           "write the folder recorders too: text files with the names, columns and units (m, s, "
           "kPa) of scripts around OpenSees");
  }
};

/// End of the run [s], where `end_with_motion` says it.
std::optional<double> end_of(const FemRunConfig& config, const GroundMotion& motion);

}  // namespace flowslide
