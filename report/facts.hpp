#pragma once
#include "core/check.hpp"
#include "model/mpm_history.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "report/composition.hpp"
#include "report/config.hpp"
#include "report/outcome.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The numbers of a finished runout. Displacements are counted from the undeformed section: those
/// before the transfer plus those of the flow. "Failed" points are those of materials that count
/// for the runout and moved by more than ReportConfig::moved. Per metre of width.
namespace flowslide {

/// State of every point at the end, in order of id.
struct FinalState {
  double time = 0.0;                              ///< [s] since transfer
  std::vector<std::array<double, 3>> undeformed;  ///< position in the undeformed section [m]
  std::vector<std::array<double, 3>> position;    ///< [m]
  std::vector<double> displacement;               ///< magnitude [m]
  std::vector<double> strength_ratio;             ///< strength / strength at transfer; NaN if none
  std::vector<std::uint8_t> counts;               ///< 1 if the material counts for the runout
  std::vector<std::uint8_t> failed;               ///< 1 if it counts and moved
};

/// Movement of a material or of a named region.
struct Movement {
  std::string name;
  std::size_t points = 0;
  double volume = 0.0;             ///< at transfer [m3/m]
  double failed_share = 0.0;       ///< share of its mass that moved by more than `moved` [-]
  double mean_displacement = 0.0;  ///< weighted by mass [m]
  double max_displacement = 0.0;   ///< [m]
};

struct ReportFacts {
  double toe = kUnset;             ///< x from which the runout counts [m]
  double runout = 0.0;             ///< [m] fifth-farthest point past the toe
  double front = kUnset;           ///< x of the fifth-farthest point [m]
  double front_mass = kUnset;      ///< x beyond which mass_quantile of the failed mass lies [m]
  double front_farthest = kUnset;  ///< x of the farthest point [m]
  double runout_mass = 0.0;        ///< [m] front_mass past the toe, 0 if it does not pass
  double transfer_time = 0.0;      ///< [s] from the start of the motion
  std::vector<std::pair<std::string, double>> liquefaction_depth;  ///< by window name [m]
  double duration = 0.0;           ///< [s] of the flow that was computed
  double time_at_rest = kUnset;    ///< [s] from which the kinetic energy stays small; unset: never
  double front_at_rest = kUnset;   ///< [s] from which the front stays; unset: never
  double front_change = 0.0;       ///< [m] way of the front in the last RestRule::window
  double last_speed = 0.0;         ///< [m/s] of the fastest point at the end
  double peak_speed = 0.0;         ///< largest speed of any point [m/s]
  double peak_front_speed = 0.0;   ///< largest mean speed of the front over an interval [m/s]
  double failed_volume = 0.0;      ///< [m3/m]
  double failed_percent = 0.0;     ///< of the volume of the counted materials [%]
  double volume_past_toe = 0.0;    ///< present volume beyond the toe [m3/m]
  double deepest_failed = kUnset;  ///< smallest undeformed y of a failed point [m]
  double deepest_failed_mass = kUnset;  ///< y below which mass_quantile of the failed mass lay [m]
  double points_left = 0.0;             ///< that left the model through its outlet
  double mass_left = 0.0;               ///< their mass [kg/m]
  double mass_error = 0.0;              ///< largest, relative
  double energy_error = 0.0;            ///< at the end, residual / work of gravity
  double momentum_error = 0.0;          ///< at the end, residual / impulse of gravity
  RestRule rest;                        ///< of the run
  Composition composition;
  OutcomeFacts outcome;
  std::vector<std::pair<double, double>> zone_shares;  ///< of zone_shares()
  std::vector<Movement> materials;
  std::vector<Movement> regions;
  std::vector<std::string> warnings;  ///< what an engineer must know before using the numbers
};

/// Throws InputError if the history is empty, not plane, or does not belong to `particles`.
FinalState final_state(const ParticleSet& particles, const MpmHistory& flow,
                       const ReportConfig& config);

ReportFacts compute_facts(const LiquefactionZone& zone, const MpmHistory& flow,
                          const FinalState& end, const ReportConfig& config);

/// Fills facts.warnings; compute_facts calls it last.
void add_warnings(ReportFacts& facts, const ParticleSet& initial, const FinalState& end,
                  const std::vector<MpmSample>& samples, const RestRule& rest,
                  const ReportConfig& config);

/// JSON object with units in its keys: runout_m, liquefaction_depth_<window>_m, transfer_time_s,
/// mass_error, ... A number that is unset becomes null.
std::string to_json(const ReportFacts& facts);

/// Adds a warning if no failure was found in the shaking, and soil flows nevertheless.
void warn_without_failure(ReportFacts& facts, const LiquefactionZone& zone,
                          const ReportConfig& config);

/// Speed of the front between consecutive samples [m/s], one per sample, 0 for the first.
std::vector<double> front_speed(const std::vector<MpmSample>& samples);

}  // namespace flowslide
