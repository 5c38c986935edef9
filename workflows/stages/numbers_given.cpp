#include "workflows/stages/numbers_given.hpp"

#include <algorithm>
#include <sstream>

namespace flowslide {
namespace {

constexpr std::string_view kOfMesh =
    "mesh_nodes mesh_elements mesh_min_jacobian_ratio mesh_max_aspect mesh_max_angle_off_90_deg "
    "mesh_shortest_edge_m mesh_thinnest_element_m";

constexpr std::string_view kOfShaking =
    "fem_end_s fem_stopped_by_displacement fem_stopped_at_transfer fem_largest_displacement_m "
    "fem_steps fem_smallest_step_s fem_largest_step_s fem_out_of_balance fem_energy_error "
    "fem_base_work_j fem_damping_work_j fem_kinetic_energy_j fem_sub_steps fem_sub_steps_at_floor "
    "fem_iterations fem_most_iterations fem_cut_steps";

constexpr std::string_view kOfFlow =
    "runout_m front_m front_equal_mass_m front_995_m front_99_m front_95_m height_m toe_m "
    "mass_error energy_error flow_end_s flow_at_rest flow_steps points_left mass_left_kg_per_m "
    "flow_point_updates absorbed_energy_j_per_m stiffness.fall_m "
    "stiffness.materials.*.bulk_modulus_pa stiffness.materials.*.given_bulk_modulus_pa "
    "stiffness.materials.*.volume_change stiffness.materials.*.mach_number "
    "stiffness.materials.*.brittleness";

constexpr std::string_view kOfReport =
    "runout_m front_m toe_m runout_mass_quantile_m front_mass_quantile_m front_farthest_m "
    "runout_equal_mass_m runout_995_m runout_99_m runout_95_m runout_liquefied_m "
    "runout_liquefied_995_m height_m mass_past_toe_kg_per_m displacement_mean.shaking_m "
    "displacement_mean.flow_m displacement_mean.both_m displacement_largest.shaking_m "
    "displacement_largest.flow_m displacement_largest.both_m crest.x_m crest.level_m "
    "crest.outward.shaking_m crest.outward.flow_m crest.outward.both_m crest.settlement.shaking_m "
    "crest.settlement.flow_m crest.settlement.both_m crest.freeboard_m transfer_time_s duration_s "
    "time_at_rest_s front_at_rest_s front_change_at_end_m speed_at_end_m_s peak_speed_m_s "
    "peak_front_speed_m_s failed_volume_m3_per_m failed_percent volume_past_toe_m3_per_m deepest_failed_y_m deepest_failed_mass_quantile_y_m "
    "points_left mass_left_kg_per_m mass_error energy_error momentum_error";

/// Of a part of the section.
constexpr std::string_view kOfMovement =
    "points volume_m3_per_m failed_share mean_displacement_m max_displacement_m";

constexpr std::string_view kOfWindow =
    "m any_node_m interpolated_m strong_shaking_m before_slide_m";

void add_names(std::vector<std::string>& all, std::string_view words,
               const std::string& before = "") {
  std::istringstream in{std::string(words)};
  for (std::string word; in >> word;) all.push_back(before + word);
}

/// Names of the entries of a table: of lines such as  windows."crest".from = -40 m
std::vector<std::string> entries(std::string_view settings, std::string_view table) {
  std::vector<std::string> names;
  std::istringstream in{std::string(settings)};
  const std::string begin = std::string(table) + ".\"";
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(begin)) continue;
    const std::size_t end = line.find('"', begin.size());
    if (end == std::string::npos) continue;
    std::string name = line.substr(begin.size(), end - begin.size());
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<std::string> numbers_given(std::string_view type, std::string_view settings) {
  std::vector<std::string> all;
  if (type == "mesh.section" || type == "import.mesh") add_names(all, kOfMesh);
  if (type == "motion.prepare")
    add_names(all, "pga_m_s2 pgv_m_s arias_m_s d5_95_s tm_s cav_m_s masi_m_s dt_s duration_s",
              "motion_");
  if (type == "fem.run") add_names(all, kOfShaking);
  if (type == "import.opensees") add_names(all, "fem_nodes fem_elements fem_frames");
  if (type == "transfer.zone") {
    add_names(all, "transfer_time_s onset_time_s strong_shaking_end_s");
    for (const std::string& window : entries(settings, "windows"))
      add_names(all, kOfWindow, "liquefaction_depth_" + window + "_");
  }
  if (type == "transfer.map") add_names(all, "particles audit_passed");
  if (type == "transfer.sordo2024") add_names(all, "particles");
  if (type == "mpm.run") add_names(all, kOfFlow);
  if (type == "report.runout") {
    add_names(all, kOfReport);
    add_names(all, kOfMovement, "materials.*.");
    for (const std::string& region : entries(settings, "regions"))
      add_names(all, kOfMovement, "regions." + region + ".");
  }
  return all;
}

}  // namespace flowslide
