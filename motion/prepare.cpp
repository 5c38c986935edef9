#include "motion/prepare.hpp"

#include "core/conventions.hpp"
#include "motion/foreign.hpp"
#include "motion/measures.hpp"

#include <utility>

namespace flowslide {

namespace {

/// Far beyond any earthquake on both sides: what is outside is a wrong unit [m/s2].
constexpr Range kPeaks{.min = 1e-6, .max = 1e3};

}  // namespace

template <>
struct Schema<SyntheticConfig> {
  static constexpr std::string_view doc = "A synthetic motion with given measures.";
  static void describe(FieldVisitor& v, SyntheticConfig& c) {
    v.quantity("pga", c.pga, Dim::acceleration, kPeaks, "peak acceleration, exact");
    v.quantity("tm", c.tm, Dim::time, {.min = 0.1, .max = 2.0}, "mean period, within 0.2 %");
    v.quantity("d5_95", c.d5_95, Dim::time, {.min = 1.0, .max = 200.0},
               "significant duration, within 0.2 %");
    v.quantity("dt", c.dt, Dim::time, {.min = 1e-4, .max = 0.02}, "time step");
    v.integer("seed", c.seed, {}, "another seed is another motion with the same measures");
    v.quantity("bandwidth", c.bandwidth, Dim::none, {.min = 0.1, .max = 2.0},
               "damping of the ground filter; larger is a broader spectrum");
    v.quantity("corner", c.corner, Dim::none, {.min = 0.02, .max = 1.0},
               "corner frequency of the source over the frequency of the ground filter");
    v.quantity("kappa", c.kappa, Dim::time, {.min = 0.0, .max = 0.2}, "decay of high frequencies");
    v.quantity("rise", c.rise, Dim::none, {.min = 0.5, .max = 10.0},
               "exponent of the envelope; smaller is a sharper onset and a longer coda");
    v.quantity("lead", c.lead, Dim::time, {.min = 0.0, .max = 600.0},
               "quiet time before the shaking");
    v.quantity("strong_begin", c.strong_begin, Dim::time, {.min = 0.0}, "begin of a strong phase");
    v.quantity("strong_end", c.strong_end, Dim::time, {.min = 0.0}, "its end");
    v.quantity("strong_ratio", c.strong_ratio, Dim::none, {.min = 0.0, .max = 100.0},
               "how much it raises the envelope, over the peak of the rest");
  }
};

template <>
struct Schema<BaselineConfig> {
  static constexpr std::string_view doc = "Baseline correction by a polynomial.";
  static void describe(FieldVisitor& v, BaselineConfig& c) {
    v.integer("degree", c.degree, {.min = 0, .max = 8}, "of what is taken off the acceleration");
    v.choice("fit", c.fit, kBaselineFits,
             "fit the acceleration, or the velocity with v(0) = 0 and take off the derivative");
  }
};

template <>
struct Schema<BandPass> {
  static constexpr std::string_view doc = "Butterworth filter.";
  static void describe(FieldVisitor& v, BandPass& c) {
    v.quantity("high_pass", c.high_pass, Dim::frequency, {.above = 0.0}, "lower corner");
    v.quantity("low_pass", c.low_pass, Dim::frequency, {.above = 0.0}, "upper corner");
    v.integer("order", c.order, {.min = 1, .max = 10}, "of each corner and pass");
    v.choice("phase", c.phase, kFilterPhases, "forward and backward, or forward only");
    v.flag("keep_padding", c.keep_padding,
           "keep the quiet time into which the filter rings, so that displacement stays sound");
  }
};

template <>
struct Schema<ResampleConfig> {
  static constexpr std::string_view doc = "Another time step.";
  static void describe(FieldVisitor& v, ResampleConfig& c) {
    v.quantity("dt", c.dt, Dim::time, {.above = 0.0}, "new time step");
    v.choice("method", c.method, kResampleMethods,
             "straight lines, or a windowed sinc that keeps all frequencies both steps can hold");
  }
};

void Schema<MotionConfig>::describe(FieldVisitor& v, MotionConfig& c) {
  v.file("record", c.record, "PEER AT2, or columns of text or CSV; plain or gzip");
  v.text("unit", c.format.unit,
         "unit of acceleration in a record that does not state it: g, cm/s2, m/s2");
  v.quantity("dt", c.format.dt, Dim::time, {.above = 0.0}, "time step of a record of one column");
  v.integer(
      "time_column", c.format.time_column, {.min = 0},
      "column of time, counted from 1; 0: the first of two, and with acceleration_column none");
  v.integer("acceleration_column", c.format.acceleration_column, {.min = 0},
            "column of acceleration, counted from 1; 0: the only one or the second of two; a wider "
            "file needs it");
  v.flag("accept_count", c.format.accept_count,
         "use an AT2 file whose number of values is not its NPTS");
  v.text("preset", c.preset, "synthetic stand-in for a motion of Table 4 of the paper, by name");
  v.group("synthetic", c.synthetic, "a synthetic motion with given measures");
  v.group("baseline", c.baseline, "baseline correction");
  v.group("filter", c.filter, "band-pass, high-pass or low-pass");
  v.group("resample", c.resample, "another time step");
  v.quantity("pga", c.pga, Dim::acceleration, kPeaks,
             "peak acceleration to which the result is scaled");
}

namespace {

/// What can be said of the corners before the motion is there.
void check_corners(const MotionConfig& config) {
  const std::optional<double>&low = config.filter->high_pass, &high = config.filter->low_pass;
  validate(!low || !high || *low < *high,
           "filter.high_pass: {:g} Hz is not below low_pass, {:g} Hz (nothing would remain) swap "
           "them",
           low.value_or(0.0), high.value_or(0.0));
  if (config.record) return;  // its step is in the file
  const double dt =
      config.preset ? preset_config(*config.preset, *config.pga).dt : config.synthetic->dt;
  for (const auto& [name, corner] : {std::pair("high_pass", low), std::pair("low_pass", high)})
    validate(
        !corner || *corner < 0.5 / dt,
        "filter.{}: {:g} Hz is not below {:g} Hz, the highest frequency in steps of {:g} s. Is "
        "the unit right?",
        name, corner.value_or(0.0), 0.5 / dt, dt);
}

}  // namespace

void check(const MotionConfig& config) {
  const int sources = int{config.record.has_value()} + int{config.preset.has_value()} +
                      int{config.synthetic.has_value()};
  validate(sources == 1, "{} of record, preset and synthetic are given (exactly one is needed)",
           sources);
  validate(!config.preset || config.pga,
           "preset: '{}' without pga (a preset has a shape, no size) add e.g. 'pga: 0.3 g'",
           config.preset.value_or(""));
  if (config.preset) preset_config(*config.preset, *config.pga);
  validate(!config.filter || config.filter->high_pass || config.filter->low_pass,
           "filter: has no high_pass and no low_pass (nothing would be filtered)");
  if (config.filter) check_corners(config);
}

namespace {

/// Refuses steps and lengths that no earthquake has, before anything is computed with them.
void check_size(const GroundMotion& motion) {
  constexpr double kShortest = 1e-5, kLongest = 10.0;  // [s]
  check(motion);
  validate(motion.dt >= kShortest && motion.dt <= kLongest,
           "{}: a time step of {:g} s is not between {:g} s and {:g} s, where those of records "
           "lie. Is its unit right?",
           motion.origin, motion.dt, kShortest, kLongest);
  validate(static_cast<double>(motion.acceleration.size()) <= kMostSamples,
           "{}: {} samples (at most {:g} are processed) cut the record or resample it",
           motion.origin, motion.acceleration.size(), kMostSamples);
}

/// Scaling by more than this, up or down, makes another earthquake of a record.
constexpr double kMostScaled = 10.0;

/// What filtering and another step took from a motion, and what scaling made of it.
std::vector<std::string> much_changed(double arias_before, const GroundMotion& processed,
                                      std::optional<double> wanted) {
  constexpr double kLeastLeft = 0.5;
  std::vector<std::string> odd;
  const double left = arias_intensity(processed) / arias_before;
  if (left < kLeastLeft)
    odd.push_back(fmt::format(
        "filter and resample leave {:.2g} of the Arias intensity: most of the shaking is gone{}. "
        "Are the corners and the step right?",
        left, wanted ? ", and pga scales up what is left" : ""));
  if (!wanted) return odd;
  const double factor = *wanted / pga(processed);
  if (factor > kMostScaled || factor * kMostScaled < 1.0)
    odd.push_back(fmt::format(
        "pga: {:.3g} g is {:.3g} times the peak of what it scales, {:.3g} g. Scaled by so much it is "
        "the shaking of another earthquake, too short or too long for its size; is the unit right?",
        *wanted / kGravity, factor, pga(processed) / kGravity));
  return odd;
}

}  // namespace

GroundMotion prepare_motion(const MotionConfig& config, const Progress& progress,
                            std::vector<std::string>* warnings) {
  check(config);
  GroundMotion motion = config.record ? read_record(config.record->path, config.format).motion
                        : config.preset
                            ? synthesize(preset_config(*config.preset, *config.pga), progress)
                            : synthesize(*config.synthetic, progress);
  check_size(motion);
  if (config.baseline)
    motion = baseline_corrected(motion, config.baseline->degree, config.baseline->fit);
  const double arias = arias_intensity(motion);
  if (config.filter) motion = filtered(motion, *config.filter, progress);
  if (config.resample)
    motion = resampled(motion, config.resample->dt, config.resample->method, progress);
  check_size(motion);
  const bool changed = config.baseline || config.filter || config.resample;
  if (warnings)
    for (std::string& odd : much_changed(arias, motion, config.pga))
      warnings->push_back(std::move(odd));
  if (config.pga && (config.record || config.synthetic || changed))
    motion = scaled_to_pga(motion, *config.pga);
  if (warnings) {
    for (std::string& odd : implausible("", pga(motion), motion.dt))
      warnings->push_back(std::move(odd));
    if (std::string odd = implausible_velocity("", motion); !odd.empty())
      warnings->push_back(std::move(odd));
  }
  return motion;
}

std::optional<double> made_duration(const MotionConfig& config) {
  if (config.record) return std::nullopt;
  if (config.filter && config.filter->keep_padding) return std::nullopt;
  return synthetic_duration(config.preset ? preset_config(*config.preset, *config.pga)
                                          : *config.synthetic);
}

}  // namespace flowslide
