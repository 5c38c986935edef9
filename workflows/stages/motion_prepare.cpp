#include "model/motion_file.hpp"
#include "motion/foreign.hpp"
#include "motion/measures.hpp"
#include "motion/prepare.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

/// Share of a motion's energy that a mesh has to carry.
constexpr double kMostEnergy = 0.8;
/// Frequency below which that share lies, times the mean period: 1.9 to 4.0 for the presets, 2.7 in
/// the mean.
constexpr double kMostEnergyOfMade = 2.7;

struct MotionPrepareStage {
  static constexpr std::string_view name = "motion.prepare";
  static constexpr std::string_view doc =
      "Reads or synthesises a ground motion, processes it and scales it.";
  static constexpr int version = 5;
  static constexpr bool checkpoints = false;
  using Config = MotionConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<GroundMotion> motion{"motion.h5"};
    void visit(auto&& port) { port("motion", motion); }
  };
  static void check(const Config& config) { flowslide::check(config); }
  /// Reading a record takes less than a second; making a motion takes longer and opens no file.
  static std::any preview(const Config& config, const Previews&, Findings& found) {
    Preview p;
    if (config.record) {
      const GroundMotion motion = prepare_motion(config, {}, &found.warnings);
      p.motion_end = motion.duration();
      p.mean_period = mean_period(motion);
      p.top_frequency = frequency_below(motion, kMostEnergy);
    } else {
      p.motion_end = made_duration(config);
      p.mean_period =
          config.preset ? preset_config(*config.preset, *config.pga).tm : config.synthetic->tm;
      p.top_frequency = kMostEnergyOfMade / *p.mean_period;
      if (config.filter && config.filter->low_pass)
        p.top_frequency = std::min(*p.top_frequency, *config.filter->low_pass);
      const double peak = config.pga ? *config.pga : config.synthetic->pga;
      found.warnings = implausible("", peak, kUnset);
    }
    found.work = motion_work();
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs&,
                         const Outputs& out) {
    std::vector<std::string> warnings;
    const GroundMotion motion = prepare_motion(config, context.progress, &warnings);
    write_motion_file(out.motion.path, motion);
    const MotionMeasures m = measure(motion, context.progress);
    const nlohmann::ordered_json facts = {{"motion_pga_m_s2", m.pga},
                                          {"motion_pgv_m_s", m.pgv},
                                          {"motion_arias_m_s", m.arias},
                                          {"motion_d5_95_s", m.d5_95},
                                          {"motion_tm_s", m.tm},
                                          {"motion_cav_m_s", m.cav},
                                          {"motion_masi_m_s", m.masi},
                                          {"motion_dt_s", motion.dt},
                                          {"motion_duration_s", motion.duration()}};
    return {.facts = facts.dump(), .publish = {}, .warnings = std::move(warnings)};
  }
};

}  // namespace

StageType motion_prepare_stage() { return stage_type<MotionPrepareStage>(); }

}  // namespace flowslide
