#include "report/facts.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

Json movements(const std::vector<Movement>& list) {
  Json out = Json::array();
  for (const Movement& m : list)
    out.push_back({{"name", m.name},
                   {"points", m.points},
                   {"volume_m3_per_m", m.volume},
                   {"failed_share", m.failed_share},
                   {"mean_displacement_m", m.mean_displacement},
                   {"max_displacement_m", m.max_displacement}});
  return out;
}

}  // namespace

std::string to_json(const ReportFacts& f) {
  Json j;
  j["runout_m"] = is_set(f.toe) ? Json(f.runout) : Json(nullptr);
  j["front_m"] = f.front;
  j["toe_m"] = f.toe;
  j["runout_mass_quantile_m"] = f.runout_mass;
  j["front_mass_quantile_m"] = f.front_mass;
  j["front_farthest_m"] = f.front_farthest;
  for (const auto& [window, depth] : f.liquefaction_depth)
    j["liquefaction_depth_" + window + "_m"] = depth;
  j["transfer_time_s"] = f.transfer_time;
  j["duration_s"] = f.duration;
  j["time_at_rest_s"] = f.time_at_rest;
  j["front_at_rest_s"] = f.front_at_rest;
  j["peak_speed_m_s"] = f.peak_speed;
  j["peak_front_speed_m_s"] = f.peak_front_speed;
  j["failed_volume_m3_per_m"] = f.failed_volume;
  j["failed_percent"] = f.failed_percent;
  j["volume_past_toe_m3_per_m"] = f.volume_past_toe;
  j["deepest_failed_y_m"] = f.deepest_failed;
  j["deepest_failed_mass_quantile_y_m"] = f.deepest_failed_mass;
  j["points_left"] = f.points_left;
  j["mass_left_kg_per_m"] = f.mass_left;
  j["mass_error"] = f.mass_error;
  j["energy_error"] = f.energy_error;
  j["momentum_error"] = f.momentum_error;
  j["materials"] = movements(f.materials);
  j["regions"] = movements(f.regions);
  j["warnings"] = f.warnings;
  return j.dump(2) + "\n";
}

}  // namespace flowslide
