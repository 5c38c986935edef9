#pragma once
#include "model/mesh.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The liquefied part of a section at the moment of transfer. On disk: HDF5, kind "zone".
namespace flowslide {

/// Scalars over time that explain the choice of the transfer time; all vectors as long as `time`.
struct ZoneHistory {
  std::vector<double> time;               ///< [s]
  std::vector<std::string> window_names;  ///< "crest", "pond", ...
  std::vector<std::vector<double>>
      depth;  ///< [window][time] instantaneous depth of liquefaction [m]
  std::vector<std::vector<double>> depth_max;  ///< the same, running maximum [m]
  std::vector<std::vector<double>> depth_any;  ///< of the lowest node above the threshold [m]
  std::vector<std::vector<double>> depth_interpolated;  ///< where r_u passes the threshold [m]
  std::vector<double> kinetic_energy;           ///< per metre of width, absolute velocity [J/m]
  std::vector<double> kinetic_energy_relative;  ///< the same, velocity relative to the base [J/m]
  std::vector<double> sliding_energy;           ///< of the velocity averaged over a while [J/m]
  std::vector<double>
      distortion_gauss;  ///< Q with the smallest of the 2x2 Gauss-point Jacobians [-]
  std::vector<double> distortion_centre;  ///< Q with the Jacobian at the centre, the area ratio [-]
};

/// Name of the one window that there is where the user gave none, and what to call a window in
/// texts.
inline constexpr std::string_view kWholeSoil = "all";
inline std::string window_label(std::string_view name) {
  return std::string(name == kWholeSoil ? "whole soil" : name);
}

/// How a transfer_reason begins where the rule found no failure in the shaking.
inline constexpr std::string_view kNoFailure =
    "the kinetic energy never leaves its pre-failure envelope";

struct LiquefactionZone {
  double transfer_time = 0.0;       ///< [s]; 0 for the gravity state
  int transfer_frame = -1;          ///< index into FemHistory::times(), -1 for the gravity state
  std::string transfer_reason;      ///< the rule's reasoning in one sentence
  std::vector<double> r_u_node;     ///< nodes; NaN where sigma'_v0 is below the floor
  std::vector<double> r_u_element;  ///< element means of the nodal values [-]
  std::vector<double>
      sigma_v0;  ///< elements, initial vertical effective stress, compression > 0 [Pa]
  std::vector<std::uint8_t> liquefied;  ///< elements, 1 inside the zone
  std::vector<double> strength;         ///< elements, S_r inside the zone [Pa], NaN outside
  std::vector<std::int32_t> layer;      ///< elements, strength layer from the surface, -1 outside
  std::vector<Vec2> lower_boundary;     ///< polyline under the zone from upstream to downstream [m]
  std::vector<std::string> window_names;
  std::vector<double> window_depth_max;  ///< largest depth in each window up to the transfer [m]
  std::vector<double> window_depth_any;  ///< the same by single nodes [m]
  std::vector<double> window_depth_interpolated;  ///< the same between nodes [m]
  std::vector<double> window_depth_strong;        ///< largest until the end of strong shaking [m]
  std::vector<double> window_depth_before_slide;  ///< largest until the onset of failure [m]
  double strong_shaking_end = 0.0;  ///< 95 % of the base's squared velocity have passed [s]
  double onset_time = 0.0;          ///< of failure [s]; NaN if there was none up to the transfer
  ZoneHistory history;
  /// Nothing was shaken: what liquefied is as the settings say, not found.
  [[nodiscard]] bool is_assumed() const { return transfer_frame < 0; }
  /// Shaken to the end of its record, and no failure was found.
  [[nodiscard]] bool no_failure_found() const {
    return !is_assumed() && transfer_reason.starts_with(kNoFailure);
  }
  std::vector<std::string> notes;  ///< clamped values, skipped nodes, one line each
};

void write_zone(const std::filesystem::path& path, const LiquefactionZone& zone);
LiquefactionZone read_zone(const std::filesystem::path& path);

}  // namespace flowslide
