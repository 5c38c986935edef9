#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Synthetic ground motions with given intensity, period and duration, for use where a record may
/// not be passed on. Equal settings give equal samples. Theory in docs/theory/ground-motion.md.
namespace flowslide {

struct SyntheticConfig {
  double pga = kUnset;     ///< reached exactly [m/s2]
  double tm = kUnset;      ///< mean period, reached within 0.2 % [s]
  double d5_95 = kUnset;   ///< significant duration, reached within 0.2 % [s]
  double dt = 0.01;        ///< [s]
  int seed = 1;            ///< another seed is another motion of the same measures
  double bandwidth = 0.6;  ///< damping of the Kanai-Tajimi spectrum; larger: broader spectrum
  double corner = 0.1;     ///< corner frequency of the source over that of the ground
  double kappa = 0.02;     ///< decay of high frequencies, exp(-pi kappa f) [s]
  double rise = 2.0;       ///< exponent of the envelope; smaller: sharper onset, longer coda
  double lead = 1.0;       ///< quiet time before the shaking [s]
  /// Strong phase: the envelope is raised by strong_ratio times its own peak from begin to end,
  /// both or neither given [s].
  std::optional<double> strong_begin, strong_end;
  double strong_ratio = 3.0;
};

/// Throws InputError for settings out of range; NumericsError if the measures cannot be reached
/// together.
GroundMotion synthesize(const SyntheticConfig& config, const Progress& progress = {});

/// Of the motion that synthesize() makes [s]. Throws InputError for settings out of range.
double synthetic_duration(const SyntheticConfig& config);

/// A motion of the parametric study of Sordo, Rathje and Kumar (2025), Table 4: what the paper
/// gives for the record, and the settings whose motion resembles it.
struct MotionPreset {
  std::string_view name;
  std::string_view record;
  double tm = kUnset;     ///< [s]
  double d5_95 = kUnset;  ///< [s]
  double pgv = kUnset;    ///< at 0.3 g [m/s]; NaN where the paper gives none
  double masi = kUnset;   ///< at 0.3 g [m/s]; NaN where the paper gives none
  int seed = 1;
  double bandwidth = 0.6;
  double lead = 1.0;                                  ///< [s]
  std::optional<double> strong_begin = std::nullopt;  ///< [s]
  std::optional<double> strong_end = std::nullopt;    ///< [s]
  double strong_ratio = 3.0;
};

std::span<const MotionPreset> motion_presets();

/// Settings of a preset at a peak acceleration [m/s2]. Throws InputError with the known names.
SyntheticConfig preset_config(std::string_view name, double pga);

}  // namespace flowslide
