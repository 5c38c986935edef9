#include "motion/prepare.hpp"

#include "config/yaml.hpp"
#include "motion/measures.hpp"
#include "motion/write_motion.hpp"
#include "signals.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;
using flowslide::test::harmonic;

namespace {

MotionConfig read_config(const DataFolder& folder, const std::string& text) {
  return read_settings<MotionConfig>(load_yaml(folder.write("motion.yaml", text)), "");
}

}  // namespace

TEST_CASE("a record is processed in the declared order", "[motion]") {
  const DataFolder folder;
  write_motion(folder.path("m.csv"), harmonic(1.0, 2.0, 0.01, 10.0));
  const MotionConfig config = read_config(folder,
                                          "record: m.csv\nunit: m/s2\n"
                                          "baseline: {degree: 1, fit: velocity}\n"
                                          "filter: {high_pass: 0.2 Hz, low_pass: 20 Hz}\n"
                                          "resample: {dt: 5 ms}\n"
                                          "pga: 0.25 g\n");
  CHECK(config.baseline->fit == BaselineFit::velocity);
  const GroundMotion motion = prepare_motion(config);
  CHECK(motion.dt == 0.005);
  CHECK(pga(motion) == 0.25 * kGravity);
  const std::string& o = motion.origin;
  CHECK(o.starts_with("m.csv"));
  CHECK(o.find("baseline") < o.find("Butterworth"));
  CHECK(o.find("Butterworth") < o.find("resampled"));
  CHECK(o.find("resampled") < o.find("scaled"));
}

TEST_CASE("how long a made motion becomes is known before", "[motion]") {
  const DataFolder folder;
  for (const char* text :
       {"preset: loma-prieta-lick\npga: 0.2 g\n",
        "synthetic: {pga: 1 m/s2, tm: 0.4 s, d5_95: 2 s}\nfilter: {high_pass: 0.2 Hz}\n",
        "synthetic: {pga: 1 m/s2, tm: 0.4 s, d5_95: 2 s}\nresample: {dt: 7 ms}\n"}) {
    CAPTURE(text);
    const MotionConfig config = read_config(folder, text);
    const double made = prepare_motion(config).duration();
    const double step = config.resample ? config.resample->dt : 0.0;
    const double known = *made_duration(config);
    CHECK(known >= made * (1.0 - 1e-12));
    CHECK(known <= made * (1.0 + 1e-12) + step);
  }
  CHECK_FALSE(made_duration(read_config(folder, "record: m.csv\nunit: m/s2\n")).has_value());
  CHECK_FALSE(made_duration(read_config(folder,
                                        "preset: loma-prieta-lick\npga: 0.2 g\n"
                                        "filter: {high_pass: 0.2 Hz, keep_padding: true}\n"))
                  .has_value());
}

TEST_CASE("processing that leaves little of a record is told", "[motion]") {
  const DataFolder folder;
  write_motion(folder.path("m.csv"), harmonic(1.0, 2.0, 0.01, 10.0));
  const auto told = [&](const std::string& text) {
    std::vector<std::string> warnings;
    (void)prepare_motion(read_config(folder, "record: m.csv\nunit: m/s2\n" + text), {}, &warnings);
    return fmt::format("{}", fmt::join(warnings, "\n"));
  };
  // A sine of 1 m/s2 at 2 Hz: a band around it keeps it, corners in the wrong place do not.
  CHECK(told("").empty());
  CHECK(told("filter: {high_pass: 0.2 Hz, low_pass: 20 Hz}\npga: 0.3 g\n").empty());
  CHECK_THAT(told("filter: {high_pass: 8 Hz}\npga: 1 m/s2\n"),
             Contains("of the Arias intensity") && Contains("pga scales up"));
  CHECK_THAT(told("filter: {low_pass: 0.5 Hz}\n"), Contains("most of the shaking is gone"));
  CHECK(told("pga: 0.9 g\n").empty());
  CHECK_THAT(told("pga: 11 m/s2\n"), Contains("11 times the peak"));
  CHECK_THAT(told("pga: 9 cm/s2\n"), Contains("0.0902 times the peak"));
}

TEST_CASE("a record without processing stays what it is", "[motion]") {
  const DataFolder folder;
  const GroundMotion sine = harmonic(1.0, 2.0, 0.01, 10.0);
  write_motion(folder.path("m.csv"), sine);
  const GroundMotion motion = prepare_motion(read_config(folder, "record: m.csv\nunit: m/s2\n"));
  CHECK(motion.acceleration == sine.acceleration);
}

TEST_CASE("presets and synthetic motions come from settings", "[motion]") {
  const DataFolder folder;
  const GroundMotion preset =
      prepare_motion(read_config(folder, "preset: loma-prieta-lick\npga: 0.2 g\n"));
  CHECK(preset.acceleration ==
        synthesize(preset_config("loma-prieta-lick", 0.2 * kGravity)).acceleration);
  const GroundMotion synthetic = prepare_motion(
      read_config(folder, "synthetic: {pga: 1 m/s2, tm: 0.4 s, d5_95: 8 s, seed: 3}\n"));
  CHECK(pga(synthetic) == 1.0);
  CHECK(mean_period(synthetic) == Approx(0.4).epsilon(3e-3));
}

TEST_CASE("settings of a motion that contradict are refused", "[motion]") {
  const DataFolder folder;
  const auto problem = [&](const std::string& text) {
    try {
      check(read_config(folder, text));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(problem("pga: 0.3 g\n"), Contains("0 of record, preset and synthetic"));
  CHECK_THAT(problem("record: a.at2\npreset: corinth\npga: 0.3 g\n"), Contains("2 of record"));
  CHECK_THAT(problem("preset: corinth\n"), Contains("without pga"));
  CHECK_THAT(problem("preset: corint\npga: 0.3 g\n"),
             Contains("preset: there is no motion 'corint'") && Contains("did you mean 'corinth'"));
  CHECK_THAT(problem("preset: tabas\npga: 0.3 g\n"), Contains("did you mean 'tabas-dayhook'"));
  CHECK_THAT(problem("preset: kobe\npga: 0.3 g\n"), Contains("one of: ") && !Contains("did you"));
  CHECK_THAT(problem("preset: corinth\npga: 1e6 g\n"),
             Contains(":2:6: pga: '1e6 g' is out of range"));
  CHECK_THAT(problem("record: a.at2\nfilter: {order: 2}\n"), Contains("filter: has no high_pass"));
  CHECK_THAT(problem("record: a.at2\npga: 0.3\n"), Contains("no unit"));
  CHECK_THAT(problem("synthetic: {tm: 0.4 s, d5_95: 8 s}\n"), Contains("pga"));
}

TEST_CASE("corners that leave nothing are refused before a motion is made", "[motion]") {
  const DataFolder folder;
  const auto refusal = [&](const std::string& filter) {
    const MotionConfig config =
        read_config(folder, "preset: tabas-dayhook\npga: 0.3 g\nfilter: " + filter + "\n");
    try {
      check(config);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(refusal("{high_pass: 0.1 Hz, low_pass: 25 Hz}").empty());
  CHECK_THAT(refusal("{high_pass: 25 Hz, low_pass: 0.1 Hz}"),
             Contains("filter.high_pass: 25 Hz is not below low_pass, 0.1 Hz"));
  CHECK_THAT(refusal("{low_pass: 25 kHz}"),
             Contains("filter.low_pass: 25000 Hz is not below 50 Hz"));
}
