#include "workflows/stages/fem_run.hpp"

#include "exporters/opensees_recorders.hpp"
#include "fem/build_model.hpp"
#include "fem/run.hpp"
#include "model/history.hpp"
#include "model/motion_file.hpp"
#include "motion/measures.hpp"
#include "transfer/zone/zone_record.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

/// Follows the scalars of transfer.zone from state to state.
StopRule stop_rule(const SectionMesh& section, const FemRunConfig& run) {
  const std::optional<StopAtTransferConfig>& config = run.stop_at_transfer;
  if (!config) return {};
  struct Watch {
    std::optional<ZoneRecorder> record;
    std::optional<double> settled;  ///< when the choice became final [s]
  };
  const auto watch = std::make_shared<Watch>();
  return {canonical_text(*config),
          [watch, mesh = section.mesh, materials = fem::history_materials(section, run),
           c = *config](const FemFrame& frame) {
            if (!watch->record) {
              watch->record.emplace(mesh, materials, frame, c);
              return false;
            }
            watch->record->append(frame);
            if (!watch->settled && watch->record->is_settled()) watch->settled = frame.time;
            return watch->settled && frame.time >= *watch->settled + c.after * (1.0 - 1e-9);
          }};
}

}  // namespace

std::optional<double> end_of(const FemRunConfig& config, const GroundMotion& motion) {
  if (!config.end_with_motion) return config.end;
  const EndWithMotionConfig& c = *config.end_with_motion;
  const double shaken = arias_time(motion, c.arias) + c.after;
  // A hair's breadth, so that a time that is a state but for rounding is that state.
  const double states = std::ceil(shaken / config.output_interval - 1e-6);
  return std::min(std::max(states, 1.0) * config.output_interval, motion.duration());
}

namespace {

struct FemRun {
  static constexpr std::string_view name = "fem.run";
  static constexpr std::string_view doc =
      "Gravity and shaking of a saturated section, with the finite element method.";
  static constexpr int version = 7;
  static constexpr bool checkpoints = true;
  using Config = FemRunConfig;
  struct Inputs {
    Artifact<SectionMesh> mesh;
    Artifact<GroundMotion> motion;
    void visit(auto&& port) {
      port("mesh", mesh);
      port("motion", motion);
    }
  };
  struct Outputs {
    Artifact<FemHistory> history{"history.h5"};
    void visit(auto&& port) { port("history", history); }
  };
  static void check(const Config& config) {
    flowslide::check(config);
    validate(!config.end || !config.end_with_motion,
             "end and end_with_motion: both are given (one says when the run ends, the other that "
             "the motion does) take one of them away");
    if (config.stop_at_transfer) flowslide::check(*config.stop_at_transfer);
  }
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    check_fem_soils(config, found);
    check_inert(config, found);
    p.stop = config.stop_at_transfer;
    p.shakes = true;
    p.end = config.end ? config.end : p.motion_end;
    p.water = config.water;
    p.fem = std::make_shared<const FemConfig>(config);
    if (p.stop && p.end) check_transfer_time(*p.stop, *p.end, "stop_at_transfer.", found);
    if (!p.section) return p;
    found.work = shaking_work(config, p.section->mesh, p.end, config.stop_at_transfer.has_value());
    check_water(config, p.section->mesh, found);
    check_sides(config, p.section->mesh, found);
    check_recording(config, p.section->mesh, p.end, p.mean_period, found);
    check_waves(config, *p.section, {p.mean_period, p.top_frequency}, found);
    (void)fem::build_model(*p.section, config);  // names, sets and ends against the mesh
    p.materials = fem::history_materials(*p.section, config);
    if (config.stop_at_transfer) try {
        (void)zone_parts(p.section->mesh, p.materials, *config.stop_at_transfer);
      } catch (const InputError& e) {
        throw InputError(fmt::format("stop_at_transfer.{}", e.what()));
      }
    return p;
  }
  static StageResult run(const RunContext& context, Config config, const Inputs& in,
                         const Outputs& out) {
    const SectionMesh section = read_section_mesh(in.mesh.path);
    const GroundMotion motion = read_motion_file(in.motion.path);
    if (config.end_with_motion) config.end = end_of(config, motion);
    const FemFacts f =
        run_fem(section, motion, config, {out.history.path, context.folder / "checkpoint"},
                context.threads, context.progress, stop_rule(section, config));
    nlohmann::ordered_json facts = {{"fem_end_s", f.end_time},
                                    {"fem_stopped_by_displacement", f.stopped},
                                    {"fem_stopped_at_transfer", f.stopped_by_rule},
                                    {"fem_largest_displacement_m", f.largest_displacement},
                                    {"fem_steps", f.steps},
                                    {"fem_smallest_step_s", f.smallest_step},
                                    {"fem_largest_step_s", f.largest_step},
                                    {"fem_out_of_balance", f.out_of_balance},
                                    {"fem_energy_error", f.energy_error},
                                    {"fem_base_work_j", f.base_work},
                                    {"fem_damping_work_j", f.damping_work},
                                    {"fem_kinetic_energy_j", f.kinetic_energy},
                                    {"fem_sub_steps", f.sub_steps},
                                    {"fem_sub_steps_at_floor", f.floored},
                                    {"fem_iterations", f.iterations},
                                    {"fem_most_iterations", f.most_iterations},
                                    {"fem_cut_steps", f.cut_steps},
                                    {"fem_seconds", f.seconds},
                                    {"fem_notes", f.notes}};
    StageResult result{.facts = {}, .publish = {}, .warnings = f.notes};
    const double strong = arias_time(motion, 0.95);
    if (!f.stopped && !f.stopped_by_rule && f.end_time < strong)
      result.warnings.push_back(fmt::format(
          "end: the shaking ends at {:.3g} s, but 95 % of the motion's Arias intensity have come at "
          "{:.3g} s only: what it would still liquefy is left out.",
          f.end_time, strong));
    if (config.opensees_recorders) {
      const std::vector<std::string> lost =
          write_opensees_recorders(context.folder / "recorders", FemHistory(out.history.path));
      facts["fem_recorder_notes"] = lost;
      result.publish.emplace_back("recorders");
    }
    result.facts = facts.dump();
    return result;
  }
};

}  // namespace

StageType fem_run_stage() { return stage_type<FemRun>(); }

}  // namespace flowslide
