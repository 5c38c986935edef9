#include "report/plot_data.hpp"

#include "core/files.hpp"
#include "report/npy.hpp"
#include "report/section_lines.hpp"
#include "report/tables.hpp"
#include "report/told_run.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

Table final_points(const ParticleSet& p, const MpmFrame& last, const FinalState& end) {
  Table t{.columns = 9, .values = {}};
  for (std::size_t i = 0; i < p.size(); ++i)
    t.add({end.position[i][0], end.position[i][1], end.undeformed[i][0], end.undeformed[i][1],
           end.displacement[i], static_cast<double>(p.material[i]), end.strength_ratio[i],
           std::sqrt(last.volume[i]), last.strength[i]});
  return t;
}

Table elements(const QuadMesh& mesh, const LiquefactionZone& zone) {
  const std::size_t n = mesh.num_elements();
  Table t{.columns = 13, .values = {}};
  for (std::size_t e = 0; e < n; ++e) {
    for (const Vec2& c : corners(mesh, mesh.nodes, e)) t.add({c[0], c[1]});
    t.add({zone.r_u_element[e], static_cast<double>(zone.liquefied[e]), zone.strength[e],
           static_cast<double>(mesh.element_material[e]), zone.sigma_v0[e]});
  }
  return t;
}

}  // namespace

void write_plot_data(const std::filesystem::path& folder, const FemHistory& history,
                     const LiquefactionZone& zone, const MpmHistory& flow, const FinalState& end,
                     const ReportFacts& facts, const ReportConfig& config,
                     const std::vector<ToldStage>& stages) {
  const ParticleSet& p = flow.initial();
  const QuadMesh& mesh = history.mesh();
  write_npy(folder / "final.npy", final_points(p, flow.frame(flow.num_frames() - 1), end));
  write_npy(folder / "elements.npy", elements(mesh, zone));
  write_npy(folder / "outline.npy", outline_segments(mesh));
  write_npy(folder / "water.npy", water_surface(mesh, history.gravity().pore_pressure));
  Json j;
  j["toe_m"] = facts.toe;
  j["front_m"] = facts.front;
  j["runout_m"] = facts.runout;
  j["moved_m"] = config.moved;
  j["time_s"] = end.time;
  j["transfer_time_s"] = zone.transfer_time;
  j["transfer_frame"] = zone.transfer_frame;
  j["lower_boundary"] = zone.lower_boundary;
  j["windows"] = Json::array();
  for (const std::string& name : zone.history.window_names)
    j["windows"].push_back({{"name", window_label(name)}, {"column", column_name(name)}});
  j["materials"] = Json::array();
  for (const MaterialSpec& m : p.materials)
    j["materials"].push_back(
        {{"name", m.name}, {"counts", m.counts_for_runout}, {"liquefied", m.liquefied}});
  j["soils"] = Json::array();
  for (const auto& [tag, name] : soil_names(stages))
    j["soils"].push_back({{"tag", tag}, {"name", name}});
  j["ground"] = Json::array();
  const Table ground = ground_line(stages);
  for (std::size_t r = 0; r < ground.rows(); ++r)
    j["ground"].push_back({ground.values[2 * r], ground.values[2 * r + 1]});
  write_file(folder / "plot.json", j.dump(1) + "\n");
}

}  // namespace flowslide
