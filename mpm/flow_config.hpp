#pragma once
#include "config/schema.hpp"
#include "mpm/scheme.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

/// Settings of a runout. docs/theory/mpm.md
namespace flowslide {

enum class VolumeAverage { automatic, off };

struct SofteningSettings {
  bool regularise = true;
  double reference_length = 1.25;  ///< [m]
};

struct RestSettings {
  double kinetic_share = 1e-4;  ///< of the largest kinetic energy
  double runout_change = 0.1;   ///< [m]
  double window = 5.0;          ///< [s]
};

struct GroundSettings {
  std::vector<std::vector<double>> surface = {{0.0, 0.0}};  ///< rows x, y [m]
  double friction = 0.70;                                   ///< [-]
};

struct OutletSettings {
  std::optional<double> left, right, bottom, top;  ///< [m]
};

struct TractionSettings {
  std::array<double, 2> from{kUnset, kUnset}, to{kUnset, kUnset};  ///< [m]
  double pressure = kUnset;                                        ///< [Pa]
  double shear = 0.0;                                              ///< [Pa]
  double begin = 0.0, ramp = 0.0;                                  ///< [s]
};

struct FlowConfig {
  double cell = kUnset;                 ///< [m]
  std::array<double, 2> grid_origin{};  ///< [m]
  double toe = kUnset;                  ///< x [m]
  double end = kUnset;                  ///< [s]
  GroundSettings ground;
  OutletSettings outlet;
  std::vector<TractionSettings> tractions;
  std::optional<double> left_roller;   ///< x [m]
  std::optional<double> right_roller;  ///< x [m]
  /// Rollers at two y [m] in three dimensions; not for workflows, which run plane strain.
  std::optional<std::array<double, 2>> side_rollers;
  SofteningSettings softening;
  mpm::BasisKind basis = mpm::BasisKind::quadratic;
  mpm::Transfer transfer = mpm::Transfer::apic;
  mpm::Update update = mpm::Update::symplectic;
  double relaxation = 0.3;  ///< of aflip [s]
  double flip_share = 0.99;
  int fmpm_order = 2;
  VolumeAverage volume_average = VolumeAverage::automatic;
  double gravity = 9.81;  ///< [m/s2]
  double courant = 0.9;
  double velocity_limit = 0.2;
  double strain_limit = 0.05;
  double damping = 0.0;
  RestSettings rest;
  double frame_interval = 5.0;    ///< [s]
  double sample_interval = 0.25;  ///< [s]
};

/// Relations that ranges cannot express. Throws InputError.
void check(const FlowConfig& c);

template <>
struct Schema<SofteningSettings> {
  static constexpr std::string_view doc = "How softening is kept independent of the cell size.";
  static void describe(FieldVisitor& v, SofteningSettings& c);
};
template <>
struct Schema<RestSettings> {
  static constexpr std::string_view doc =
      "When the flow counts as at rest; both conditions must hold.";
  static void describe(FieldVisitor& v, RestSettings& c);
};
template <>
struct Schema<GroundSettings> {
  static constexpr std::string_view doc = "The rigid ground under the flow.";
  static void describe(FieldVisitor& v, GroundSettings& c);
};
template <>
struct Schema<OutletSettings> {
  static constexpr std::string_view doc =
      "Edges beyond which points leave the computation; their mass, momentum and energy are "
      "accounted for.";
  static void describe(FieldVisitor& v, OutletSettings& c);
};
template <>
struct Schema<TractionSettings> {
  static constexpr std::string_view doc =
      "Stretches of the surface under load, such as a footing or water on it; the load stays on "
      "the "
      "points it was put on and keeps its amount and direction.";
  static void describe(FieldVisitor& v, TractionSettings& c);
};
template <>
struct Schema<FlowConfig> {
  static constexpr std::string_view doc = "Explicit material-point runout in plane strain.";
  static void describe(FieldVisitor& v, FlowConfig& c);
};

}  // namespace flowslide
