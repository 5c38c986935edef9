#include "report/tables.hpp"

#include "core/check.hpp"
#include "report/facts.hpp"

#include <array>
#include <cctype>
#include <utility>

namespace flowslide {
namespace {

struct SampleColumn {
  std::string_view name;
  double MpmSample::*value;
};

constexpr std::array kAfterSpeed{SampleColumn{"max_speed_m_s", &MpmSample::max_speed},
                                 SampleColumn{"kinetic_J_per_m", &MpmSample::kinetic},
                                 SampleColumn{"gravity_work_J_per_m", &MpmSample::gravity_work},
                                 SampleColumn{"strain_energy_J_per_m", &MpmSample::strain_energy},
                                 SampleColumn{"plastic_work_J_per_m", &MpmSample::plastic_work},
                                 SampleColumn{"friction_work_J_per_m", &MpmSample::friction_work},
                                 SampleColumn{"damping_work_J_per_m", &MpmSample::damping_work},
                                 SampleColumn{"energy_error", &MpmSample::energy_error},
                                 SampleColumn{"momentum_error", &MpmSample::momentum_error},
                                 SampleColumn{"mass_error", &MpmSample::mass_error},
                                 SampleColumn{"dt_s", &MpmSample::dt},
                                 SampleColumn{"active_particles", &MpmSample::active_particles},
                                 SampleColumn{"points_left", &MpmSample::points_left},
                                 SampleColumn{"mass_left_kg_per_m", &MpmSample::mass_left},
                                 SampleColumn{"kinetic_left_J_per_m", &MpmSample::kinetic_left}};

}  // namespace

std::string column_name(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return out;
}

std::string runout_csv(const std::vector<MpmSample>& samples) {
  std::string out = "time_s,runout_m,front_m,front_speed_m_s";
  for (const auto& column : kAfterSpeed) out += fmt::format(",{}", column.name);
  out += '\n';
  const std::vector<double> speed = front_speed(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const MpmSample& s = samples[i];
    out += fmt::format("{},{},{},{}", s.time, s.runout, s.front, speed[i]);
    for (const auto& column : kAfterSpeed) out += fmt::format(",{}", s.*column.value);
    out += '\n';
  }
  return out;
}

std::string zone_csv(const ZoneHistory& h) {
  std::vector<std::pair<std::string, const std::vector<double>*>> columns{{"time_s", &h.time}};
  validate(h.depth.size() == h.window_names.size() && h.depth_max.size() == h.window_names.size() &&
               h.depth_any.size() == h.window_names.size() &&
               h.depth_interpolated.size() == h.window_names.size(),
           "the zone's history has {} windows but {} depths (each window has one) rebuild the zone",
           h.window_names.size(), h.depth.size());
  for (std::size_t w = 0; w < h.window_names.size(); ++w) {
    const std::string name = column_name(h.window_names[w]);
    columns.emplace_back("depth_" + name + "_m", &h.depth[w]);
    columns.emplace_back("depth_max_" + name + "_m", &h.depth_max[w]);
    columns.emplace_back("depth_any_node_" + name + "_m", &h.depth_any[w]);
    columns.emplace_back("depth_interpolated_" + name + "_m", &h.depth_interpolated[w]);
  }
  columns.emplace_back("kinetic_energy_J_per_m", &h.kinetic_energy);
  columns.emplace_back("kinetic_energy_relative_J_per_m", &h.kinetic_energy_relative);
  columns.emplace_back("sliding_energy_J_per_m", &h.sliding_energy);
  columns.emplace_back("distortion_gauss", &h.distortion_gauss);
  columns.emplace_back("distortion_centre", &h.distortion_centre);
  std::string out;
  for (const auto& [name, values] : columns) {
    validate(values->size() == h.time.size(),
             "'{}' of the zone's history has {} values for {} times (the file is damaged) rebuild "
             "the zone",
             name, values->size(), h.time.size());
    out += (out.empty() ? "" : ",") + name;
  }
  out += '\n';
  for (std::size_t i = 0; i < h.time.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      out += fmt::format("{}{}", (*columns[c].second)[i], c + 1 < columns.size() ? ',' : '\n');
  return out;
}

}  // namespace flowslide
