#include "report/report.hpp"

#include "report/figures.hpp"
#include "workflows/stages/stage_list.hpp"

namespace flowslide {
namespace {

struct ReportStage {
  static constexpr std::string_view name = "report.runout";
  static constexpr std::string_view doc = "Facts, figures, tables and ParaView files of a runout.";
  static constexpr int version = 2;
  static constexpr bool checkpoints = false;
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
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const FemHistory history(in.history.path);
    const LiquefactionZone zone = read_zone(in.zone.path);
    const ParticleSet particles = read_particles(in.particles.path);
    const MpmHistory flow(in.flow.path);
    const ReportFacts facts =
        write_report({history, zone, particles, in.audit.path, flow, context.provenance}, config,
                     out.report.path, context.progress);
    StageResult result{.facts = to_json(facts), .publish = {"report"}};
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
