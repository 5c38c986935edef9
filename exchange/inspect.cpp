#include "exchange/inspect.hpp"

#include "exchange/inspect_record.hpp"
#include "exchange/inspect_run.hpp"
#include "exchange/is_hdf5.hpp"
#include "exchange/is_terrain.hpp"
#include "importers/recorder_text.hpp"
#include "model/field_store.hpp"
#include "model/history.hpp"
#include "model/motion_file.hpp"
#include "model/mpm_history.hpp"
#include "model/particle_set.hpp"
#include "model/section_mesh.hpp"
#include "model/zone.hpp"
#include "motion/measures.hpp"
#include "mpm/walls/height_field.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/stages/stage_list.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

Json inspect_history(const fs::path& path) {
  const FemHistory history(path);
  const std::vector<double>& times = history.times();
  Json j = {{"nodes", history.mesh().num_nodes()},
            {"elements", history.mesh().num_elements()},
            {"frames", times.size()}};
  if (!times.empty()) j["time_s"] = {times.front(), times.back()};
  for (const HistoryMaterial& m : history.materials()) {
    j["materials"][m.name] = {{"tag", m.tag}, {"density_kg_m3", m.density}};
    if (is_set(m.porosity)) j["materials"][m.name]["porosity"] = m.porosity;
    if (!m.law.empty()) j["materials"][m.name]["law"] = m.law;
  }
  j["program"] = history.origin().program;
  j["sigma_zz"] = history.origin().sigma_zz_rule;
  j["problems"] = history.origin().notes;
  return j;
}

Json inspect_zone(const fs::path& path) {
  const LiquefactionZone zone = read_zone(path);
  Json depths = Json::object();
  for (std::size_t i = 0; i < zone.window_names.size(); ++i)
    depths[zone.window_names[i]] = zone.window_depth_max[i];
  return {{"elements", zone.liquefied.size()},
          {"liquefied_elements", std::count(zone.liquefied.begin(), zone.liquefied.end(), 1)},
          {"transfer_time_s", zone.transfer_time},
          {"transfer_reason", zone.transfer_reason},
          {"depth_m", depths},
          {"problems", zone.notes}};
}

Json inspect_particles(const fs::path& path) {
  const ParticleSet particles = read_particles(path);
  Json j = {{"particles", particles.size()}, {"dimension", particles.dim}};
  double mass = 0.0, volume = 0.0;
  for (double m : particles.mass) mass += m;
  for (double v : particles.volume) volume += v;
  j["mass_kg"] = mass;
  j["volume_m3"] = volume;
  for (const MaterialSpec& material : particles.materials) j["materials"].push_back(material.name);
  for (const auto& [name, values] : particles.history) j["quantities"].push_back(name);
  j["problems"] = particles.notes;
  return j;
}

Json inspect_flow(const fs::path& path) {
  const MpmHistory history(path);
  Json j = {{"particles", history.initial().size()},
            {"frames", history.num_frames()},
            {"samples", history.samples().size()}};
  if (!history.samples().empty()) {
    const MpmSample& last = history.samples().back();
    j["time_s"] = {history.samples().front().time, last.time};
    j["runout_m"] = last.runout;
    j["max_speed_m_s"] = last.max_speed;
    j["points_left"] = last.points_left;
    j["mass_error"] = last.mass_error;
    j["energy_error"] = last.energy_error;
  }
  j["problems"] = Json::array();
  return j;
}

Json inspect_mesh(const fs::path& path) {
  const SectionMesh section = read_section_mesh(path);
  Json j = {{"nodes", section.mesh.num_nodes()}, {"elements", section.mesh.num_elements()}};
  for (const MaterialName& m : section.materials) j["materials"][m.name] = m.tag;
  for (const EdgeSet& set : section.sets) j["set_edges"][set.name] = set.edges.size();
  j["problems"] = section.notes;
  return j;
}

