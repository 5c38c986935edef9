#include "transfer/zone/zone.hpp"

#include "transfer/zone/zone_record.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

/// How notes begin that the user is to read before the numbers.
constexpr std::array<std::string_view, 4> kTold{"r_u reaches", "automatic.", "dry soil",
                                                "most of the zone"};

std::vector<std::string> zone_warnings(const LiquefactionZone& zone, const ZoneConfig& config) {
  std::size_t liquefied = 0, strong = 0;
  for (std::size_t e = 0; e < zone.liquefied.size(); ++e) {
    if (zone.liquefied[e] == 0) continue;
    ++liquefied;
    strong += zone.strength[e] > zone.sigma_v0[e];
  }
  std::vector<std::string> warnings;
  for (const std::string& note : zone.notes)
    if (std::ranges::any_of(kTold, [&](std::string_view begin) { return note.starts_with(begin); }))
      warnings.push_back(note + ".");
  if (liquefied == 0)
    warnings.push_back("no element has liquefied at the transfer: nothing weakens the dam." +
                       how_near(zone, config.r_u));
  constexpr double kSome = 0.05;
  if (static_cast<double>(strong) > kSome * static_cast<double>(liquefied))
    warnings.push_back(
        fmt::format("{} of {} liquefied elements have a residual strength above their initial "
                    "vertical effective stress: no sand has.",
                    strong, liquefied));
  return warnings;
}

void add_depths(nlohmann::ordered_json& facts, const LiquefactionZone& zone, std::size_t i) {
  const std::string name = "liquefaction_depth_" + zone.window_names[i];
  facts[name + "_m"] = zone.window_depth_max[i];
  facts[name + "_any_node_m"] = zone.window_depth_any[i];
  facts[name + "_interpolated_m"] = zone.window_depth_interpolated[i];
  facts[name + "_strong_shaking_m"] = zone.window_depth_strong[i];
  facts[name + "_before_slide_m"] = zone.window_depth_before_slide[i];
}

struct ZoneStage {
  static constexpr std::string_view name = "transfer.zone";
  static constexpr std::string_view doc = "Finds the liquefied zone and the time of transfer.";
  static constexpr int version = 9;
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
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    check_strength(config.strength, found);
    check_r_u(config.r_u, found);
    if (p.stop) compare_transfer_rules(*p.stop, config, found);
    p.zone = config;
    const bool told = p.stop && p.stop->transfer.at == config.transfer.at;
    if (!told && p.end) check_transfer_time(config, *p.end, "", found);
    if (!p.section) return p;
    found.work = zone_work(p.section->mesh, p.shakes, p.end);
    if (p.materials.empty()) return p;
    (void)zone_parts(p.section->mesh, p.materials, config);
    check_pond(config, p.section->mesh, p.materials, found);
    if (p.fem && found_from_r_u(config.zone)) check_liquefiable(*p.fem, config, *p.section, found);
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const LiquefactionZone zone = find_zone(FemHistory(in.history.path), config, context.progress);
    write_zone(out.zone.path, zone);
    nlohmann::ordered_json facts = {{"transfer_time_s", zone.transfer_time},
                                    {"transfer_reason", zone.transfer_reason}};
    StageResult result{.facts = {}, .publish = {}, .warnings = zone_warnings(zone, config)};
    for (std::size_t i = 0; i < zone.window_names.size(); ++i) {
      add_depths(facts, zone, i);
      const std::string& window = zone.window_names[i];
      result.headlines.push_back({"liquefaction_depth_" + window + "_m",
                                  "liquefaction depth, " + window_label(window), "m"});
    }
    result.headlines.push_back({"transfer_time_s", "transfer at", "s"});
    if (is_set(zone.onset_time)) facts["onset_time_s"] = zone.onset_time;
    facts["strong_shaking_end_s"] = zone.strong_shaking_end;
    facts["zone_notes"] = zone.notes;
    result.facts = facts.dump();
    return result;
  }
};

}  // namespace

StageType zone_stage() { return stage_type<ZoneStage>(); }

}  // namespace flowslide
