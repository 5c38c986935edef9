#pragma once
#include "model/mpm_history.hpp"
#include "model/zone.hpp"

#include <string>
#include <string_view>
#include <vector>

/// Time series as comma-separated text: one header line with units in the names, numbers in their
/// shortest form that reads back to the same double, "nan" for unset.
namespace flowslide {

/// time_s, runout_m, front_m, front_speed_m_s, ..., energies in J per metre of width. The runout
/// counts from `toe` [m]; unset: as the run counted it.
std::string runout_csv(const std::vector<MpmSample>& samples, double toe);

/// time_s, depth_<window>_m and depth_max_<window>_m of every window, kinetic energies, distortion
/// Q.
std::string zone_csv(const ZoneHistory& history);

/// Name as part of a column: letters, digits and '_' only.
std::string column_name(std::string_view name);

}  // namespace flowslide
