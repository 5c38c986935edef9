#include "report/report.hpp"

#include "core/files.hpp"
#include "model/motion_file.hpp"
#include "report/check_config.hpp"
#include "report/figures.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>

namespace flowslide {
namespace {

/// UTC; SOURCE_DATE_EPOCH, where it is set, makes reports of the same results the same bytes.
std::string date_of_today() {
  std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH"))
    now = static_cast<std::time_t>(std::strtoll(fixed, nullptr, 10));
  std::tm day{};
  gmtime_r(&now, &day);
  return fmt::format("{:04}-{:02}-{:02}", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
}

std::vector<Headline> headlines(const ReportFacts& f) {
  Headline runout{"runout_m", "runout", "m"};
  // How far the front stopped before the toe says whether the toe is the right one.
  if (f.runout == 0.0)
    runout.note = fmt::format("the front, at x = {:.4g} m, is {:.4g} m short of the toe", f.front,
                              f.toe - f.front);
  std::vector<Headline> all{std::move(runout)};
  for (const auto& [window, depth] : f.liquefaction_depth)
    all.push_back({"liquefaction_depth_" + window + "_m",
                   "liquefaction depth, " + window_label(window), "m"});
  all.push_back({"transfer_time_s", "transfer at", "s"});
  all.push_back({"mass_error", "mass error"});
  all.push_back({"energy_error", "energy error"});
  return all;
}

/// Motion of the first stage before the report that has one, if it was kept.
std::optional<GroundMotion> motion_of(const std::vector<EarlierStage>& stages) {
  for (const EarlierStage& stage : stages)
    if (const auto out = stage.outputs.find("motion");
        out != stage.outputs.end() && is_there(out->second.path))
      return read_motion_file(out->second.path);
  return std::nullopt;
}

struct ReportStage {
  static constexpr std::string_view name = "report.runout";
  static constexpr std::string_view doc = "Facts, figures, tables and ParaView files of a runout.";
  static constexpr int version = 7;
  static constexpr bool checkpoints = false;
  static constexpr bool reads_warnings = true;
  static constexpr bool reads_earlier = true;
  static constexpr bool dated = true;
  using Config = ReportConfig;
  struct Inputs {
    Artifact<FemHistory> history;
    Artifact<LiquefactionZone> zone;
    Artifact<ParticleSet> particles;
    Artifact<TransferAudit> audit;
    Artifact<MpmHistory> flow;
    void visit(auto&& port) {
      port("history", history);
      port("zone", zone);
      port("particles", particles);
      port("audit", audit);
      port("flow", flow);
    }
  };
  struct Outputs {
    Artifact<ReportFolder> report{"report"};
    void visit(auto&& port) { port("report", report); }
  };
  static std::vector<std::string> programs(const Config& config) {
    if (!config.figures || !config.python) return {};
    return {*config.python};
  }
  static void check(const Config& config) { flowslide::check(config); }
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    p.toe = config.toe;
    found.work = report_work(config);
    check_limits(config, found);
    if (p.flow && p.flow->extrude)
      found.errors.emplace_back(
          "the runout has three dimensions (the report draws sections) take this stage out of the "
          "workflow, and `flowslide convert` mpm.h5 for ParaView, docs/guide/valley.md");
    for (const auto& [region_name, region] : config.regions)
      check_region(region_name, region, p.section ? p.section->mesh : QuadMesh{}, found);
    if (config.pond && p.section)
      check_freeboard(*config.pond, p.section->mesh,
                      p.zone ? std::optional(p.zone->pond_surface) : std::nullopt, found);
    if (config.toe && p.flow && p.map && p.section && !p.materials.empty())
      check_toe(*config.toe, *p.flow, soil_of(*p.section, *p.map, p.materials), found);
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const FemHistory history(in.history.path);
    const LiquefactionZone zone = read_zone(in.zone.path);
    const ParticleSet particles = read_particles(in.particles.path);
    const MpmHistory flow(in.flow.path);
    ReportInputs inputs{.history = history,
                        .zone = zone,
                        .particles = particles,
                        .audit = in.audit.path,
                        .flow = flow,
                        .provenance = context.provenance,
                        .warnings = context.warnings,
                        .motion = motion_of(context.earlier),
                        .date = date_of_today()};
    for (const EarlierStage& s : context.earlier)
      inputs.stages.push_back({s.name, s.uses, s.settings, s.facts});
    const ReportFacts facts = write_report(inputs, config, out.report.path, context.progress);
    StageResult result{.facts = to_json(facts),
                       .publish = {"report"},
                       .warnings = facts.warnings,
                       .headlines = headlines(facts)};
    for (const char* file : {"report/flow.pvd", "report/zone.pvd"})
      if (is_there(context.folder / file)) result.publish.emplace_back(file);
    if (config.figures) {
      make_folders(context.folder / "plot");
      result.give = write_plot_scripts(context.folder / "plot");
    }
    return result;
  }
};

}  // namespace

StageType report_stage() { return stage_type<ReportStage>(); }

}  // namespace flowslide