Json inspect_motion(const fs::path& path) {
  const GroundMotion motion = read_motion_file(path);
  const MotionMeasures m = measure(motion);
  return {{"origin", motion.origin},
          {"samples", motion.acceleration.size()},
          {"dt_s", motion.dt},
          {"pga_m_s2", m.pga},
          {"pgv_m_s", m.pgv},
          {"d5_95_s", m.d5_95},
          {"tm_s", m.tm},
          {"problems", Json::array()}};
}

Json inspect_store(const fs::path& path) {
  const std::string kind = stored_kind(path);
  Json j = {{"kind", kind}};
  if (kind == "fem_history")
    j.update(inspect_history(path));
  else if (kind == "zone")
    j.update(inspect_zone(path));
  else if (kind == "mesh")
    j.update(inspect_mesh(path));
  else if (kind == "motion")
    j.update(inspect_motion(path));
  else if (kind == "particles")
    j.update(inspect_particles(path));
  else if (kind == "mpm_history")
    j.update(inspect_flow(path));
  else
    throw InputError(fmt::format(
        "{}: an HDF5 file, but of no kind that this program writes ('{}').", path.string(), kind));
  return j;
}

Json inspect_workflow(const fs::path& path) {
  const YamlNode document = load_yaml(path);
  Json j = {{"kind", "workflow"}, {"problems", Json::array()}};
  try {
    const Workflow workflow = load_workflow(path, {}, all_stages());
    j["name"] = workflow.name;
    for (const WorkflowStage& stage : workflow.stages) {
      j["stages"][stage.name] = stage.type.name;
      for (const std::string& text : stage.warnings)
        j["warnings"].push_back(fmt::format("{}: {}", stage.name, text));
    }
  } catch (const Error& e) {
    j["problems"].push_back(e.what());
  }
  return j;
}

Json inspect_recorder(const fs::path& path, const std::function<void(double)>& tick) {
  const RecorderSummary s = summarize_recorder(path, tick);
  Json j = {{"kind", "recorder"}, {"rows", s.rows}, {"columns", s.columns}};
  if (s.has_time) {
    j["time"] = {s.time_first, s.time_last};
    j["time_step"] = {s.step_min, s.step_max};
    j["stages"] = s.stages;
  }
  j["values"] = {s.value_min, s.value_max};
  j["notes"] = s.notes;
  if (s.has_time && s.columns == 2 && s.stages == 1)
    j["notes"].push_back(
        "an earthquake record without a heading looks the same: flowslide motion reads it, told "
        "the unit.");
  j["problems"] = s.problems;
  return j;
}

Json inspect_terrain(const fs::path& path) {
  Json j = {{"kind", "terrain"}, {"problems", Json::array()}};
  try {
    const mpm::HeightField f = mpm::read_height_field(path, {});
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::size_t missing = 0;
    for (const double h : f.height) {
      if (h < low) low = h;
      if (h > high) high = h;
      missing += std::isnan(h) ? 1 : 0;
    }
    const auto span = [&](std::size_t c, int nodes) {
      return Json{f.corner[c], f.corner[c] + (nodes - 1) * f.spacing};
    };
    j.update({{"columns", f.columns},
              {"rows", f.rows},
              {"cell_m", f.spacing},
              {"east_m", span(0, f.columns)},
              {"north_m", span(1, f.rows)},
              {"heights_m", {low, high}},
              {"missing", missing}});
  } catch (const InputError& e) {
    j["problems"].push_back(e.what());
  }
  return j;
}

}  // namespace

Json inspect(const fs::path& path, const std::function<void(double)>& tick) {
  if (type_of(path) == fs::file_type::directory) return inspect_run(path, tick);
  if (is_hdf5(path)) return inspect_store(path);
  if (path.extension() == ".yaml" || path.extension() == ".yml") return inspect_workflow(path);
  if (is_terrain(path)) return inspect_terrain(path);
  return is_motion_record(path) ? inspect_record(path) : inspect_recorder(path, tick);
}

}  // namespace flowslide
