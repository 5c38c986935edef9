#include "transfer/zone.hpp"

#include "workflows/stages/stage_list.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct ZoneStage {
  static constexpr std::string_view name = "transfer.zone";
  static constexpr std::string_view doc = "Finds the liquefied zone and the time of transfer.";
  static constexpr int version = 2;
  static constexpr bool checkpoints = false;
  using Config = ZoneConfig;
  struct Inputs {
    Artifact<FemHistory> history;
    void visit(auto&& port) { port("history", history); }
  };
  struct Outputs {
    Artifact<LiquefactionZone> zone{"zone.h5"};
    void visit(auto&& port) { port("zone", zone); }
  };
  static void check(const Config& config) { flowslide::check(config); }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const LiquefactionZone zone = find_zone(FemHistory(in.history.path), config, context.progress);
    write_zone(out.zone.path, zone);
    nlohmann::ordered_json facts = {{"transfer_time_s", zone.transfer_time},
                                    {"transfer_reason", zone.transfer_reason}};
    for (std::size_t i = 0; i < zone.window_names.size(); ++i)
      facts["liquefaction_depth_" + zone.window_names[i] + "_m"] = zone.window_depth_max[i];
    facts["zone_notes"] = zone.notes;
    return {.facts = facts.dump(), .publish = {}};
  }
};

}  // namespace

StageType zone_stage() { return stage_type<ZoneStage>(); }

}  // namespace flowslide
