#include "core/memory.hpp"
#include "transfer/map/map_state.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct MapStage {
  static constexpr std::string_view name = "transfer.map";
  static constexpr std::string_view doc = "Carries the state to material points, with an audit.";
  static constexpr int version = 5;
  static constexpr bool checkpoints = false;
  using Config = MapConfig;
  struct Inputs {
    Artifact<FemHistory> history;
    Artifact<LiquefactionZone> zone;
    void visit(auto&& port) {
      port("history", history);
      port("zone", zone);
    }
  };
  struct Outputs {
    Artifact<ParticleSet> particles{"particles.h5"};
    Artifact<TransferAudit> audit{"audit.json"};
    void visit(auto&& port) {
      port("particles", particles);
      port("audit", audit);
    }
  };
  static void check(const Config& config) { flowslide::check(config); }
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    p.map = config;
    check_transfer_rules(config, found);
    if (!p.section || p.materials.empty()) return p;
    const Soil soil = soil_of(*p.section, config, p.materials);
    found.work = map_work(config, soil);
    check_map_materials(config, p.materials, soil, found);
    check_map_names(config, *p.section, p.materials, p.zone, found);
    check_box(config, soil, found);
    check_memory(config, soil, kUnset, machine_memory(), found);
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const MapResult result =
        map_state(FemHistory(in.history.path), read_zone(in.zone.path), config, context.progress);
    write_particles(out.particles.path, result.particles);
    write_audit(out.audit.path, result.audit);
    const nlohmann::ordered_json facts = {{"particles", result.particles.size()},
                                          {"audit_passed", result.audit.passed()}};
    StageResult stage{.facts = facts.dump(), .publish = {}, .warnings = {}};
    for (const AuditCheck& check : result.audit.checks)
      if (!check.passed())
        stage.warnings.push_back(fmt::format(
            "the audit was not enforced and would have refused this transfer: {} is {:.3g}, limit "
            "{:.3g}.",
            check.name, check.error, check.limit));
    return stage;
  }
};

}  // namespace

StageType map_stage() { return stage_type<MapStage>(); }

}  // namespace flowslide
