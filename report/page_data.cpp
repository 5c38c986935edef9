#include "report/page_data.hpp"

#include "core/elementary.hpp"
#include "motion/spectrum.hpp"
#include "report/page_points.hpp"
#include "report/section_lines.hpp"
#include "report/told_run.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostStates = 200;  ///< of the shaking that are read for the crest
constexpr std::size_t kMostNodes = 65000;

void add_flow(PageArrays& arrays, const std::vector<MpmSample>& samples, double toe) {
  const auto add = [&](const char* name, auto&& value) {
    std::vector<double> column;
    for (const MpmSample& s : samples) column.push_back(value(s));
    arrays.add(std::string("flow.") + name, column);
  };
  add("t", [](const MpmSample& s) { return s.time; });
  add("front", [](const MpmSample& s) { return s.front; });
  if (is_set(toe))
    add("runout", [toe](const MpmSample& s) { return std::max(0.0, s.front - toe); });
  add("max_speed", [](const MpmSample& s) { return s.max_speed; });
  add("gravity", [](const MpmSample& s) { return s.gravity_work; });
  add("plastic", [](const MpmSample& s) { return s.plastic_work; });
  add("friction", [](const MpmSample& s) { return s.friction_work; });
  add("damping", [](const MpmSample& s) { return s.damping_work; });
  add("kinetic", [](const MpmSample& s) { return s.kinetic; });
  add("strain", [](const MpmSample& s) { return s.strain_energy; });
  add("energy_error", [](const MpmSample& s) { return s.energy_error; });
  add("momentum_error", [](const MpmSample& s) { return s.momentum_error; });
}

Json add_zone(PageArrays& arrays, const ZoneHistory& h) {
  Json windows = Json::array();
  if (h.time.size() < 2) return windows;
  arrays.add("zone.t", h.time);
  for (std::size_t w = 0; w < h.window_names.size(); ++w) {
    arrays.add(fmt::format("zone.depth{}", w), h.depth.at(w));
    arrays.add(fmt::format("zone.deepest{}", w), h.depth_max.at(w));
    windows.push_back(window_label(h.window_names[w]));
  }
  arrays.add("zone.kinetic", h.kinetic_energy_relative);
  arrays.add("zone.quality", h.distortion_gauss);
  return windows;
}

void add_motion(PageArrays& arrays, const GroundMotion& motion) {
  arrays.add("motion.a", motion.acceleration);
  // 0.02 to 6.3 s, evenly on a logarithmic axis
  std::vector<double> logs, periods;
  for (int k = 0; k <= 90; ++k) {
    logs.push_back(k / 36.0 - 1.7);
    periods.push_back(pow(10.0, logs.back()));
  }
  arrays.add("spectrum.logT", logs);
  arrays.add("spectrum.psa", pseudo_acceleration(motion, periods));
}

/// Downstream edge of the highest ground, and the nodes of the base.
struct Watched {
  std::size_t crest = 0;
  std::vector<std::size_t> base;
};

Watched watched_nodes(const QuadMesh& mesh) {
  const auto [low, high] =
      std::minmax_element(mesh.nodes.begin(), mesh.nodes.end(),
                          [](const Vec2& a, const Vec2& b) { return a[1] < b[1]; });
  const double tolerance = 1e-6 * ((*high)[1] - (*low)[1]);
  Watched w;
  bool found = false;
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i) {
    const Vec2& n = mesh.nodes[i];
    if (n[1] <= (*low)[1] + tolerance) w.base.push_back(i);
    if (n[1] < (*high)[1] - tolerance) continue;
    if (!found || n[0] > mesh.nodes[w.crest][0]) w.crest = i;
    found = true;
  }
  return w;
}

/// Movement of the crest against the base during the shaking.
Json add_crest(PageArrays& arrays, const FemHistory& history) {
  const std::size_t states = history.times().size();
  if (states < 2) return nullptr;
  const Watched w = watched_nodes(history.mesh());
  std::vector<double> t, across, down;
  const std::size_t stride = (states + kMostStates - 1) / kMostStates;
  for (std::size_t k = 0; k < states; k += stride) {
    const FemFrame frame = history.frame(k);
    double base[2] = {0.0, 0.0};
    for (const std::size_t i : w.base)
      for (int d = 0; d < 2; ++d) base[d] += frame.displacement[i][d] / double(w.base.size());
    t.push_back(frame.time);
    across.push_back(frame.displacement[w.crest][0] - base[0]);
    down.push_back(base[1] - frame.displacement[w.crest][1]);
  }
  arrays.add("crest.t", t);
  arrays.add("crest.across", across);
  arrays.add("crest.down", down);
  const Vec2& at = history.mesh().nodes[w.crest];
  return Json{at[0], at[1]};
}

