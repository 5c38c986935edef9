#pragma once
#include "config/schema.hpp"
#include "motion/butterworth.hpp"
#include "motion/process.hpp"
#include "motion/record.hpp"
#include "motion/synthetic.hpp"

#include <optional>
#include <string>

/// A ground motion from settings: a record, a preset or a synthetic motion, then baseline, filter,
/// resampling and, last, scaling, so that the peak acceleration is the one that was asked for.
namespace flowslide {

struct BaselineConfig {
  int degree = 1;
  BaselineFit fit = BaselineFit::acceleration;
};

struct ResampleConfig {
  double dt = kUnset;  ///< [s]
  ResampleMethod method = ResampleMethod::band_limited;
};

struct MotionConfig {
  std::optional<InputFile> record;
  RecordFormat format;  ///< of the record
  std::optional<std::string> preset;
  std::optional<SyntheticConfig> synthetic;
  std::optional<BaselineConfig> baseline;
  std::optional<BandPass> filter;
  std::optional<ResampleConfig> resample;
  std::optional<double> pga;  ///< [m/s2]; needed with preset, as recorded if left out otherwise
};

/// Exactly one of record, preset and synthetic. Throws InputError.
void check(const MotionConfig& config);

/// Throws FileError, InputError, NumericsError, Interrupted. What is odd about the result is
/// appended to `warnings`.
GroundMotion prepare_motion(const MotionConfig& config, const Progress& progress = {},
                            std::vector<std::string>* warnings = nullptr);

/// How long a preset or synthetic motion becomes, without making it [s]; resampling may cut less
/// than one of its steps off. Empty for records and where only making it would tell. Throws
/// InputError.
std::optional<double> made_duration(const MotionConfig& config);

template <>
struct Schema<MotionConfig> {
  static constexpr std::string_view doc =
      "A ground motion: exactly one of `record`, `preset` and `synthetic`, then its processing in "
      "the order baseline, filter, resample, pga.";
  static void describe(FieldVisitor& v, MotionConfig& c);
};

}  // namespace flowslide
