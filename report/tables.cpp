#include "report/tables.hpp"

#include "core/check.hpp"
#include "report/facts.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace flowslide {
namespace {

/// "kinetic", "J" -> "kinetic_J_per_m"
std::string column_with_unit(const SampleColumn& c) {
  const std::string unit = c.unit;
  if (unit == "-") return c.name;
  const bool of_slice = unit == "J" || unit == "kg" || unit == "N s";
  return fmt::format("{}_{}{}", c.name, column_name(unit), of_slice ? "_per_m" : "");
}

}  // namespace

std::string column_name(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return out;
}

std::string runout_csv(const std::vector<MpmSample>& samples, double toe) {
  // The speed of the front stands beside the front.
  const auto ends_place = [](const SampleColumn& c) { return c.value == &MpmSample::front; };
  std::string out;
  for (const SampleColumn& c : kSampleColumns) {
    out += (out.empty() ? "" : ",") + column_with_unit(c);
    if (ends_place(c)) out += ",front_speed_m_s";
  }
  out += '\n';
  const std::vector<double> speed = front_speed(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (const SampleColumn& c : kSampleColumns) {
      const bool counts_anew = c.value == &MpmSample::runout && is_set(toe);
      const double value =
          counts_anew ? std::max(0.0, samples[i].front - toe) : samples[i].*c.value;
      out += fmt::format("{}{}", &c == kSampleColumns.data() ? "" : ",", value);
      if (ends_place(c)) out += fmt::format(",{}", speed[i]);
    }
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
