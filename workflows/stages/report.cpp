#include "report/report.hpp"

#include "report/figures.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"

#include <cmath>

namespace flowslide {
namespace {

struct ReportStage {
  static constexpr std::string_view name = "report.runout";
  static constexpr std::string_view doc = "Facts, figures, tables and ParaView files of a runout.";
  static constexpr int version = 3;
  static constexpr bool checkpoints = false;
  static constexpr bool reads_warnings = true;
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
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    if (p.flow && p.flow->extrude)
      found.errors.emplace_back(
          "the runout has three dimensions (the report draws sections) take this stage out of the "
          "workflow, and `flowslide convert` mpm.h5 for ParaView, docs/guide/valley.md");
    for (const auto& [name, region] : config.regions)
      if (region.outline.size() < 3)
        found.errors.push_back(fmt::format(
            "regions.{}: {} corners (a region needs three or more) give its outline", name,
            region.outline.size()));
    if (p.flow && config.toe &&
        std::abs(*config.toe - p.flow->toe) > 1e-9 * (1.0 + std::abs(p.flow->toe)))
      found.warnings.push_back(fmt::format(
          "toe: x = {:g} m, but the runout stage has {:g} m: its time series counts from there.",
          *config.toe, p.flow->toe));
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const FemHistory history(in.history.path);
    const LiquefactionZone zone = read_zone(in.zone.path);
    const ParticleSet particles = read_particles(in.particles.path);
    const MpmHistory flow(in.flow.path);
    const ReportFacts facts = write_report({history, zone, particles, in.audit.path, flow,
                                            context.provenance, context.warnings},
                                           config, out.report.path, context.progress);
    StageResult result{.facts = to_json(facts), .publish = {"report"}, .warnings = facts.warnings};
    for (const char* file : {"report/flow.pvd", "report/zone.pvd"})
      if (std::filesystem::exists(context.folder / file)) result.publish.emplace_back(file);
    if (config.figures) {
      std::filesystem::create_directories(context.folder / "plot");
      result.give = write_plot_scripts(context.folder / "plot");
    }
    return result;
  }
};

}  // namespace

StageType report_stage() { return stage_type<ReportStage>(); }

}  // namespace flowslide
