#include "report/facts.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

Json movements_json(const std::vector<Movement>& list) {
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

/// A front as runout past the toe; null without one.
Json past(double front, double toe) {
  return is_set(toe) && is_set(front) ? Json(std::max(0.0, front - toe)) : Json(nullptr);
}

void add_composition(Json& j, const ReportFacts& f) {
  const Composition& c = f.composition;
  j["runout_equal_mass_m"] = past(c.fronts.equal_mass, f.toe);
  j["runout_995_m"] = past(c.fronts.q995, f.toe);
  j["runout_99_m"] = past(c.fronts.q99, f.toe);
  j["runout_95_m"] = past(c.fronts.q95, f.toe);
  const double none = kUnset;
  j["runout_liquefied_m"] = past(c.liquefied ? c.liquefied_fronts.fifth : none, f.toe);
  j["runout_liquefied_995_m"] = past(c.liquefied ? c.liquefied_fronts.q995 : none, f.toe);
  j["height_m"] = c.height;
  j["mass_past_toe_kg_per_m"] = c.mass_past_toe;
  Json foremost = Json::array();
  for (const FrontShare& s : c.foremost)
    foremost.push_back({{"material", s.material}, {"share", s.share}});
  j["foremost"] = foremost;
}

Json apart(const Apart& a) {
  return {{"shaking_m", a.shaking}, {"flow_m", a.flow}, {"both_m", a.both}};
}

void add_outcome(Json& j, const OutcomeFacts& o) {
  j["outcome"] = word(o.outcome);
  j["displacement_mean"] = apart(o.mean);
  j["displacement_largest"] = apart(o.largest);
  j["crest"] = {{"x_m", o.crest.x},
                {"level_m", o.crest.level},
                {"outward", apart(o.crest.outward)},
                {"settlement", apart(o.crest.settlement)},
                {"freeboard_m", o.crest.freeboard}};
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
  add_composition(j, f);
  add_outcome(j, f.outcome);
  for (const auto& [window, depth] : f.liquefaction_depth)
    j["liquefaction_depth_" + window + "_m"] = depth;
  j["transfer_time_s"] = f.transfer_time;
  j["duration_s"] = f.duration;
  j["time_at_rest_s"] = f.time_at_rest;
  j["front_at_rest_s"] = f.front_at_rest;
  j["front_change_at_end_m"] = f.front_change;
  j["speed_at_end_m_s"] = f.last_speed;
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
  j["materials"] = movements_json(f.materials);
  j["regions"] = movements_json(f.regions);
  Json zone = Json::array();
  for (const auto& [below, share] : f.zone_shares)
    zone.push_back(
        {{"r_u_below", std::isfinite(below) ? Json(below) : Json(nullptr)}, {"share", share}});
  j["residual_strength_area"] = zone;
  j["warnings"] = f.warnings;
  return j.dump(2) + "\n";
}

}  // namespace flowslide
