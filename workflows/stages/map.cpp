#include "transfer/map_state.hpp"
#include "workflows/stages/stage_list.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct MapStage {
  static constexpr std::string_view name = "transfer.map";
  static constexpr std::string_view doc = "Carries the state to material points, with an audit.";
  static constexpr int version = 1;
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
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const MapResult result =
        map_state(FemHistory(in.history.path), read_zone(in.zone.path), config, context.progress);
    write_particles(out.particles.path, result.particles);
    write_audit(out.audit.path, result.audit);
    const nlohmann::ordered_json facts = {{"particles", result.particles.size()},
                                          {"audit_passed", result.audit.passed()}};
    return {.facts = facts.dump(), .publish = {}};
  }
};

}  // namespace

StageType map_stage() { return stage_type<MapStage>(); }

}  // namespace flowslide