/// Largest shear strain in the plane, engineering.
double shear_strain(const StrainIncrement<2>& e) { return hypot(e[0] - e[1], e[3]); }

bool add_section(PageArrays& arrays, const FemHistory& history, const LiquefactionZone& zone) {
  const QuadMesh& mesh = history.mesh();
  if (mesh.num_nodes() > kMostNodes) return false;
  std::vector<double> x, y, corners, material, liquefied, strain, r_u, strength, sigma;
  for (const Vec2& n : mesh.nodes) {
    x.push_back(n[0]);
    y.push_back(n[1]);
  }
  for (int c = 0; c < 4; ++c)
    for (const auto& element : mesh.elements) corners.push_back(element[c]);
  const bool shaken = zone.transfer_frame >= 0;
  const FemFrame frame =
      shaken ? history.frame(static_cast<std::size_t>(zone.transfer_frame)) : history.gravity();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    material.push_back(mesh.element_material[e]);
    liquefied.push_back(zone.liquefied[e]);
    strain.push_back(shear_strain(frame.strain[e]));
    r_u.push_back(std::clamp(zone.r_u_element[e], -0.2, 1.2));
    strength.push_back(zone.strength[e]);
    sigma.push_back(zone.sigma_v0[e]);
  }
  arrays.add("mesh.x", x);
  arrays.add("mesh.y", y);
  arrays.add("mesh.corners", corners, 4, Bits::sixteen, 1.0);
  arrays.add("mesh.material", material, 1, Bits::sixteen, 1.0);
  arrays.add("mesh.liquefied", liquefied, 1, Bits::eight, 1.0);
  if (shaken) arrays.add("mesh.strain", strain);
  if (shaken) arrays.add("mesh.r_u", r_u);
  arrays.add("mesh.strength", strength);
  arrays.add("mesh.sigma_v0", sigma);
  return true;
}

Json rows_json(const Table& table) {
  Json rows = Json::array();
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Json row = Json::array();
    for (std::size_t c = 0; c < table.columns; ++c) {
      const double value = table.values[r * table.columns + c];
      row.push_back(is_set(value) ? Json(std::round(1e3 * value) / 1e3) : Json(nullptr));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

PageData page_data(const ReportInputs& in, const ReportConfig& config, const ReportFacts& facts,
                   const FinalState& end) {
  PageData page;
  Json j;
  j["schema"] = 1;
  j["toe_m"] = facts.toe;
  j["front_m"] = facts.front;
  j["runout_m"] = facts.runout;
  j["moved_m"] = config.moved;
  j["transfer_time_s"] = in.zone.transfer_time;
  j["shaken"] = in.zone.transfer_frame >= 0;
  j["materials"] = Json::array();
  const ParticleSet& p = in.flow.initial();
  for (const MaterialSpec& m : p.materials)
    j["materials"].push_back(
        {{"name", m.name}, {"counts", m.counts_for_runout}, {"liquefied", m.liquefied}});
  j["soils"] = Json::array();
  for (const auto& [tag, name] : soil_names(in.stages))
    j["soils"].push_back({{"tag", tag}, {"name", name}});
  j["ground"] = rows_json(ground_line(in.stages));
  j["outline"] = rows_json(outline_segments(in.history.mesh()));
  j["water"] = rows_json(water_surface(in.history.mesh(), in.history.gravity().pore_pressure));
  j["lower_boundary"] = in.zone.lower_boundary;
  add_flow(page.arrays, in.flow.samples(), facts.toe);
  j["windows"] = add_zone(page.arrays, in.zone.history);
  j["crest"] = add_crest(page.arrays, in.history);
  if (in.motion) {
    add_motion(page.arrays, *in.motion);
    j["motion_dt_s"] = in.motion->dt;
  }
  j["section"] = add_section(page.arrays, in.history, in.zone);
  const ShownPoints shown =
      add_points(page.arrays, in.flow, end.undeformed, static_cast<std::size_t>(config.page_points),
                 static_cast<std::size_t>(config.page_frames));
  j["points"] = {{"shown", shown.points},
                 {"of", p.size()},
                 {"frames", shown.frames},
                 {"frames_of", in.flow.num_frames()},
                 {"spacing_m", shown.spacing}};
  j["arrays"] = Json::parse(page.arrays.index());
  page.json = j.dump(-1, ' ', false, Json::error_handler_t::replace);
  return page;
}

}  // namespace flowslide
