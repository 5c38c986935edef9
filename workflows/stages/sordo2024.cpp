#include "transfer/sordo2024/map_sordo2024.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct Sordo2024Stage {
  static constexpr std::string_view name = "transfer.sordo2024";
  static constexpr std::string_view doc =
      "Carries the state to material points as the published script of Sordo et al. (2024) does.";
  static constexpr int version = 2;
  static constexpr bool checkpoints = false;
  using Config = SordoTransferConfig;
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
  static std::any preview(const Config& config, const Previews& in, Findings&) {
    Preview p = merged(in);
    if (p.materials.empty()) return p;
    for (const auto& [key, material] : {std::pair{"tailings", config.soils.tailings},
                                        std::pair{"embankment", config.soils.embankment},
                                        std::pair{"foundation", config.soils.foundation}})
      (void)find_material(p.materials, material, key);
    return p;
  }
  static StageResult run(const RunContext&, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const SordoResult result =
        map_sordo2024_audited(FemHistory(in.history.path), read_zone(in.zone.path), config);
    write_particles(out.particles.path, result.particles);
    write_audit(out.audit.path, result.audit);
    const nlohmann::ordered_json facts = {{"particles", result.particles.size()}};
    return {.facts = facts.dump(), .publish = {}};
  }
};

}  // namespace

StageType sordo2024_stage() { return stage_type<Sordo2024Stage>(); }

}  // namespace flowslide
